// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/numbers/instruction_set.h"
#include "core/step/act.h"
#include "core/step/near_pairs.h"
#include "core/step/packed_impulses.h"
#include "core/step/packed_methods.h"
#include "core/step/packed_pairs.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"
#include "core/step/touch.h"
#include "core/step/turn_resistances.h"

#include <cmath>
#include <type_traits>

namespace cfpm {

/// For contacts that nobody tallies.
struct NoTally {
  void operator()(int, int, const Vec3 &, const Vec3 &) const {}
};
inline constexpr NoTally no_tally{};

/// Finds the contacts of all listed pairs in a step, lets each act, and applies what it does: adds mean forces and
/// couples to f and torque, shifts and counts to the step.
/// M: the method, such as MeanOfTwoForces; spring: how to read springs, with values left open;
/// tally(i, j, force on i, xi - xj): called for every contact; resistances: that its bodies turn, null for none, where
/// contacts have a wider history and nobody asks for the crowd.
template <Friction friction, class M, class Tally>
[[gnu::noinline]] void add_pair_forces_one_by_one(const Particles &particles, const PairList &pairs,
                                                  const StepState &step, StoredSpring spring, const M &method,
                                                  const Tally &tally, const TurnResistances *resistances = nullptr) {
  // copies: what is added to a double could else be any of these
  const double dt = step.dt;
  const double ahead = step.ahead;
  const Crowd crowd = step.crowd;
  const VectorRows shift = step.shift;
  double *const counts = step.contact_counts;
  constexpr bool crowded = M::wants_crowd;
  const bool counting = crowded || counts;
  const auto body = [&](int i) { return crowded ? particles.body(i, crowd) : particles.body(i); };
  // as the loop over packs does
  const bool made = makes_steps<M> && BodyClasses(particles.count, body).are_too_many();
  // most contacts have the parameters of the one before
  ContactBody last_i{};
  ContactBody last_j{};
  decltype(&method.parameters(partners(last_i, last_j))) parameters = nullptr;

  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    const Vec3 xi = vec3(particles.x[i]);
    const Motion motion_i = particles.motion(i);
    const ContactBody body_i = body(i);
    if (!(body_i == last_i)) parameters = nullptr;
    last_i = body_i;
    Vec3 force_i = vec3(particles.f[i]);
    Vec3 torque_i = vec3(particles.torque[i]);
    int contacts_i = 0;
    const double others_i = crowded ? particles.others(i, crowd) : 0.0;
    const int *const neighbors = pairs.neighbors[i];
    const int neighbor_count = pairs.neighbor_count[i];
    int *const flags = pairs.flags ? pairs.flags[i] : nullptr;

    for (int jj = 0; jj < neighbor_count; ++jj) {
      // find
      const int j = neighbors[jj] & pairs.index_mask;
      const Vec3 separation = xi - vec3(particles.x[j]);
      Meeting meeting{separation, dot(separation, separation), dt};
      const double reach = M::Law::touch_distance(body_i.radius, particles.radius[j]);
      if (meeting.squared >= reach * reach) {
        bool touch = false;
        if constexpr (M::wants_onset)
          touch = meeting.squared < (reach + ahead) * (reach + ahead) &&
                  move_to_touch(meeting, motion_i.velocity - vec3(particles.v[j]), reach);
        if (!touch) {
          if (flags && flags[jj]) pairs.end_contact(flags[jj], i, jj);
          continue;
        }
      }
      if (flags) flags[jj] |= pairs.touching;
      // needed last, and in a large bed it comes from far away
      if constexpr (has_spring(friction)) __builtin_prefetch(pairs.spring(i, jj), 1);
      const ContactBody body_j = body(j);
      if (!parameters || !(body_j == last_j)) {
        last_j = body_j;
        parameters = &parameters_of(method, partners(body_i, body_j), made);
      }
      if constexpr (has_spring(friction)) {
        spring.values = pairs.spring(i, jj);
        if (!spring.values) __builtin_unreachable(); // such friction comes with a history
        if constexpr (crowded) spring.now = pairs.spring_now(i, jj);
      }
      const Contact contact{touching_spheres(meeting.separation, std::sqrt(meeting.squared), body_i.radius,
                                             body_j.radius, motion_i, particles.motion(j)),
                            meeting.span, crowded ? others_i + particles.others(j, crowd) : 0.0, spring};

      // act
      const ContactAction action = act<friction>(method, *parameters, contact, no_cohesion);
      const MeanForce &mean = action.mean;

      // apply
      tally(i, j, mean.force, meeting.separation);
      force_i = force_i + mean.force;
      torque_i = torque_i + mean.couple(contact.geometry.lever_i);
      Vec3 couple{};
      if (resistances) {
        couple = resistances->couple(particles, i, j, contact, mean.force, dt);
        torque_i = torque_i + couple;
      }
      const bool shifts = crowded && contact.others == 0.0; // only the isolated contact does
      const bool counted = counting && action.touching;
      if (shifts) add(mean.shift, shift[i]);
      if (counted) ++contacts_i;
      if (j >= particles.receiving) continue;
      add(-mean.force, particles.f[j]);
      add(mean.couple(contact.geometry.lever_j), particles.torque[j]);
      if (resistances) add(-couple, particles.torque[j]);
      if (shifts) add(-mean.shift, shift[j]);
      if (counted) ++counts[j];
    }
    set(force_i, particles.f[i]);
    set(torque_i, particles.torque[i]);
    if (counting) counts[i] += contacts_i;
  }
}

/// The same to the last bit, several contacts at a time where they can be computed in packs and the instructions are
/// there.
template <Friction friction, class M, class Tally>
void add_pair_forces(const Particles &particles, const PairList &pairs, const StepState &step,
                     const StoredSpring &spring, const M &method, const Tally &tally,
                     const InstructionSet &instructions = instruction_set(),
                     const TurnResistances *resistances = nullptr) {
  if constexpr (has_packs<M>)
    if (may_pack<friction, M>(instructions, step, spring)) {
      if constexpr (M::wants_crowd) {
        PackedImpulses<friction, M, Tally>(instructions.lanes, particles, pairs, step, method, tally).add_forces();
      } else {
        PackedPairs<friction, M, Tally> packed(instructions.lanes, particles, pairs, method, tally);
        packed.count_in(step.contact_counts);
        if (resistances) packed.resist_turns(*resistances, step.dt);
        packed.add_forces();
      }
      return;
    }
  if (pairs.near) pairs.near->forget();
  add_pair_forces_one_by_one<friction>(particles, pairs, step, spring, method, tally, resistances);
}

} // namespace cfpm
