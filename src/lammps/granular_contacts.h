// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"
#include "predicted_contacts.h"

#include "core/method/method.h"

#include <memory>
#include <string>

namespace cfpm::lammps {

/// Of contacts with the sub-models of granular.
using GranularMethods = MethodList<PredictedForce<Exact>, PredictedForce<Trapezoid>, PredictedForce<RungeKutta2>,
                                   PredictedForce<RungeKutta4>, PredictedImpulse>;

/// Whether a method is one of these that predicts contacts with such a law. kind: of the law of all bodies.
bool predicts_granular(const Method &method, LawKind kind);
/// "rk2, rk4", for messages.
std::string names_of_granular_methods(LawKind kind);

/// The method must be one of these that predicts it. coefficients: of all pairs of types that meet, as they are when
/// they are asked for.
std::unique_ptr<PredictedContacts> make_granular_contacts(const Method &method, LawKind kind,
                                                          std::shared_ptr<const GranularPairs> coefficients);

} // namespace cfpm::lammps
