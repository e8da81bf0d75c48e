// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cfpm::lammps {

/// History of the contacts that every particle has with one fix: a few slots per particle, each for one surface of the
/// wall.
class WallHistory {
public:
  WallHistory(int slots, int values_per_contact)
      : slots_(static_cast<std::size_t>(slots)), slot_size_(1 + static_cast<std::size_t>(values_per_contact)) {}

  int values_per_contact() const { return static_cast<int>(slot_size_) - 1; }
  std::size_t values_per_particle() const { return slots_ * slot_size_; }
  void grow(int particles) { values_.resize(static_cast<std::size_t>(particles) * values_per_particle()); }
  double *of(int i) { return &values_[static_cast<std::size_t>(i) * values_per_particle()]; }
  void clear(int i) { std::fill_n(of(i), values_per_particle(), 0.0); }
  void copy(int from, int to) { std::copy_n(of(from), values_per_particle(), of(to)); }

  /// Ends the contacts of particle i but those with these surfaces.
  void keep_only(int i, const std::vector<int> &surfaces) {
    for (std::size_t s = 0; s < slots_; ++s) {
      double *slot = of(i) + s * slot_size_;
      if (slot[0] == 0.0) continue; // most of them, all zero
      const int surface = static_cast<int>(slot[0]) - 1;
      if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end()) std::fill_n(slot, slot_size_, 0.0);
    }
  }

  /// The values of the contact of particle i with a surface; zero if it is new there, null if no slot is left.
  double *contact(int i, int surface) {
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
  std::size_t slots_;
  std::size_t slot_size_; // 1 + the surface, or 0; the values
  std::vector<double> values_;
};

} // namespace cfpm::lammps
