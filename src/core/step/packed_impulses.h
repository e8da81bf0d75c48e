// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over listed pairs in chunks, see packed_pairs.h, of methods that give impulses. In packs are computed the
// contacts of crowds that last over the whole step, which in a bed are nearly all. The others, alone or beginning
// inside the step, act one by one when their turn comes, so that every sum has its terms in the order of the list.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/numbers/instruction_set.h"
#include "core/step/act.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_chunk.h"
#include "core/step/contact_kinds.h"
#include "core/step/find_contacts.h"
#include "core/step/made_chunk.h"
#include "core/step/near_pairs.h"
#include "core/step/packed_methods.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"
#include "core/step/touch.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace cfpm {

/// See add_pair_forces(), whose arguments these are; step: with a crowd. lanes: of an instruction set with packs.
template <Friction friction, class M, class Tally> class PackedImpulses {
public:
  PackedImpulses(int lanes, const Particles &particles, const PairList &pairs, const StepState &step, const M &method,
                 const Tally &tally)
      : lanes_(lanes), particles_(particles), pairs_(pairs), dt_(step.dt), ahead_(step.ahead), crowd_(step.crowd),
        shift_(step.shift), counts_(step.contact_counts), method_(method), tally_(tally),
        kinds_(particles_.count, body_of()) {
    chunk_.contacts = step.crowd.contacts;
    if constexpr (with_spring) chunk_.spring_now = pairs.spring_now_offset - pairs.spring_offset;
    span_.fill(dt_);
  }

  [[gnu::noinline]] void add_forces() {
#ifdef CFPM_WITH_AVX2
    if (lanes_ == 4) return add_forces_with_avx2();
#endif
    add_all_forces<TwoPacks<Pack<2>>>();
  }

private:
#ifdef CFPM_WITH_AVX2
  CFPM_WITH_AVX2 [[gnu::noinline]] void add_forces_with_avx2() { add_all_forces<Pack<4>>(); }
#endif

  template <class P> [[gnu::always_inline]] void add_all_forces() {
    const PairList pairs = pairs_; // copies: what is stored could else be their members
    const Particles particles = particles_;
    NearPairs of_this_evaluation;
    NearPairs &near = pairs.near ? *pairs.near : of_this_evaluation;
    near.follow<P, typename M::Law>(particles, pairs, ahead_);
    find_contacts<P, typename M::Law, with_spring>(
        near, particles, pairs, ahead_, dt_, chunk_, [this](int k, double reach) { return begins_inside(k, reach); },
        [this](std::ptrdiff_t count) { finish(count); });
  }

  static constexpr bool with_spring = has_spring(friction);
  using Step = typename PackedParametersOf<M>::template Step<double>;
  using Chunk = CrowdedChunk<Step>;

  /// A contact of the chunk that acts by itself, with its springs: packs, which take it along, spoil them.
  struct Apart {
    int contact;
    Vec3 stored, now; ///< see StoredSpring
  };

  static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }

  /// Whether the spheres at place k of the chunk, which are apart, touch inside the step; moves them on to where they
  /// do.
  [[gnu::noinline]] bool begins_inside(int k, double reach) {
    Meeting meeting{chunk_.separation[k], chunk_.squared[k], dt_};
    const Vec3 velocity = vec3(particles_.v[chunk_.i[k]]) - vec3(particles_.v[chunk_.j[k]]);
    if (!move_to_touch(meeting, velocity, reach)) return false;
    chunk_.separation.set(k, meeting.separation);
    chunk_.squared[k] = meeting.squared;
    span_[at(k)] = meeting.span;
    return true;
  }

  [[gnu::always_inline]] void finish(std::ptrdiff_t found) {
    const int count = static_cast<int>(found);
    if (count == 0) return;
    chunk_.count = count;
    const int apart_count = find_apart();
    const bool packed = apart_count < count && find_kinds();
    if (packed) compute<friction, typename M::Packed, PackedParametersOf<M>>(lanes_, particles_, chunk_);
    int next = 0;
    for (int k = 0; k < count; ++k) {
      if (__builtin_expect(next < apart_count && apart_[at(next)].contact == k, 0)) {
        if constexpr (with_spring) {
          set(apart_[at(next)].stored, chunk_.spring[k]);
          set(apart_[at(next)].now, chunk_.spring[k] + chunk_.spring_now);
        }
        act_apart(k);
        ++next;
      } else if (packed) {
        add_to_bodies(k, chunk_.force[k], chunk_.torque_per_lever[k], chunk_.lever_i[k], chunk_.lever_j[k],
                      chunk_.counted[k]);
      } else {
        act_apart(k);
      }
    }
  }

  /// How many there are.
  int find_apart() {
    int count = 0;
    for (int k = 0; k < chunk_.count; ++k) {
      const bool whole_step = span_[at(k)] == dt_;
      const bool crowded_i = held_by_others(chunk_.i[k]);
      const bool crowded_j = held_by_others(chunk_.j[k]);
      const bool crowded = crowded_i | crowded_j;
      if (__builtin_expect(whole_step & crowded, 1)) continue;
      Apart &apart = apart_[at(count++)];
      apart.contact = k;
      if constexpr (with_spring) {
        apart.stored = vec3(chunk_.spring[k]);
        apart.now = vec3(chunk_.spring[k] + chunk_.spring_now);
      }
    }
    return count;
  }

  /// Whether others than a contact of its own hold a particle, see Particles::others().
  [[gnu::always_inline]] bool held_by_others(int i) const {
    return (crowd_.contacts[i] > 1.0) & !(particles_.group[i] & particles_.frozen);
  }

  auto body_of() const {
    return [this](int i) { return particles_.body(i, crowd_); };
  }

  /// Whether packs can be made of all contacts.
  bool find_kinds() {
    if constexpr (makes_steps<M>)
      if (kinds_.are_too_many()) return made_.set(lanes_, particles_, chunk_, body_of(), method_.maker());
    kinds_.set(chunk_, body_of(), [this](const ContactBody &i, const ContactBody &j) {
      const Step *const step = method_.parameters(partners(i, j)).crowd_step();
      if (!step) all_have_steps_ = false;
      return step ? *step : Step{};
    });
    return all_have_steps_;
  }

  /// As add_pair_forces_one_by_one() does it.
  [[gnu::noinline]] void act_apart(int k) {
    const int i = chunk_.i[k];
    const int j = chunk_.j[k];
    const ContactBody body_i = particles_.body(i, crowd_);
    const ContactBody body_j = particles_.body(j, crowd_);
    StoredSpring spring{nullptr, dt_, true};
    if constexpr (with_spring) spring = {chunk_.spring[k], dt_, true, chunk_.spring[k] + chunk_.spring_now};
    const Contact contact{touching_spheres(chunk_.separation[k], std::sqrt(chunk_.squared[k]), body_i.radius,
                                           body_j.radius, particles_.motion(i), particles_.motion(j)),
                          span_[at(k)], particles_.others(i, crowd_) + particles_.others(j, crowd_), spring};
    span_[at(k)] = dt_;
    const ContactPartners both = partners(body_i, body_j); // named: g++ 14 takes what is returned for a part of it
    const auto &parameters = parameters_of(method_, both, kinds_.are_too_many());
    const ContactAction action = act<friction>(method_, parameters, contact, no_cohesion);
    add_to_bodies(k, action.mean.force, action.mean.torque_per_lever, contact.geometry.lever_i,
                  contact.geometry.lever_j, action.touching ? 1.0 : 0.0);
    if (contact.others != 0.0) return;
    add(action.mean.shift, shift_[i]);
    if (j < particles_.receiving) add(-action.mean.shift, shift_[j]);
  }

  [[gnu::always_inline]] void add_to_bodies(int k, const Vec3 &force, const Vec3 &torque_per_lever, double lever_i,
                                            double lever_j, double counted) const {
    const int i = chunk_.i[k];
    const int j = chunk_.j[k];
    tally_(i, j, force, chunk_.separation[k]);
    particles_.add_contact(i, j, force, torque_per_lever, lever_i, lever_j);
    counts_[i] += counted;
    if (j < particles_.receiving) counts_[j] += counted;
  }

  Chunk chunk_;
  int lanes_;
  bool all_have_steps_ = true;
  const Particles particles_;
  const PairList pairs_;
  const double dt_;
  const double ahead_;
  const Crowd crowd_;
  const VectorRows shift_;
  double *const counts_;
  const M &method_;
  const Tally &tally_;
  ContactKinds<Step> kinds_;
  typename MadeStepsFor<M, Chunk::size>::type made_;
  std::array<double, Chunk::capacity> span_; ///< of each contact to the end of the step [s]
  std::array<Apart, Chunk::capacity> apart_;
};

} // namespace cfpm
