// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_cache.h"
#include "contact_geometry.h"
#include "contact_method.h"
#include "crowd.h"
#include "mean_friction.h"

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

/// One particle of a contact, as far as the kind of contact depends on it. All fields are as wide: narrow ones the
/// compiler compares together, through memory just written in parts, and the processor waits for it.
struct ContactBody {
  double radius; ///< [m]
  double mass;   ///< [kg]
  std::int64_t type;
  std::int64_t frozen; ///< not 0 if so

  bool operator==(const ContactBody &other) const {
    return radius == other.radius && mass == other.mass && type == other.type && frozen == other.frozen;
  }
};

/// The particles of a host and its list of pairs that may touch, with a contact history beside it.
struct ListedPairs {
  VectorRows x, v, omega;         ///< [m], [m/s], [rad/s]
  VectorRows f, torque;           ///< what is added to [N], [N m]
  VectorRows shift;               ///< likewise by a method that gives impulses, see MeanForce [kg m]
  const double *radius = nullptr; ///< [m]
  const double *mass = nullptr;   ///< [kg]
  Crowd crowd;                    ///< for a method that gives impulses
  double *contacts = nullptr;     ///< counted in this step; null: nobody asks for them
  double ahead = 0.0;             ///< see largest_approach(), 0 if no contact begins inside a step [m]
  const int *type = nullptr;
  const int *group = nullptr;          ///< bits
  int frozen = 0;                      ///< the bit of particles that act with infinite mass
  int receiving = 0;                   ///< the first index of particles that get no force from here
  int count = 0;                       ///< of particles with a list
  const int *first = nullptr;          ///< their indices
  const int *neighbor_count = nullptr; ///< of a particle
  int *const *neighbors = nullptr;     ///< of a particle; an index is in the bits of index_mask
  int index_mask = 0;
  int **flags = nullptr;      ///< of a particle's contacts in the order of its neighbors; null: no history
  double **history = nullptr; ///< likewise, history_size values each
  int history_size = 0;
  int spring_offset = -1;     ///< of the tangential spring among them, < 0 without
  int spring_now_offset = -1; ///< likewise of StoredSpring::now
  int touching = 0;           ///< the bits of a flag that say that a pair is in contact

  [[gnu::always_inline]] ContactBody body(int i) const {
    return {radius[i], crowd.share(i, mass[i]), type[i], group[i] & frozen};
  }
  /// See Crowd; nothing moves a frozen particle.
  [[gnu::always_inline]] double others(int i) const { return group[i] & frozen ? 0.0 : crowd.others(i, mass[i]); }
  /// Where the spring of neighbor jj of i is kept, null without one.
  double *spring(int i, int jj) const { return history_value(i, jj, spring_offset); }
  double *spring_now(int i, int jj) const { return history_value(i, jj, spring_now_offset); }
  double *history_value(int i, int jj, int offset) const {
    return flags && offset >= 0 ? history[i] + static_cast<std::ptrdiff_t>(jj) * history_size + offset : nullptr;
  }
  /// For a pair that is apart.
  void end_contact(int &flag, int i, int jj) const {
    flag &= ~touching;
    for (double *const values : {spring(i, jj), spring_now(i, jj)})
      if (values) std::fill_n(values, 3, 0.0);
  }
};

/// How far two of the first count particles come together in a step dt [s] at most [m].
inline double largest_approach(const double *const *v, int count, double dt) {
  double squared = 0.0;
  for (int i = 0; i < count; ++i) squared = std::max(squared, dot(vec3(v[i]), vec3(v[i])));
  return 2.0 * dt * std::sqrt(squared);
}

inline ContactPartners partners(const ContactBody &i, const ContactBody &j) {
  const double reduced = j.frozen ? i.mass : i.frozen ? j.mass : i.mass * j.mass / (i.mass + j.mass);
  return {static_cast<int>(i.type), static_cast<int>(j.type), i.radius, j.radius, reduced};
}

/// Adds the mean forces of all listed pairs over a step to f and torque, and what they shift to shift.
/// Method: MeanOfTwoForces or ExactImpulse; stored: how to read springs, with values left open; dt: of the step [s];
/// tally(i, j, force on i, xi - xj): called for every contact.
template <Friction friction, class Method, class Tally>
void add_predicted_pair_forces(const ListedPairs &pairs, StoredSpring stored, const Method &method, double dt,
                               const Tally &tally) {
  // most contacts are of the kind of the one before
  ContactBody last_i{};
  ContactBody last_j{};
  decltype(&method.kind(partners(last_i, last_j))) kind = nullptr;

  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    const Vec3 xi = vec3(pairs.x[i]);
    const Motion motion_i{vec3(pairs.v[i]), vec3(pairs.omega[i])};
    const ContactBody body_i = pairs.body(i);
    if (!(body_i == last_i)) kind = nullptr;
    last_i = body_i;
    Vec3 force_i = vec3(pairs.f[i]);
    Vec3 torque_i = vec3(pairs.torque[i]);
    int contacts_i = 0;
    [[maybe_unused]] const double others_i = Method::gives_impulses ? pairs.others(i) : 0.0;
    const int *const neighbors = pairs.neighbors[i];
    const int neighbor_count = pairs.neighbor_count[i];
    int *const flags = pairs.flags ? pairs.flags[i] : nullptr;

    for (int jj = 0; jj < neighbor_count; ++jj) {
      const int j = neighbors[jj] & pairs.index_mask;
      Vec3 separation = xi - vec3(pairs.x[j]);
      double squared = dot(separation, separation);
      const double reach = body_i.radius + pairs.radius[j];
      double span = dt;
      if (squared >= reach * reach) {
        double wait = dt;
        if constexpr (Method::gives_impulses)
          if (squared < (reach + pairs.ahead) * (reach + pairs.ahead)) {
            const Vec3 velocity = motion_i.velocity - vec3(pairs.v[j]);
            wait = time_to_touch(separation, velocity, reach, dt);
            separation = separation + wait * velocity;
          }
        if (!(wait < dt)) {
          if (flags && flags[jj]) pairs.end_contact(flags[jj], i, jj);
          continue;
        }
        squared = reach * reach;
        span = dt - wait;
      }

      if (flags) flags[jj] |= pairs.touching;
      // needed last, and in a large bed it comes from far away
      if constexpr (friction == Friction::spring_and_dashpot) __builtin_prefetch(pairs.spring(i, jj), 1);
      const ContactBody body_j = pairs.body(j);
      if (!kind || !(body_j == last_j)) {
        last_j = body_j;
        kind = &method.kind(partners(body_i, body_j));
      }
      const ContactGeometry geometry = touching_spheres(separation, std::sqrt(squared), body_i.radius, body_j.radius,
                                                        motion_i, {vec3(pairs.v[j]), vec3(pairs.omega[j])});
      double others = 0.0;
      if constexpr (Method::gives_impulses) others = others_i + pairs.others(j);
      const auto normal = method.normal(*kind, geometry, span, others);
      if constexpr (friction == Friction::spring_and_dashpot) {
        stored.values = pairs.spring(i, jj);
        if constexpr (Method::gives_impulses) stored.now = pairs.spring_now(i, jj);
      }
      const MeanForce mean = method.template mean_force<friction>(*kind, normal, geometry, span, stored);
      tally(i, j, mean.force, separation);
      force_i = force_i + mean.force;
      torque_i = torque_i + -geometry.lever_i * mean.moment;
      if constexpr (Method::gives_impulses) {
        if (others == 0.0) add(mean.shift, pairs.shift[i]);
      }
      const bool counted = (Method::gives_impulses || pairs.contacts) && normal.in_contact();
      if (counted) ++contacts_i;
      if (j >= pairs.receiving) continue;
      add(-mean.force, pairs.f[j]);
      add(-geometry.lever_j * mean.moment, pairs.torque[j]);
      if constexpr (Method::gives_impulses) {
        if (others == 0.0) add(-mean.shift, pairs.shift[j]);
      }
      if (counted) ++pairs.contacts[j];
    }
    set(force_i, pairs.f[i]);
    set(torque_i, pairs.torque[i]);
    if (Method::gives_impulses || pairs.contacts) pairs.contacts[i] += contacts_i;
  }
}

/// Ends the contacts of listed pairs that are apart, for a step whose forces another loop adds.
inline void end_separated_contacts(const ListedPairs &pairs) {
  if (!pairs.flags) return;
  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    for (int jj = 0; jj < pairs.neighbor_count[i]; ++jj) {
      int &flag = pairs.flags[i][jj];
      if (!(flag & pairs.touching)) continue;
      const int j = pairs.neighbors[i][jj] & pairs.index_mask;
      const Vec3 separation = vec3(pairs.x[i]) - vec3(pairs.x[j]);
      const double reach = pairs.radius[i] + pairs.radius[j];
      if (dot(separation, separation) >= reach * reach) pairs.end_contact(flag, i, jj);
    }
  }
}

} // namespace cfpm
