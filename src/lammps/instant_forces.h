// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"
#include "predicted_contacts.h"

#include "core/step/pair_list.h"
#include "core/step/particles.h"

namespace cfpm::lammps {

/// Adds what the host's gran/hooke/history, gran/hooke or gran/hertz/history does in a step, to the last bit, several
/// contacts at a time. dt: by which springs move on [s]; tally: empty, or called for every contact.
void add_instant_forces(const ContactArguments &arguments, const Particles &particles, const PairList &pairs, double dt,
                        const Tally &tally);
/// Likewise what the host's granular does, see granular_order. coefficients: of all pairs of types that meet; all of
/// them must have a tangential spring, or none where the pairs have no history; all or none roll, then they have a
/// spring.
void add_instant_forces(const GranularPairs &coefficients, const Particles &particles, const PairList &pairs, double dt,
                        const Tally &tally);

} // namespace cfpm::lammps
