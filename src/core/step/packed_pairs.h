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
#include "core/step/packed_methods.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <cstddef>

namespace cfpm {

/// Whether contacts that can be computed in packs are in this evaluation. Where a state is evaluated again, the length
/// of steps has changed, or a method that asks for the crowd is not told, contacts act one by one. M: the method.
template <Friction friction, class M>
bool may_pack(const InstructionSet &set, const StepState &step, const StoredSpring &spring) {
  const bool plain_spring = friction != Friction::spring_and_dashpot || (spring.advance && spring.dt == step.dt);
  const bool knows = !M::wants_crowd || step.crowd.contacts;
  return set.lanes > 1 && plain_spring && knows;
}

/// See add_pair_forces(), whose arguments these are. lanes: of an instruction set with packs.
template <Friction friction, class M, class Tally> class PackedPairs {
public:
  /// counts: see StepState::contact_counts.
  PackedPairs(int lanes, const Particles &particles, const PairList &pairs, const M &method, const Tally &tally,
              double *counts = nullptr)
      : lanes_(lanes), particles_(particles), pairs_(pairs), method_(method), tally_(tally), counts_(counts),
        kinds_(particles_.count, body_of()) {}

  [[gnu::noinline]] void add_forces() {
#ifdef CFPM_WITH_AVX2
    if (lanes_ == 4) return add_forces_with_avx2();
#endif
    add_all_forces();
  }

private:
#ifdef CFPM_WITH_AVX2
  CFPM_WITH_AVX2 [[gnu::noinline]] void add_forces_with_avx2() { add_all_forces(); }
#endif

  [[gnu::always_inline]] void add_all_forces() {
    const PairList pairs = pairs_; // copies: what is stored could else be their members
    const VectorRows x = particles_.x;
    const double *const radius = particles_.radius;
    std::ptrdiff_t count = 0;
    for (int ii = 0; ii < pairs.count; ++ii) {
      const int i = pairs.first[ii];
      const Vec3 xi = vec3(x[i]);
      const double radius_i = radius[i];
      const int *const neighbors = pairs.neighbors[i];
      const int neighbor_count = pairs.neighbor_count[i];
      int *const flags = pairs.flags ? pairs.flags[i] : nullptr;
      [[maybe_unused]] double *spring = nullptr;
      if constexpr (friction == Friction::spring_and_dashpot) spring = pairs.history[i] + pairs.spring_offset;
      for (int jj = 0; jj < neighbor_count; ++jj) {
        const int j = neighbors[jj] & pairs.index_mask;
        const Vec3 separation = xi - vec3(x[j]);
        const double squared = dot(separation, separation);
        const double reach = M::Law::touch_distance(radius_i, radius[j]);
        const bool touch = squared < reach * reach;
        if (flags) pairs.mark(touch, flags[jj], i, jj);
        // Written for every pair and kept of those that touch: about half of them do, in no order, so that a branch
        // would be mispredicted at every other pair.
        chunk_.i[count] = i;
        chunk_.j[count] = j;
        chunk_.separation.set(count, separation);
        chunk_.squared[count] = squared;
        if constexpr (friction == Friction::spring_and_dashpot) {
          chunk_.spring[count] = spring;
          spring += pairs.history_size;
        }
        count += touch;
        if (count == Chunk::capacity) {
          finish(count);
          count = 0;
        }
      }
    }
    finish(count);
  }

  using Parameters = ParametersOf<M>;
  using Step = typename Parameters::template Step<double>;
  using Chunk = ContactChunk<Step>;

  auto body_of() const {
    return [this](int i) { return particles_.body(i); };
  }

  [[gnu::always_inline]] void finish(std::ptrdiff_t count) {
    if (count == 0) return;
    chunk_.count = static_cast<int>(count);
    kinds_.set(chunk_, body_of(), [this](const ContactBody &i, const ContactBody &j) {
      return method_.parameters(partners(i, j)).step();
    });
    compute<friction, typename M::Packed, Parameters>(lanes_, particles_, chunk_);
    apply();
  }

  [[gnu::always_inline]] void apply() const {
    const Particles particles = particles_; // a copy: what is stored could else be its members
    double *const counts = counts_;
    const int count = chunk_.count;
    for (int k = 0; k < count; ++k) {
      const int i = chunk_.i[k];
      const int j = chunk_.j[k];
      const Vec3 force = chunk_.force[k];
      tally_(i, j, force, chunk_.separation[k]);
      particles.add_contact(i, j, force, chunk_.torque_per_lever[k], chunk_.lever_i[k], chunk_.lever_j[k]);
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
  double *const counts_;
  ContactKinds<Step> kinds_;
  Chunk chunk_;
};

} // namespace cfpm
