// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/method/impulses/crowd.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cfpm {

/// A host's array of vectors. Its rows lie one behind the other in one block, so that an index finds
/// them without a look at the table of their addresses.
class VectorRows {
public:
  VectorRows() = default;
  explicit VectorRows(double **rows) : first_(rows[0]) {}
  explicit VectorRows(double *first) : first_(first) {}
  double *operator[](int i) const { return first_ + static_cast<std::ptrdiff_t>(i) * 3; }

private:
  double *first_ = nullptr;
};

/// One particle of a contact, as far as its parameters depend on it. All fields are as wide: narrow ones the
/// compiler compares together, through memory just written in parts, and the processor waits for it.
struct ContactBody {
  double radius; ///< [m]
  double mass;   ///< that the contact sees, see Crowd::share() [kg]
  std::int64_t type;
  std::int64_t frozen; ///< not 0 if so

  /// 0 where the two are equal, bit by bit.
  [[gnu::always_inline]] std::uint64_t difference(const ContactBody &other) const {
    return (bits(radius) ^ bits(other.radius)) | (bits(mass) ^ bits(other.mass)) |
           static_cast<std::uint64_t>((type ^ other.type) | (frozen ^ other.frozen));
  }
  bool operator==(const ContactBody &other) const { return difference(other) == 0; }
};

inline ContactPartners partners(const ContactBody &i, const ContactBody &j) {
  const double reduced = j.frozen ? i.mass : i.frozen ? j.mass : i.mass * j.mass / (i.mass + j.mass);
  return {static_cast<int>(i.type), static_cast<int>(j.type), i.radius, j.radius, reduced};
}

/// The particles of a host: those of this rank and, behind them, their neighbours on others.
struct Particles {
  VectorRows x, v, omega;         ///< [m], [m/s], [rad/s]
  VectorRows f, torque;           ///< what is added to [N], [N m]
  const double *radius = nullptr; ///< [m]
  const double *mass = nullptr;   ///< [kg]
  const int *type = nullptr;
  const int *group = nullptr; ///< bits
  int count = 0;              ///< of all of them
  int frozen = 0;             ///< the bit of particles that act with infinite mass
  int receiving = 0;          ///< the first index of particles that get no force here

  Motion motion(int i) const { return {vec3(v[i]), vec3(omega[i])}; }
  /// Adds what a contact does to its bodies, see MeanForce: in parts, as together they would go through memory, and the
  /// processor wait for it. force: on i [N]
  [[gnu::always_inline]] void add_contact(int i, int j, const Vec3 &force, const Vec3 &torque_per_lever, double lever_i,
                                          double lever_j) const {
    add(force, f[i]);
    add(-lever_i * torque_per_lever, torque[i]);
    if (j >= receiving) return;
    add(-force, f[j]);
    add(-lever_j * torque_per_lever, torque[j]);
  }
  /// on i; on j acts the opposite [N]
  [[gnu::always_inline]] void add_force(int i, int j, const Vec3 &force) const {
    add(force, f[i]);
    if (j < receiving) add(-force, f[j]);
  }
  [[gnu::always_inline]] void add_torques(int i, int j, const Vec3 &on_i, const Vec3 &on_j) const {
    add(on_i, torque[i]);
    if (j < receiving) add(on_j, torque[j]);
  }
  [[gnu::always_inline]] ContactBody body(int i) const { return {radius[i], mass[i], type[i], group[i] & frozen}; }
  /// The same as a method sees it that asks for the crowd.
  [[gnu::always_inline]] ContactBody body(int i, const Crowd &crowd) const {
    return {radius[i], crowd.share(i, mass[i]), type[i], group[i] & frozen};
  }
  /// See Crowd; nothing moves a frozen particle.
  [[gnu::always_inline]] double others(int i, const Crowd &crowd) const {
    return group[i] & frozen ? 0.0 : crowd.others(i, mass[i]);
  }
};

/// Those of a host whose arrays have the names of LAMMPS. frozen: a group bit; newton: whether forces on neighbours on
/// other ranks go back to these.
template <class Atom> Particles particles_of(const Atom &atom, int frozen, bool newton) {
  Particles particles;
  if (atom.nlocal + atom.nghost == 0) return particles; // there may be no rows
  particles.x = VectorRows(atom.x);
  particles.v = VectorRows(atom.v);
  particles.omega = VectorRows(atom.omega);
  particles.f = VectorRows(atom.f);
  particles.torque = VectorRows(atom.torque);
  particles.radius = atom.radius;
  particles.mass = atom.rmass;
  particles.type = atom.type;
  particles.group = atom.mask;
  particles.count = atom.nlocal + atom.nghost;
  particles.frozen = frozen;
  particles.receiving = newton ? particles.count : atom.nlocal;
  return particles;
}

/// How far two of the first count particles come together in a step dt [s] at most [m].
inline double largest_approach(const double *const *v, int count, double dt) {
  double squared = 0.0;
  for (int i = 0; i < count; ++i) squared = std::max(squared, dot(vec3(v[i]), vec3(v[i])));
  return 2.0 * dt * std::sqrt(squared);
}

} // namespace cfpm
