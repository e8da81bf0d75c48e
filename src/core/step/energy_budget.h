// SPDX-License-Identifier: GPL-2.0-or-later
// Where the energy of particles goes. A step is an identity: with the force f and the torque T that a body is given
// over a time dt, and its velocities v, w before and v', w' after it,
//   m (v'^2 - v^2)/2 = f dt (v + v')/2,  I (w'^2 - w^2)/2 = T dt (w + w')/2,
// to rounding, be it a whole step under a mean force or half of one of velocity Verlet. So work is told apart by what
// does it: contacts, in their normals and by friction, and all else. Contacts hold elastic energy, a function of their
// state; what they have taken from the bodies and do not hold is lost.
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/numbers/vec3.h"
#include "core/step/particles.h"

#include <array>
#include <cstddef>
#include <vector>

namespace cfpm {

/// The budget of the particles of one rank; all entries are sums, so that those of ranks add up. Only where a deck asks
/// for it. In turn: the forces of a state are evaluated, then particles move under them.
class EnergyBudget {
public:
  static constexpr std::size_t entry_count = 8;
  /// Kinetic, of translation and of rotation; elastic, of normals and of tangential springs; lost since the budget was
  /// begun, along normals and by friction; work since then of walls and particles that others move, and of all forces
  /// but contacts [J].
  using Entries = std::array<double, entry_count>;
  /// What of them accumulates, the last four.
  using Accumulated = std::array<double, 4>;

  /// What is the same all the time: the energy that is there or lost, less what was given [J].
  static double balance(const Entries &e) { return e[0] + e[1] + e[2] + e[3] + e[4] + e[5] - e[6] - e[7]; }

  // the forces of a state: first those of contacts between particles

  /// local: particles of this rank; all: and their neighbours on others.
  void begin_evaluation(int local, int all) {
    local_ = local;
    rows_.assign(static_cast<std::size_t>(all) * values_per_particle, 0.0);
    elastic_ = {};
    of_walls_ = {};
  }
  /// What stands in the first count rows of f and torque before contacts add to it, and after.
  void before_contacts(const Particles &particles, int count) { add_all(particles, count, -1.0); }
  void after_contacts(const Particles &particles, int count) { add_all(particles, count, 1.0); }
  /// The part of it along the normal of a contact [N].
  void add_normal_force(int i, const Vec3 &force) { add(force, row(i) + normal_at); }
  /// What a contact holds, times the share of it that is this rank's [J].
  void add_elastic(double share, double normal, double tangential) {
    elastic_.normal += share * normal;
    elastic_.tangential += share * tangential;
  }
  /// What a wall does to a particle [N] while it moves at that velocity where they touch [m/s].
  void add_moving_wall(const Vec3 &normal_force, const Vec3 &friction, const Vec3 &velocity) {
    of_walls_.normal += dot(normal_force, velocity);
    of_walls_.tangential += dot(friction, velocity);
  }

  /// Values of a particle that neighbours on other ranks give back to it.
  static constexpr std::size_t values_per_particle = 9;
  double *row(int i) { return rows_.data() + static_cast<std::size_t>(i) * values_per_particle; }

  // the step under them

  /// The last evaluation is none for the step to come.
  void forget() { local_ = -1; }
  /// Whether it was for that many particles of this rank.
  bool is_for(int count) const { return local_ == count; }
  /// Before particles move.
  void remember(const Particles &particles) {
    if (!begun_) elastic_before_ = elastic_;
    begun_ = true;
    before_.clear();
    before_.reserve(static_cast<std::size_t>(local_));
    for (int i = 0; i < local_; ++i) before_.push_back(particles.motion(i));
  }
  /// After the same have moved over a time dt [s], those of a group by what stands in f and torque, the others by other
  /// means. group: a bit; shift: of positions, see MeanForce, or null; it is the contacts' doing, at the expense of
  /// other forces where it goes along them.
  void add_step(double dt, const Particles &particles, int group, const VectorRows *shift) {
    if (!particles.group) return; // there are none
    for (std::size_t k = 0; k < before_.size(); ++k) {
      const int i = static_cast<int>(k);
      const Vec3 force = vec3(row(i));
      const Vec3 torque = vec3(row(i) + torque_at);
      const Vec3 normal = vec3(row(i) + normal_at);
      if (particles.group[i] & group) {
        const Vec3 moved = 0.5 * dt * (before_[k].velocity + vec3(particles.v[i]));
        const Vec3 turned = 0.5 * dt * (before_[k].spin + vec3(particles.omega[i]));
        const bool shifts = shift && !(particles.group[i] & particles.frozen);
        const Vec3 shifted = shifts ? (1.0 / particles.mass[i]) * vec3((*shift)[i]) : Vec3{};
        const Vec3 other = vec3(particles.f[i]) - force;
        work_.normal += dot(normal, moved) - dot(other, shifted);
        work_.tangential += dot(force - normal, moved) + dot(torque, turned);
        of_others_ += dot(other, moved + shifted) + dot(vec3(particles.torque[i]) - torque, turned);
      } else {
        const double along = dt * dot(normal, before_[k].velocity);
        const double aside = dt * (dot(force - normal, before_[k].velocity) + dot(torque, before_[k].spin));
        work_.normal += along;
        work_.tangential += aside;
        of_moved_ -= along + aside;
      }
    }
    work_.normal -= dt * of_walls_.normal;
    work_.tangential -= dt * of_walls_.tangential;
    of_moved_ += dt * (of_walls_.normal + of_walls_.tangential);
  }

  // what is told

  /// Before the first step of a run: whatever has been changed since the last one is no loss.
  void begin_run() { begin_with(accumulated()); }
  /// Likewise, going on from what has accumulated before.
  void begin_with(const Accumulated &before) {
    accumulated_ = before;
    work_ = {};
    of_moved_ = of_others_ = 0.0;
    begun_ = false;
  }
  Accumulated accumulated() const {
    const Directions held =
        begun_ ? Directions{elastic_before_.normal - elastic_.normal, elastic_before_.tangential - elastic_.tangential}
               : Directions{};
    return {accumulated_[0] + held.normal - work_.normal, accumulated_[1] + held.tangential - work_.tangential,
            accumulated_[2] + of_moved_, accumulated_[3] + of_others_};
  }
  /// inertia_factor: see there; count: of particles of this rank, of which those of a group are told of.
  Entries entries(const Particles &particles, int count, int group, double inertia_factor) const {
    const Accumulated sums = accumulated();
    Entries all{0.0, 0.0, elastic_.normal, elastic_.tangential, sums[0], sums[1], sums[2], sums[3]};
    if (!particles.group) return all; // there are none
    for (int i = 0; i < count; ++i) {
      if (!(particles.group[i] & group)) continue;
      const Motion motion = particles.motion(i);
      const double radius = particles.radius[i];
      all[0] += 0.5 * particles.mass[i] * dot(motion.velocity, motion.velocity);
      all[1] += 0.5 * inertia_factor * particles.mass[i] * radius * radius * dot(motion.spin, motion.spin);
    }
    return all;
  }

private:
  struct Directions {
    double normal = 0.0;
    double tangential = 0.0;
  };

  static constexpr std::size_t torque_at = 3;
  static constexpr std::size_t normal_at = 6;

  const double *row(int i) const { return rows_.data() + static_cast<std::size_t>(i) * values_per_particle; }
  void add_all(const Particles &particles, int count, double sign) {
    for (int i = 0; i < count; ++i) {
      add(sign * vec3(particles.f[i]), row(i));
      add(sign * vec3(particles.torque[i]), row(i) + torque_at);
    }
  }

  int local_ = -1;             ///< before the first evaluation
  std::vector<double> rows_;   ///< of each particle force and torque of its contacts, and their normal force
  std::vector<Motion> before_; ///< the step
  Directions elastic_;         ///< in the state evaluated last [J]
  Directions of_walls_;        ///< power of those that move [W]

  // since the run began
  bool begun_ = false;
  Directions elastic_before_; ///< [J]
  Directions work_;           ///< of contacts on all bodies [J]
  double of_moved_ = 0.0, of_others_ = 0.0;
  Accumulated accumulated_{}; ///< before it
};

} // namespace cfpm
