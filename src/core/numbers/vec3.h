// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <cmath>

namespace cfpm {

/// Cartesian 3-vector; the unit is that of the quantity it holds. R: double, or a Pack of several vectors' components.
template <class R> struct BasicVec3 {
  R x = 0.0;
  R y = 0.0;
  R z = 0.0;

  [[gnu::always_inline]] friend constexpr BasicVec3 operator+(const BasicVec3 &a, const BasicVec3 &b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend constexpr BasicVec3 operator-(const BasicVec3 &a, const BasicVec3 &b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend constexpr BasicVec3 operator-(const BasicVec3 &a) { return {-a.x, -a.y, -a.z}; }
  [[gnu::always_inline]] friend constexpr BasicVec3 operator*(const R &s, const BasicVec3 &a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend constexpr bool operator==(const BasicVec3 &a, const BasicVec3 &b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

using Vec3 = BasicVec3<double>;

template <class R> [[gnu::always_inline]] constexpr R dot(const BasicVec3<R> &a, const BasicVec3<R> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R> [[gnu::always_inline]] constexpr BasicVec3<R> cross(const BasicVec3<R> &a, const BasicVec3<R> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R> [[gnu::always_inline]] inline R norm(const BasicVec3<R> &a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
/// Of a where the condition holds, of b elsewhere. Mask: bool, or that of a Pack.
template <class Mask, class R> [[gnu::always_inline]] constexpr BasicVec3<R>
select(const Mask &condition, const BasicVec3<R> &a, const BasicVec3<R> &b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
/// Not less than the norm, at most sqrt(3) times as much, without a root.
inline double bound_of_norm(const Vec3 &a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

inline bool is_finite(const Vec3 &a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// Three numbers in a row, as hosts keep vectors.
inline Vec3 vec3(const double *row) { return {row[0], row[1], row[2]}; }
inline void set(const Vec3 &a, double *row) {
  row[0] = a.x;
  row[1] = a.y;
  row[2] = a.z;
}
inline void add(const Vec3 &a, double *row) { set(vec3(row) + a, row); }

/// Part of a in the plane with unit normal n.
template <class R>
[[gnu::always_inline]] constexpr BasicVec3<R> tangential_part(const BasicVec3<R> &a, const BasicVec3<R> &n) {
  return a - dot(a, n) * n;
}

} // namespace cfpm
