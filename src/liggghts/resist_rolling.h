// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_contact_models.h"

namespace cfpm::liggghts {

/// Adds what the host's rolling friction does over a step, to a contact whose forces were predicted. data: as the
/// host's normal and tangential models leave it; id: of the model.
void resist_rolling(LAMMPS_NS::LAMMPS &lmp, LIGGGHTS::ContactModels::RollingModelBase &model, int id,
                    LIGGGHTS::ContactModels::SurfacesIntersectData &data, LIGGGHTS::ContactModels::ForceData &i_forces,
                    LIGGGHTS::ContactModels::ForceData &j_forces);

} // namespace cfpm::liggghts
