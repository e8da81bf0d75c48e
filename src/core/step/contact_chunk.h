// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/history_places.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <cstddef>

namespace cfpm {

/// Vectors of a chunk's contacts, component by component, as packs are read and written.
template <std::size_t size> struct VectorColumns {
  double x[size];
  double y[size];
  double z[size];

  void set(std::ptrdiff_t k, const Vec3 &a) {
    x[k] = a.x;
    y[k] = a.y;
    z[k] = a.z;
  }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
};

/// Contacts of equal rank in the order of the list of pairs: found, then computed together, then applied one by one.
struct alignas(64) ContactColumns {
  static constexpr int capacity = 128;
  static constexpr int most_lanes = 8;
  static constexpr std::size_t size = capacity + most_lanes; ///< the last pack may be full of copies

  // found
  VectorColumns<size> separation; ///< xi - xj [m]
  double squared[size];           ///< of its length [m^2]
  double radius_i[size], radius_j[size];

  // computed, see MeanForce
  VectorColumns<size> force;            ///< on i [N]
  VectorColumns<size> torque_per_lever; ///< [N]
  double lever_i[size], lever_j[size];
  double counted[size]; ///< see BasicPairForce

  // found as well
  double *spring[size];         ///< see StoredSpring, null without one
  const double *made = nullptr; ///< where not null the steps' numbers, a column of size for each
  bool one_kind = false;        ///< whether all have the same
  int kind[size] = {};          ///< which of the steps a contact has
  int i[size], j[size];         ///< the bodies
  int count = 0;

  VectorColumns<size> couple; ///< computed where contacts resist that their bodies turn, on i; on j the opposite [N m]

  /// Fills the last pack with copies of the last contact, which give the same numbers to the same places.
  void fill_up() {
    for (int k = count; k < count + most_lanes - 1; ++k) {
      const int last = count - 1;
      i[k] = i[last];
      j[k] = j[last];
      separation.set(k, separation[last]);
      squared[k] = squared[last];
      radius_i[k] = radius_i[last];
      radius_j[k] = radius_j[last];
      spring[k] = spring[last];
      kind[k] = kind[last];
    }
  }
};

/// With their parameters. Step: the numbers that those of a contact consist of, such as BasicLinearStep<double>.
template <class Step> struct ContactChunk : ContactColumns {
  const Step *steps = nullptr; ///< of its kinds, see ContactKinds
};

/// The same of contacts whose method resists rolling.
template <class Step> struct RollingChunk : ContactChunk<Step> {};

/// The same of contacts whose method resists rolling and twisting, whose couple is that of rolling alone.
template <class Step> struct TurningChunk : ContactChunk<Step> {
  HistoryPlaces places;
  VectorColumns<ContactColumns::size> twisting; ///< couple on i; on j the opposite [N m]
};

/// The same of contacts in crowds.
template <class Step> struct CrowdedChunk : ContactChunk<Step> {
  const double *contacts = nullptr; ///< see Crowd
  std::ptrdiff_t spring_now = 0;    ///< of StoredSpring::now, from the spring on
};

} // namespace cfpm
