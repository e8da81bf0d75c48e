// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts with walls in chunks, computed in packs: to the last bit what one after the other gives. See PackedPairs.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_chunk.h"
#include "core/step/packed_methods.h"
#include "core/step/particles.h"
#include "core/step/turn_resistances.h"
#include "core/step/wall_contact.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace cfpm {

/// Contacts with walls, see ContactChunk. Their geometry is found one by one, as walls have many shapes.
template <class Step> struct alignas(64) WallChunk {
  static constexpr int capacity = 128;
  static constexpr int most_lanes = 8;
  static constexpr std::size_t size = capacity + most_lanes;

  // found
  VectorColumns<size> normal, slip_velocity;
  double overlap[size], closing_speed[size];

  // computed, see MeanForce
  VectorColumns<size> force, torque_per_lever;

  // found as well
  double *spring[size];
  static constexpr const double *made = nullptr; ///< none
  Step steps[capacity];
  bool one_kind = false;
  int kind[size];
  int count = 0;

  void set(int k, const Contact &c) {
    normal.set(k, c.geometry.normal);
    slip_velocity.set(k, c.geometry.slip_velocity);
    overlap[k] = c.geometry.overlap;
    closing_speed[k] = c.geometry.closing_speed;
    spring[k] = c.spring.values;
  }

  /// Likewise.
  void fill_up() {
    const int last = count - 1;
    for (int k = count; k < count + most_lanes - 1; ++k) {
      normal.set(k, normal[last]);
      slip_velocity.set(k, slip_velocity[last]);
      overlap[k] = overlap[last];
      closing_speed[k] = closing_speed[last];
      spring[k] = spring[last];
      kind[k] = kind[last];
    }
  }
};

/// As that of contacts between particles.
template <Friction friction, class Packed, class P, class ChunkStep, class Step> [[gnu::always_inline]] inline void
compute_pack(const Particles &, WallChunk<ChunkStep> &chunk, int k, const Step &step) {
  // not const: the compiler would keep aggregates that are in memory
  BasicContactGeometry<P> g{};
  g.normal = load<P>(chunk.normal, k);
  g.slip_velocity = load<P>(chunk.slip_velocity, k);
  g.overlap = P::load(chunk.overlap + k);
  g.closing_speed = P::load(chunk.closing_speed + k);
  BasicMeanForce<P> mean = Packed::template mean_force<friction>(step, g, StoredSprings<P>{chunk.spring + k});
  store(mean.force, chunk.force, k);
  store(mean.torque_per_lever, chunk.torque_per_lever, k);
}

/// Whether contacts of the method with walls can be computed in packs.
template <class M, class = void> inline constexpr bool packs_walls = false;
template <class M> inline constexpr bool packs_walls<M, std::enable_if_t<has_packs<M> && M::Packed::takes_geometry>> =
    true;

/// See add_wall_forces(), whose arguments these are. lanes: of an instruction set with packs.
template <Friction friction, class M> class PackedWalls {
public:
  /// resistances: null for none; dt: of the step [s]
  PackedWalls(int lanes, const Particles &particles, const M &method, const TurnResistances *resistances, double dt)
      : lanes_(lanes), particles_(particles), method_(method), resistances_(resistances), dt_(dt) {}

  [[gnu::noinline]] void add_forces(const std::vector<WallContact> &contacts) {
    const std::size_t all = contacts.size();
    for (std::size_t first = 0; first < all; first += Chunk::capacity) {
      chunk_.count = static_cast<int>(std::min(all - first, std::size_t{Chunk::capacity}));
      find(&contacts[first]);
      compute<friction, typename M::Packed, Parameters>(lanes_, particles_, chunk_);
      apply(&contacts[first]);
    }
  }

private:
  using Parameters = ParametersOf<M>;
  using Chunk = WallChunk<typename Parameters::template Step<double>>;

  void find(const WallContact *contacts) {
    int kinds = 0;
    for (int k = 0; k < chunk_.count; ++k) {
      chunk_.set(k, contacts[k].contact);
      // most contacts have the parameters of the one before
      if (k == 0 || !(contacts[k].partners == contacts[k - 1].partners))
        chunk_.steps[kinds++] = method_.parameters(contacts[k].partners).step();
      chunk_.kind[k] = kinds - 1;
    }
    chunk_.one_kind = kinds == 1;
  }

  void apply(const WallContact *contacts) const {
    for (int k = 0; k < chunk_.count; ++k) {
      const WallContact &c = contacts[k];
      const MeanForce mean{chunk_.force[k], chunk_.torque_per_lever[k]};
      add(mean.force, particles_.f[c.i]);
      add(mean.couple(c.contact.geometry.lever_i), particles_.torque[c.i]);
      if (resistances_)
        add(resistances_->couple_at_wall(particles_, c.i, c.partners, c.contact, mean.force, dt_),
            particles_.torque[c.i]);
    }
  }

  int lanes_;
  const Particles particles_;
  const M &method_;
  const TurnResistances *const resistances_;
  const double dt_;
  Chunk chunk_;
};

} // namespace cfpm
