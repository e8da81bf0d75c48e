// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>

namespace cfpm {

/// Cartesian 3-vector; the unit is that of the quantity it holds.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

constexpr Vec3 operator+(const Vec3 &a, const Vec3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3 &a, const Vec3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3 &a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3 &a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr bool operator==(const Vec3 &a, const Vec3 &b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

constexpr double dot(const Vec3 &a, const Vec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3 &a, const Vec3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3 &a) { return std::sqrt(dot(a, a)); }
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
constexpr Vec3 tangential_part(const Vec3 &a, const Vec3 &n) { return a - dot(a, n) * n; }

} // namespace cfpm
