// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "predicted_contacts.h"

#include "core/law/granular_law.h"

namespace cfpm::lammps {

/// kind: of the law of all bodies; the method must be one that predicts it.
std::unique_ptr<PredictedContacts> make_granular_contacts(const Method &method, LawKind kind,
                                                          LawOfPartners<GranularLaw> law_of);

} // namespace cfpm::lammps
