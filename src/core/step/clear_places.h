// SPDX-License-Identifier: GPL-2.0-or-later
// Most particles are far from a wall, and stay so for many steps: what is known of a place spares asking the wall.
#pragma once

#include "core/numbers/vec3.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace cfpm {

/// For each particle a place at which it had no contact with a wall, and how far the wall was from there.
///
/// A distance changes by no more than the way one goes: a particle at s from a place whose clearance is c is at least
/// c - s from the wall, and where c - s exceeds its radius and all that the two may come together by within the step,
/// it does not touch. That is a statement on places: it holds for whatever particle has the number by now, of whatever
/// radius, speed and step, and however it came there. Places are those that the wall sees: of one that moves, in its
/// own frame.
class ClearPlaces {
public:
  /// Keeps what is known of the first ones.
  void resize(int particles) { places_.resize(static_cast<std::size_t>(particles), unknown); }
  void forget_all() { std::fill(places_.begin(), places_.end(), unknown); }
  void forget(int i) { places_[static_cast<std::size_t>(i)] = unknown; }
  void copy(int from, int to) { places_[static_cast<std::size_t>(to)] = places_[static_cast<std::size_t>(from)]; }
  std::size_t memory() const { return places_.size() * sizeof(Place); }

  /// Of particle i at x, which is without contact; clearance: no more than the distance to any point of the wall at
  /// which a particle may touch it [m].
  void remember(int i, const Vec3 &x, double clearance) {
    Place place{static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z), 0.0F};
    // what is left of it, from the place as it is kept, rounded down
    const double left = (1.0 - rounding) * (clearance - norm(x - place.at()));
    place.clearance = static_cast<float>(std::min(left, largest));
    places_[static_cast<std::size_t>(i)] = place;
  }

  /// Whether the particle with that number, now at x, cannot touch the wall. within: its radius and what the two may
  /// come together by in the step [m].
  bool is_clear(int i, const Vec3 &x, double within) const {
    const Place &place = places_[static_cast<std::size_t>(i)];
    const double way = place.clearance - within;
    const Vec3 gone = x - place.at();
    return way > 0.0 && dot(gone, gone) < way * way;
  }

private:
  struct Place {
    float x, y, z, clearance; // half the memory of doubles, for every particle at every wall
    Vec3 at() const { return {x, y, z}; }
  };
  static constexpr Place unknown{0.0F, 0.0F, 0.0F, -1.0F};
  /// That of a float is 6e-8; of distances that are found it is less as long as places are below 1e9 clearances.
  static constexpr double rounding = 1e-6;
  static constexpr double largest = std::numeric_limits<float>::max();

  std::vector<Place> places_;
};

} // namespace cfpm
