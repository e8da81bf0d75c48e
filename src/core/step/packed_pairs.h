// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over listed pairs in chunks: find, compute in packs, apply. To the last bit what one contact after the other
// gives, since every sum has its terms in the order of the list.
#pragma once

#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/numbers/instruction_set.h"
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
#include "core/step/turn_resistances.h"

#include <cstddef>
#include <type_traits>

namespace cfpm {

/// Whether contacts that can be computed in packs are in this evaluation. Where a state is evaluated again, the length
/// of steps has changed, or a method that asks for the crowd is not told, contacts act one by one. M: the method.
template <Friction friction, class M>
bool may_pack(const InstructionSet &set, const StepState &step, const StoredSpring &spring) {
  const bool plain_spring = !has_spring(friction) || (spring.advance && spring.dt == step.dt);
  const bool knows = !M::wants_crowd || step.crowd.contacts;
  return set.lanes > 1 && plain_spring && knows;
}

/// Whether contacts by a law resist rolling, see BasicRollingPairForce.
template <class Law, class = void> inline constexpr bool resists_rolling = false;
template <class Law> inline constexpr bool resists_rolling<Law, std::enable_if_t<Law::rolls>> = true;
/// Likewise twisting, see BasicTurningPairForce.
template <class Law, class = void> inline constexpr bool resists_twisting = false;
template <class Law> inline constexpr bool resists_twisting<Law, std::enable_if_t<Law::twists>> = true;
/// Whether their couple and the torques of their levers go to the bodies as one sum.
template <class Law, class = void> inline constexpr bool sums_torques = false;
template <class Law> inline constexpr bool sums_torques<Law, std::enable_if_t<Law::one_torque>> = true;

/// See add_pair_forces(), whose arguments these are. lanes: of an instruction set with packs.
template <Friction friction, class M, class Tally> class PackedPairs {
public:
  PackedPairs(int lanes, const Particles &particles, const PairList &pairs, const M &method, const Tally &tally)
      : lanes_(lanes), particles_(particles), pairs_(pairs), method_(method), tally_(tally),
        kinds_(particles_.count, body_of()) {
    if constexpr (twists) chunk_.places = pairs.places;
  }

  /// counts: see StepState::contact_counts.
  void count_in(double *counts) { counts_ = counts; }
  /// dt: of the step [s]
  void resist_turns(const TurnResistances &resistances, double dt) {
    resistances_ = &resistances;
    dt_ = dt;
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
    near.follow<P, typename M::Law>(particles, pairs, 0.0);
    constexpr bool with_spring = has_spring(friction);
    find_contacts<P, typename M::Law, with_spring>(
        near, particles, pairs, 0.0, 0.0, chunk_, [](int, double) { return false; },
        [this](std::ptrdiff_t count) { finish(count); });
  }

  using Parameters = ParametersOf<M>;
  using Step = typename Parameters::template Step<double>;
  static constexpr bool rolls = resists_rolling<typename M::Law>;
  static constexpr bool twists = resists_twisting<typename M::Law>;
  using Chunk =
      std::conditional_t<twists, TurningChunk<Step>, std::conditional_t<rolls, RollingChunk<Step>, ContactChunk<Step>>>;

  auto body_of() const {
    return [this](int i) { return particles_.body(i); };
  }

  [[gnu::always_inline]] void finish(std::ptrdiff_t count) {
    if (count == 0) return;
    chunk_.count = static_cast<int>(count);
    find_kinds();
    compute<friction, typename M::Packed, Parameters>(lanes_, particles_, chunk_);
    if (resistances_) resistances_->add_couples(lanes_, particles_, chunk_, dt_);
    apply();
  }

  void find_kinds() {
    if constexpr (makes_steps<M>)
      if (kinds_.are_too_many()) {
        made_.set(lanes_, particles_, chunk_, body_of(), method_.maker());
        return;
      }
    kinds_.set(chunk_, body_of(), [this](const ContactBody &i, const ContactBody &j) {
      return method_.parameters(partners(i, j)).step();
    });
  }

  [[gnu::always_inline]] void apply() const {
    const Particles particles = particles_; // a copy: what is stored could else be its members
    double *const counts = counts_;
    const bool turns = rolls || resistances_;
    const int count = chunk_.count;
    for (int k = 0; k < count; ++k) {
      const int i = chunk_.i[k];
      const int j = chunk_.j[k];
      const Vec3 force = chunk_.force[k];
      tally_(i, j, force, chunk_.separation[k]);
      if constexpr (sums_torques<typename M::Law>) {
        const Vec3 torque_per_lever = chunk_.torque_per_lever[k];
        const Vec3 couple = chunk_.couple[k];
        Vec3 torque_i = couple - chunk_.lever_i[k] * torque_per_lever;
        Vec3 torque_j = -couple - chunk_.lever_j[k] * torque_per_lever;
        if constexpr (twists) {
          torque_i = torque_i + chunk_.twisting[k];
          torque_j = torque_j - chunk_.twisting[k];
        }
        particles.add_force(i, j, force);
        particles.add_torques(i, j, torque_i, torque_j);
      } else {
        particles.add_contact(i, j, force, chunk_.torque_per_lever[k], chunk_.lever_i[k], chunk_.lever_j[k]);
        if constexpr (twists) particles.add_torques(i, j, chunk_.twisting[k], -chunk_.twisting[k]);
        if (turns) particles.add_torques(i, j, chunk_.couple[k], -chunk_.couple[k]);
      }
      if (!counts) continue;
      counts[i] += chunk_.counted[k];
      if (j < particles.receiving) counts[j] += chunk_.counted[k];
    }
  }

  int lanes_;
  const Particles particles_;
  const PairList pairs_;
  const M &method_;
  const Tally &tally_;
  double *counts_ = nullptr;
  const TurnResistances *resistances_ = nullptr; ///< null: none
  double dt_ = 0.0;
  ContactKinds<Step> kinds_;
  typename MadeStepsFor<M, Chunk::size>::type made_;
  Chunk chunk_;
};

} // namespace cfpm
