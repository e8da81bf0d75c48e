// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over listed pairs in chunks: find, compute in packs, apply. To the last bit what one contact after the other
// gives, since every sum has its terms in the order of the list.
#pragma once

#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/numbers/instruction_set.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_chunk.h"
#include "core/step/packed_methods.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

namespace cfpm {

/// Whether contacts that can be computed in packs are in this evaluation. Where a state is evaluated again, the length
/// of steps has changed, or contacts are counted for walls that give impulses, contacts act one by one.
template <Friction friction>
bool may_pack(const InstructionSet &set, const StepState &step, const StoredSpring &spring) {
  const bool plain_spring = friction != Friction::spring_and_dashpot || (spring.advance && spring.dt == step.dt);
  return set.lanes > 1 && plain_spring && !step.contact_counts;
}

/// See add_pair_forces(), whose arguments these are. lanes: of an instruction set with packs.
template <Friction friction, class M, class Tally> class PackedPairs {
public:
  PackedPairs(int lanes, const Particles &particles, const PairList &pairs, const M &method, const Tally &tally)
      : lanes_(lanes), particles_(particles), pairs_(pairs), method_(method), tally_(tally) {}

  [[gnu::noinline]] void add_forces() {
    const PairList pairs = pairs_; // copies: what is stored could else be their members
    const VectorRows x = particles_.x;
    const double *const radius = particles_.radius;
    int count = 0;
    for (int ii = 0; ii < pairs.count; ++ii) {
      const int i = pairs.first[ii];
      const Vec3 xi = vec3(x[i]);
      const double radius_i = radius[i];
      const int *const neighbors = pairs.neighbors[i];
      const int neighbor_count = pairs.neighbor_count[i];
      int *const flags = pairs.flags ? pairs.flags[i] : nullptr;
      for (int jj = 0; jj < neighbor_count; ++jj) {
        const int j = neighbors[jj] & pairs.index_mask;
        const Vec3 separation = xi - vec3(x[j]);
        const double squared = dot(separation, separation);
        const double reach = M::Law::touch_distance(radius_i, radius[j]);
        const bool touch = squared < reach * reach;
        if (flags) mark(touch, flags[jj], i, jj);
        // Written for every pair and kept of those that touch: about half of them do, in no order, so that a branch
        // would be mispredicted at every other pair.
        chunk_.i[count] = i;
        chunk_.j[count] = j;
        chunk_.separation.set(count, separation);
        chunk_.squared[count] = squared;
        if constexpr (friction == Friction::spring_and_dashpot) chunk_.spring[count] = pairs.spring(i, jj);
        count += touch;
        if (count == Chunk::capacity) {
          finish(count);
          count = 0;
        }
      }
    }
    finish(count);
  }

private:
  using Parameters = ParametersOf<M>;
  using Chunk = ContactChunk<typename Parameters::template Step<double>>;

  /// Keeps the mark of a pair, which hardly ever changes.
  [[gnu::always_inline]] void mark(bool touch, int &flag, int i, int jj) const {
    int wanted = -static_cast<int>(touch) & pairs_.touching;
    __asm__("" : "+r"(wanted)); // a number: else the compiler makes a branch of it, see above
    if (__builtin_expect(flag == wanted, 1)) return;
    if (touch)
      flag |= pairs_.touching;
    else if (!pairs_.remembers)
      pairs_.end_contact(flag, i, jj);
  }

  void finish(int count) {
    if (count == 0) return;
    chunk_.count = count;
    find_kinds();
    compute<friction, typename M::Packed, Parameters>(lanes_, particles_, chunk_);
    apply();
  }

  /// Most contacts have the parameters of the one before.
  void find_kinds() {
    ContactBody last_i{};
    ContactBody last_j{};
    chunk_.kinds = 0;
    for (int k = 0; k < chunk_.count; ++k) {
      const ContactBody body_i = particles_.body(chunk_.i[k]);
      const ContactBody body_j = particles_.body(chunk_.j[k]);
      if (chunk_.kinds == 0 || !(body_i == last_i) || !(body_j == last_j)) {
        last_i = body_i;
        last_j = body_j;
        chunk_.steps[chunk_.kinds++] = method_.parameters(partners(body_i, body_j)).step();
      }
      chunk_.kind[k] = chunk_.kinds - 1;
    }
  }

  void apply() const {
    for (int k = 0; k < chunk_.count; ++k) {
      const int i = chunk_.i[k];
      const int j = chunk_.j[k];
      const MeanForce mean{chunk_.force[k], chunk_.torque_per_lever[k]};
      tally_(i, j, mean.force, chunk_.separation[k]);
      add(mean.force, particles_.f[i]);
      add(mean.couple(chunk_.lever_i[k]), particles_.torque[i]);
      if (j >= particles_.receiving) continue;
      add(-mean.force, particles_.f[j]);
      add(mean.couple(chunk_.lever_j[k]), particles_.torque[j]);
    }
  }

  int lanes_;
  const Particles particles_;
  const PairList pairs_;
  const M &method_;
  const Tally &tally_;
  Chunk chunk_;
};

} // namespace cfpm
