// SPDX-License-Identifier: GPL-2.0-or-later
// The parameters of a chunk's contacts where there are too many classes of particles to keep those of each pair: made
// for every contact anew, several at a time, see method/made_steps.h.
#pragma once

#include "core/contact/parameter_cache.h"
#include "core/law/pair_material.h"
#include "core/numbers/instruction_set.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_kinds.h"
#include "core/step/particles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm {

/// Whether a method has what makes the numbers of any contact.
template <class M, class = void> inline constexpr bool makes_steps = false;
template <class M> inline constexpr bool makes_steps<M, std::void_t<decltype(std::declval<const M &>().maker())>> =
    true;

/// Those of two bodies; made: as they are made where there are too many classes, to the last bit those of a pack.
template <class M> decltype(auto) parameters_of(const M &method, const ContactPartners &partners, bool made) {
  if constexpr (makes_steps<M>)
    if (made) return method.made_parameters(partners);
  return method.parameters(partners);
}

/// Maker: see method/made_steps.h; size: of a chunk's columns.
template <class Maker, std::size_t size> class MadeSteps {
public:
  /// Says of each contact of a chunk what step it has; whether each has one. body_of(i): the ContactBody of particle i.
  template <class Chunk, class BodyOf>
  bool set(int lanes, const Particles &particles, Chunk &chunk, const BodyOf &body_of, const Maker &maker) {
    int different = 0;
    for (int k = 0; k < chunk.count; ++k) {
      const ContactPartners p = partners(body_of(chunk.i[k]), body_of(chunk.j[k]));
      reduced_mass_[static_cast<std::size_t>(k)] = p.reduced_mass;
      chunk.kind[k] = kind_of(p.type_i, p.type_j, maker); // of its materials
      different |= chunk.kind[k] ^ chunk.kind[0];
    }
    chunk.fill_up();
    const auto found = reduced_mass_.begin() + chunk.count;
    std::fill_n(found, Chunk::most_lanes - 1, found[-1]);
    one_material_ = different == 0;
    columns_.resize(members * size);
    chunk.made = columns_.data();
    return make(lanes, particles, chunk, maker);
  }

private:
  using Material = typename Maker::template Material<double>;
  static constexpr int unmet = -1;
  static constexpr std::size_t members = sizeof(typename Maker::template Step<double>) / sizeof(double);

  struct Materials {
    template <class R> using Step = typename Maker::template Material<R>;
  };

  int kind_of(int type_i, int type_j, const Maker &maker) {
    const int types = std::max(type_i, type_j) + 1;
    if (__builtin_expect(types > types_, 0)) meet(types);
    const int place = type_i * types_ + type_j;
    int &kind = kinds_[static_cast<std::size_t>(place)];
    if (__builtin_expect(kind == unmet, 0)) {
      kind = static_cast<int>(materials_.size());
      materials_.push_back(maker.material(type_i, type_j));
    }
    return kind;
  }

  /// Types below this one.
  void meet(int types) {
    const auto row = static_cast<std::ptrdiff_t>(types);
    std::vector<int> kinds(static_cast<std::size_t>(row * row), unmet);
    for (std::ptrdiff_t i = 0; i < types_; ++i)
      std::copy_n(kinds_.begin() + i * types_, types_, kinds.begin() + i * row);
    types_ = types;
    kinds_ = std::move(kinds);
  }

  template <class Chunk> [[gnu::noinline]] bool make([[maybe_unused]] int lanes, const Particles &particles,
                                                     Chunk &chunk, const Maker &maker) {
#ifdef CFPM_WITH_AVX2
    if (lanes == 4) return make_with_avx2(particles, chunk, maker);
#endif
    return make_packs<Pack<2>>(particles, chunk, maker);
  }
#ifdef CFPM_WITH_AVX2
  template <class Chunk>
  CFPM_WITH_AVX2 [[gnu::noinline]] bool make_with_avx2(const Particles &particles, Chunk &chunk, const Maker &maker) {
    return make_packs<Pack<4>>(particles, chunk, maker);
  }
#endif

  template <class P, class Chunk>
  [[gnu::always_inline]] bool make_packs(const Particles &particles, Chunk &chunk, const Maker &given) {
    const Maker maker = given; // copies: what is stored could else be their members
    const double *const radius = particles.radius;
    const double *const reduced_mass = reduced_mass_.data();
    const Material *const materials = materials_.data();
    double *const columns = columns_.data();
    const int filled = chunk.count + Chunk::most_lanes - P::width; // a chunk may be computed in wider packs
    bool all = true;
    auto material = gather_step<Materials, P>(materials, chunk.kind);
    for (int k = 0; k < filled; k += P::width) {
      if (!one_material_) material = gather_step<Materials, P>(materials, chunk.kind + k);
      const P radius_i = gather<P>(radius, chunk.i + k); // named: else g++ 16 takes them for uninitialized
      const P radius_j = gather<P>(radius, chunk.j + k);
      PairSizes<P> sizes{radius_i, radius_j, P::load(reduced_mass + k)};
      typename Maker::template Step<P> step;
      all &= maker.make(material, sizes, step);
      store_columns<size, P>(step, columns + k);
    }
    return all;
  }

  int types_ = 0;
  std::vector<int> kinds_;          ///< by the types of i and j
  std::vector<Material> materials_; ///< by kind
  bool one_material_ = false;       ///< whether all contacts of the chunk have the same
  std::array<double, size> reduced_mass_;
  std::vector<double> columns_; ///< see ContactChunk::made
};

/// Of a method that makes none.
struct NoMadeSteps {};
template <class M, std::size_t size, class = void> struct MadeStepsFor { using type = NoMadeSteps; };
template <class M, std::size_t size> struct MadeStepsFor<M, size, std::enable_if_t<makes_steps<M>>> {
  using type = MadeSteps<std::decay_t<decltype(std::declval<const M &>().maker())>, size>;
};

} // namespace cfpm
