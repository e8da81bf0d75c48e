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
/// Which law a deck's contacts of granular are computed by: a TurnedSpring, the same that rolls, or with all
/// sub-models.
enum class InstantLoop { plain, rolling, sub_models };
/// The least that these ask for, pairs of types of one deck.
InstantLoop instant_loop(const GranularPairs &coefficients);

/// Likewise what the host's granular does, see granular_order. coefficients: of all pairs of types that meet; the pairs
/// have a history, with its places, if any of them has a tangential spring, and only then any of them resists turns.
void add_instant_forces(const GranularPairs &coefficients, InstantLoop loop, const Particles &particles,
                        const PairList &pairs, double dt, const Tally &tally);

} // namespace cfpm::lammps
