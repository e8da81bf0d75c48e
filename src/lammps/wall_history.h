// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cfpm::lammps {

/// Tangential springs of the contacts that every particle has with one fix: a few slots per particle, each
/// for one surface of the wall.
class WallHistory {
public:
  /// with_now: whether StoredSpring::now is kept too.
  WallHistory(int slots, bool with_now)
      : slots_(static_cast<std::size_t>(slots)), slot_size_(1 + spring_size + (with_now ? spring_size : 0)) {}

  bool with_now() const { return slot_size_ > 1 + spring_size; }
  std::size_t values_per_particle() const { return slots_ * slot_size_; }
  void grow(int particles) { values_.resize(static_cast<std::size_t>(particles) * values_per_particle()); }
  double *of(int i) { return &values_[static_cast<std::size_t>(i) * values_per_particle()]; }
  void clear(int i) { std::fill_n(of(i), values_per_particle(), 0.0); }
  void copy(int from, int to) { std::copy_n(of(from), values_per_particle(), of(to)); }

  /// Drops the springs of particle i but those of these surfaces.
  void keep_only(int i, const std::vector<int> &surfaces) {
    for (std::size_t s = 0; s < slots_; ++s) {
      double *slot = of(i) + s * slot_size_;
      const int surface = static_cast<int>(slot[0]) - 1;
      if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end()) std::fill_n(slot, slot_size_, 0.0);
    }
  }

  /// The three values of particle i at a surface and, behind them, the three of StoredSpring::now if they are kept;
  /// zero if it is new there, null if no slot is left.
  double *spring(int i, int surface) {
    double *free = nullptr;
    for (std::size_t s = 0; s < slots_; ++s) {
      double *slot = of(i) + s * slot_size_;
      if (static_cast<int>(slot[0]) == surface + 1) return slot + 1;
      if (slot[0] == 0.0 && !free) free = slot;
    }
    if (!free) return nullptr;
    free[0] = surface + 1;
    return free + 1;
  }

private:
  static constexpr std::size_t spring_size = 3;

  std::size_t slots_;
  std::size_t slot_size_; // 1 + the surface, or 0; the spring or both
  std::vector<double> values_;
};

} // namespace cfpm::lammps
