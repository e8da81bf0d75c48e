// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"
#include "predicted_contacts.h"

#include <memory>

namespace cfpm::lammps {

/// kind: of the law of all bodies; the method must be one of the paper's that predicts it. coefficients: of all pairs
/// of types that meet, as they are when they are asked for.
std::unique_ptr<PredictedContacts> make_granular_contacts(const Method &method, LawKind kind,
                                                          std::shared_ptr<const GranularPairs> coefficients);

} // namespace cfpm::lammps
