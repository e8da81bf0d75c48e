// SPDX-License-Identifier: GPL-2.0-or-later
// What the contacts of a chunk do, several at a time: the middle of find, compute, apply. Compiled for each instruction
// set; which one runs is chosen once.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/history_places.h"
#include "core/contact/tangential_spring.h"
#include "core/contact/wider_history.h"
#include "core/law/coulomb.h"
#include "core/method/forces/mean_friction.h"
#include "core/numbers/instruction_set.h"
#include "core/numbers/pack.h"
#include "core/numbers/rows.h"
#include "core/numbers/two_packs.h"
#include "core/numbers/vec3.h"
#include "core/step/contact_chunk.h"
#include "core/step/particles.h"

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace cfpm {

template <class P, std::size_t size>
[[gnu::always_inline]] inline BasicVec3<P> load(const VectorColumns<size> &columns, int k) {
  return {P::load(columns.x + k), P::load(columns.y + k), P::load(columns.z + k)};
}
template <class P, std::size_t size>
[[gnu::always_inline]] inline void store(const BasicVec3<P> &vectors, VectorColumns<size> &columns, int k) {
  vectors.x.store(columns.x + k);
  vectors.y.store(columns.y + k);
  vectors.z.store(columns.z + k);
}

/// Of the particles with these indices, one in each lane.
template <class P> [[gnu::always_inline]] inline P gather(const double *numbers, const int *indices) {
  return Lanes<P>::fill([&](int lane) CFPM_INLINED { return numbers[indices[lane]]; });
}
template <class P> [[gnu::always_inline]] inline BasicVec3<P> gather(const VectorRows &rows, const int *indices) {
  return Rows<P>::gather([&](int lane) CFPM_INLINED { return rows[indices[lane]]; });
}

/// The springs of a pack of contacts, see StoredSpring; the step before had the length of this one.
template <class P> struct StoredSprings {
  double *const *values;
  std::ptrdiff_t behind = 0; ///< of these

  [[gnu::always_inline]] BasicVec3<P> load() const {
    return Rows<P>::gather([this](int lane) CFPM_INLINED { return values[lane] + behind; });
  }
  [[gnu::always_inline]] void store(const BasicVec3<P> &springs) const {
    Rows<P>::scatter(springs, [this](int lane) CFPM_INLINED { return values[lane] + behind; });
  }
};

/// As of that of one contact, see follow_area().
template <class P> [[gnu::always_inline]] inline P area_before(const StoredSprings<P> &springs) {
  return fabs(Lanes<P>::fill([&](int lane) CFPM_INLINED { return springs.values[lane][WiderHistory::area]; }));
}
template <class P>
[[gnu::always_inline]] inline void stretch(const StoredSprings<P> &springs, const P &factor, const P &area) {
  springs.store(factor * springs.load());
  double areas[P::width];
  area.store(areas);
  for (int lane = 0; lane < P::width; ++lane) springs.values[lane][WiderHistory::area] = areas[lane];
}

/// The same of contacts that resist rolling, whose other spring is behind the first.
template <class P> struct RollingSprings : StoredSprings<P> {
  [[gnu::always_inline]] StoredSprings<P> rolling() const { return {this->values, 3}; }
};

/// The same of a number of each contact.
template <class P> struct StoredNumbers {
  double *const *values;
  std::ptrdiff_t behind; ///< of these

  [[gnu::always_inline]] P load() const {
    return Lanes<P>::fill([this](int lane) CFPM_INLINED { return values[lane][behind]; });
  }
  [[gnu::always_inline]] void store(const P &numbers) const {
    double stored[P::width];
    numbers.store(stored);
    for (int lane = 0; lane < P::width; ++lane) values[lane][behind] = stored[lane];
  }
};

/// The springs of contacts that keep more of them.
template <class P> struct TurningSprings : StoredSprings<P> {
  HistoryPlaces places;

  [[gnu::always_inline]] StoredNumbers<P> area() const { return {this->values, places.area}; }
  [[gnu::always_inline]] StoredSprings<P> rolling() const { return {this->values, places.rolling}; }
  [[gnu::always_inline]] StoredNumbers<P> twist() const { return {this->values, places.twist}; }
};

/// The same of contacts in crowds, which keep the spring of the last evaluation too, as many numbers behind it.
template <class P> struct CrowdedSprings {
  StoredSprings<P> stored;
  std::ptrdiff_t behind;

  [[gnu::always_inline]] void store(const BasicVec3<P> &next, const BasicVec3<P> &now) const {
    stored.store(next);
    Rows<P>::scatter(now, [this](int lane) CFPM_INLINED { return stored.values[lane] + behind; });
  }
};

/// As that of one contact.
template <Friction friction, class P>
[[gnu::always_inline]] inline BasicVec3<P> move_on(const StoredSprings<P> &stored, const BasicPredictedLaw<P> &contact,
                                                   const BasicContactGeometry<P> &g, const P &limit) {
  BasicMidStepSpring<P> mid_step(stored.load(), contact.dt);
  const BasicVec3<P> spring = mid_step.template advance<friction>(contact.law, g.slip_velocity, g.normal, limit);
  stored.store(mid_step.stored());
  return spring;
}

/// One of the numbers that the parameters of each lane's contact consist of.
template <class P, class Kind>
[[gnu::always_inline]] inline P gather_member(const Kind *kinds, const int *kind, std::size_t member) {
  return Lanes<P>::fill([&](int lane) CFPM_INLINED {
    double number = 0.0;
    std::memcpy(&number, reinterpret_cast<const char *>(kinds + kind[lane]) + member * sizeof number, sizeof number);
    return number;
  });
}

/// All of them. Parameters: with a template Step over a number, an aggregate of such numbers alone.
template <class Parameters, class P, class Kind, std::size_t... member>
[[gnu::always_inline]] inline typename Parameters::template Step<P> gather_step(const Kind *kinds, const int *kind,
                                                                                std::index_sequence<member...>) {
  // NOLINTNEXTLINE(clang-diagnostic-missing-braces): however its parts are nested
  return {gather_member<P>(kinds, kind, member)...};
}
template <class Parameters, class P, class Kind>
[[gnu::always_inline]] inline typename Parameters::template Step<P> gather_step(const Kind *kinds, const int *kind) {
  constexpr std::size_t members = sizeof(Kind) / sizeof(double);
  static_assert(sizeof(typename Parameters::template Step<P>) == members * sizeof(P));
  return gather_step<Parameters, P>(kinds, kind, std::make_index_sequence<members>{});
}

/// The numbers of contacts that have them side by side, see ContactChunk::made. columns: from the first of these
/// contacts on; size: of a column.
template <class Parameters, std::size_t size, class P, std::size_t... member>
[[gnu::always_inline]] inline typename Parameters::template Step<P> load_columns(const double *columns,
                                                                                 std::index_sequence<member...>) {
  // NOLINTNEXTLINE(clang-diagnostic-missing-braces): however its parts are nested
  return {P::load(columns + member * size)...};
}
/// Likewise.
template <std::size_t size, class P, class Step>
[[gnu::always_inline]] inline void store_columns(const Step &step, double *columns) {
  static_assert(sizeof step % sizeof(P) == 0);
  for (std::size_t member = 0; member < sizeof step / sizeof(P); ++member) {
    P numbers;
    std::memcpy(&numbers, reinterpret_cast<const char *>(&step) + member * sizeof(P), sizeof(P));
    numbers.store(columns + member * size);
  }
}

/// See Particles::others(). contacts: see Crowd.
template <class P>
[[gnu::always_inline]] inline P others_of(const Particles &particles, const double *contacts, const int *i) {
  P others = larger(P(0.0), gather<P>(contacts, i) - 1.0);
  if (particles.frozen)
    others = others * Lanes<P>::fill([&](int lane) CFPM_INLINED {
               return particles.group[i[lane]] & particles.frozen ? 0.0 : 1.0;
             });
  return others / gather<P>(particles.mass, i);
}

/// What the contacts k, k + 1, ... do, with what else a method that says Packed asks for.
template <Friction friction, class Packed, class P, class ChunkStep, class Step>
[[gnu::always_inline]] inline BasicPairForce<P> act_in_pack(const Particles &, ContactChunk<ChunkStep> &chunk, int k,
                                                            const Step &step, const BasicSpherePair<P> &pair) {
  return Packed::template act<friction>(step, pair, StoredSprings<P>{chunk.spring + k});
}
template <Friction friction, class Packed, class P, class ChunkStep, class Step>
[[gnu::always_inline]] inline BasicPairForce<P> act_in_pack(const Particles &, RollingChunk<ChunkStep> &chunk, int k,
                                                            const Step &step, const BasicSpherePair<P> &pair) {
  const BasicRollingPairForce<P> action =
      Packed::template act<friction>(step, pair, RollingSprings<P>{{chunk.spring + k}});
  store(action.couple, chunk.couple, k);
  return action.pair;
}
template <Friction friction, class Packed, class P, class ChunkStep, class Step>
[[gnu::always_inline]] inline BasicPairForce<P> act_in_pack(const Particles &, TurningChunk<ChunkStep> &chunk, int k,
                                                            const Step &step, const BasicSpherePair<P> &pair) {
  const BasicTurningPairForce<P> action =
      Packed::template act<friction>(step, pair, TurningSprings<P>{{chunk.spring + k}, chunk.places});
  store(action.rolling, chunk.couple, k);
  store(action.twisting, chunk.twisting, k);
  return action.pair;
}
template <Friction friction, class Packed, class P, class ChunkStep, class Step>
[[gnu::always_inline]] inline BasicPairForce<P> act_in_pack(const Particles &particles, CrowdedChunk<ChunkStep> &chunk,
                                                            int k, const Step &step, const BasicSpherePair<P> &pair) {
  const P others =
      others_of<P>(particles, chunk.contacts, chunk.i + k) + others_of<P>(particles, chunk.contacts, chunk.j + k);
  return Packed::template act<friction>(step, pair, others, CrowdedSprings<P>{{chunk.spring + k}, chunk.spring_now});
}

/// The contacts k, k + 1, ... of a chunk, as many as there are lanes. step: their parameters; Packed: what a method
/// does with a pack of contacts, by act<friction>(step, pair, springs), which moves the springs on.
template <Friction friction, class Packed, class P, class Chunk, class Step>
[[gnu::always_inline]] inline void compute_pack(const Particles &particles, Chunk &chunk, int k, const Step &step) {
  const int *const i = chunk.i + k;
  const int *const j = chunk.j + k;
  // not const: the compiler would keep aggregates that are in memory
  BasicSpherePair<P> pair{load<P>(chunk.separation, k),
                          P::load(chunk.squared + k),
                          P::load(chunk.radius_i + k),
                          P::load(chunk.radius_j + k),
                          {gather<P>(particles.v, i), gather<P>(particles.omega, i)},
                          {gather<P>(particles.v, j), gather<P>(particles.omega, j)}};
  BasicPairForce<P> action = act_in_pack<friction, Packed>(particles, chunk, k, step, pair);
  store(action.mean.force, chunk.force, k);
  store(action.mean.torque_per_lever, chunk.torque_per_lever, k);
  action.lever_i.store(chunk.lever_i + k);
  action.lever_j.store(chunk.lever_j + k);
  action.counted.store(chunk.counted + k);
}

/// The parameters of the contacts k, k + 1, ... of a chunk.
template <class Parameters, class P, class Chunk>
[[gnu::always_inline]] inline typename Parameters::template Step<P> steps_of(const Chunk &chunk, int k) {
  constexpr std::size_t members = sizeof(*chunk.steps) / sizeof(double);
  if (chunk.made) return load_columns<Parameters, Chunk::size, P>(chunk.made + k, std::make_index_sequence<members>{});
  return gather_step<Parameters, P>(chunk.steps, chunk.kind + k);
}

template <Friction friction, class Packed, class Parameters, class P, class Chunk>
[[gnu::always_inline]] inline void compute_packs(const Particles &original, Chunk &chunk) {
  const Particles particles = original; // what is stored could else be its members
  const int count = chunk.count;
  if (chunk.one_kind) { // most beds
    auto step = gather_step<Parameters, P>(chunk.steps, chunk.kind);
    for (int k = 0; k < count; k += P::width) compute_pack<friction, Packed, P>(particles, chunk, k, step);
  } else {
    for (int k = 0; k < count; k += P::width) {
      auto step = steps_of<Parameters, P>(chunk, k);
      compute_pack<friction, Packed, P>(particles, chunk, k, step);
    }
  }
}

#ifdef CFPM_WITH_AVX2
template <Friction friction, class Packed, class Parameters, class Chunk>
CFPM_WITH_AVX2 [[gnu::noinline]] void compute_with_avx2(const Particles &particles, Chunk &chunk) {
  compute_packs<friction, Packed, Parameters, TwoPacks<Pack<4>>>(particles, chunk);
}
#endif

/// Whether it takes packs of one contact where there are no others.
template <class Packed, class = void> inline constexpr bool takes_packs_of_one = false;
template <class Packed> inline constexpr bool takes_packs_of_one<Packed, std::enable_if_t<Packed::takes_packs_of_one>> =
    true;

/// Forces and couples of the contacts found; moves their springs on. lanes: of an instruction set, with packs unless
/// the method takes those of one contact.
template <Friction friction, class Packed, class Parameters, class Chunk>
[[gnu::noinline]] void compute([[maybe_unused]] int lanes, const Particles &particles, Chunk &chunk) {
  chunk.fill_up();
#ifdef CFPM_WITH_AVX2
  if (lanes == 4) return compute_with_avx2<friction, Packed, Parameters>(particles, chunk);
#endif
  if constexpr (takes_packs_of_one<Packed>)
    if (lanes == 1) return compute_packs<friction, Packed, Parameters, Pack<1>>(particles, chunk);
  compute_packs<friction, Packed, Parameters, TwoPacks<Pack<2>>>(particles, chunk);
}

} // namespace cfpm
