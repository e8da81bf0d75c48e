// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_chunk.h"
#include "core/step/near_pairs.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"

#include <algorithm>
#include <cstddef>

namespace cfpm {

/// Fills a chunk with the contacts among near pairs, in their order, and calls finish(count) where it is full and at
/// the end. begins_inside(place in the chunk, reach): whether spheres touch in the step dt [s] that are apart, but by
/// less than ahead [m], and come together.
/// P: of as many lanes as a group of near pairs.
template <class P, class Law, bool has_spring, class Chunk, class BeginsInside, class Finish>
[[gnu::always_inline]] inline void find_contacts(NearPairs &near, const Particles &particles, const PairList &pairs,
                                                 double ahead, double dt, Chunk &chunk,
                                                 const BeginsInside &begins_inside, const Finish &finish) {
  constexpr int group = NearPairs::group;
  static_assert(P::width == group);
  constexpr unsigned all = (1U << group) - 1;
  const int *const near_i = near.i();
  const int *const near_j = near.j();
  const int *const near_slot = near.slot();
  const int near_count = near.count();
  std::ptrdiff_t count = 0;
  for (int k = 0; k < near_count; k += group) {
    const int *const i = near_i + k;
    const int *const j = near_j + k;
    const BasicVec3<P> separation = gather<P>(particles.x, i) - gather<P>(particles.x, j);
    const P squared = dot(separation, separation);
    const P radius_i = gather<P>(particles.radius, i);
    const P radius_j = gather<P>(particles.radius, j);
    const P reach = Law::touch_distance(radius_i, radius_j);
    const unsigned listed = (1U << std::min(group, near_count - k)) - 1;
    unsigned touching = lanes_of(squared < reach * reach) & listed;
    const auto keep_spring = [&](int lane, std::ptrdiff_t at) CFPM_INLINED {
      if constexpr (has_spring)
        chunk.spring[at] = pairs.history[i[lane]] +
                           static_cast<std::ptrdiff_t>(near_slot[k + lane]) * pairs.history_size + pairs.spring_offset;
    };
    if (touching == all) { // most groups of a bed
      const int at = static_cast<int>(count);
      store(separation, chunk.separation, at);
      squared.store(chunk.squared + at);
      radius_i.store(chunk.radius_i + at);
      radius_j.store(chunk.radius_j + at);
      std::copy_n(i, group, chunk.i + at);
      std::copy_n(j, group, chunk.j + at);
      for (int lane = 0; lane < group; ++lane) keep_spring(lane, at + lane);
      count += group;
    } else {
      const P far = reach + P(ahead);
      unsigned close = lanes_of(squared < far * far) & listed;
      if ((close & ~touching) != 0) {
        const BasicVec3<P> velocity = gather<P>(particles.v, i) - gather<P>(particles.v, j);
        const P approach = -dot(separation, velocity);
        close &= touching | lanes_of(may_come_together<P>(approach, squared - reach * reach, dt));
      }
      alignas(32) VectorColumns<group> separations;
      alignas(32) double squares[group], reaches[group];
      store(separation, separations, 0);
      squared.store(squares);
      reach.store(reaches);
      for (; close != 0; close &= close - 1) {
        const int lane = __builtin_ctz(close);
        chunk.i[count] = i[lane];
        chunk.j[count] = j[lane];
        chunk.separation.set(count, separations[lane]);
        chunk.squared[count] = squares[lane];
        chunk.radius_i[count] = particles.radius[i[lane]];
        chunk.radius_j[count] = particles.radius[j[lane]];
        keep_spring(lane, count);
        bool touch = (touching >> lane & 1U) != 0;
        if (!touch) touch = begins_inside(static_cast<int>(count), reaches[lane]);
        touching |= static_cast<unsigned>(touch) << lane;
        count += touch;
      }
    }
    if (__builtin_expect(near.touching(k) != touching, 0)) near.note(k, touching, pairs);
    if (count > Chunk::capacity - group) {
      finish(count);
      count = 0;
    }
  }
  finish(count);
}

} // namespace cfpm
