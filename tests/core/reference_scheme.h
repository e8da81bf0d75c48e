// SPDX-License-Identifier: GPL-2.0-or-later
// The contact force prediction method for one contact without a host: two spheres, or a sphere and
// a plane, in three dimensions with rotation (Eqs. 20, 27). Geometry, motion and the accumulation of
// slip are written here a second time; only the forces from a state and their prediction are the core's.
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/linear_prediction.h"
#include "core/method/forces/predicted_law.h"
#include "core/numbers/vec3.h"
#include "core/predict/predictor.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace cfpm::reference {

struct Sphere {
  double radius; ///< [m]
  double mass;   ///< [kg], infinity for a sphere that is held
  Vec3 x;
  Vec3 v;
  Vec3 omega;
  Vec3 force{};
  Vec3 torque{};

  double inertia() const { return 0.4 * mass * radius * radius; } ///< solid sphere [kg m^2]
};

/// A wall that moves with constant velocity.
struct Plane {
  Vec3 x;
  Vec3 normal; ///< unit vector to the side of the sphere
  Vec3 v;
};

enum class Form { linear, hertz, hertz_stiffness };

/// What is in contact and how: everything but the state of the motion is constant.
struct System {
  Form form = Form::linear;
  LinearLaw law{};               ///< the coefficients: of Hertz contacts those at an overlap of 1 m
  bool limited_together = false; ///< Coulomb's limit holds the tangential spring with its dashpot, not alone
  const Predictor *predictor = nullptr;
  Vec3 gravity{}; ///< on the first sphere and, unless it is held, the second [m/s^2]
  Sphere first{};
  std::optional<Sphere> second;
  std::optional<Plane> plane;
};

class Scheme {
public:
  explicit Scheme(const System &system) : system_(system) {}

  const System &system() const { return system_; }

  /// Begins a run with steps dt: forces over its first step, slip as it was.
  void start(double dt) {
    dt_ = dt;
    evaluate(false);
  }

  /// One step; f and torque then hold the means over the next one.
  void step() {
    move(system_.first);
    if (system_.second) move(*system_.second);
    if (system_.plane) system_.plane->x = system_.plane->x + dt_ * system_.plane->v;
    evaluate(true);
  }

private:
  /// x += dt (v + v')/2 with v' = v + dt f/m; f is the mean of Eq. 20 over the step.
  void move(Sphere &s) const {
    const Vec3 v = s.v + (dt_ / s.mass) * s.force;
    s.x = s.x + 0.5 * dt_ * (s.v + v);
    s.v = v;
    s.omega = s.omega + (dt_ / s.inertia()) * s.torque;
  }

  /// The contact as the first sphere sees it; the levers end in the middle of the overlap.
  struct Contact {
    Vec3 normal; ///< towards the first sphere
    double overlap;
    double lever_first;
    double lever_second;
    Vec3 relative_velocity; ///< of the centres
    double reduced_mass;
    double tangential_reduced_mass;
  };

  Contact contact() const {
    const Sphere &a = system_.first;
    if (system_.plane) {
      const Plane &wall = *system_.plane;
      const double overlap = a.radius - dot(a.x - wall.x, wall.normal);
      const double mt = 1.0 / (1.0 / a.mass + a.radius * a.radius / a.inertia());
      return {wall.normal, overlap, a.radius - 0.5 * overlap, 0.0, a.v - wall.v, a.mass, mt};
    }
    const Sphere &b = *system_.second;
    const Vec3 between = a.x - b.x;
    const double overlap = a.radius + b.radius - norm(between);
    const double per_mass = 1.0 / a.mass + 1.0 / b.mass;
    const double per_rotation = a.radius * a.radius / a.inertia() + b.radius * b.radius / b.inertia();
    return {(1.0 / norm(between)) * between, overlap,   a.radius - 0.5 * overlap,
            b.radius - 0.5 * overlap,        a.v - b.v, 1.0 / per_mass,
            1.0 / (per_mass + per_rotation)};
  }

  void evaluate(bool slips) {
    Sphere &a = system_.first;
    a.force = a.mass * system_.gravity;
    a.torque = {};
    if (system_.second) {
      const bool held = system_.second->mass == std::numeric_limits<double>::infinity();
      system_.second->force = held ? Vec3{} : system_.second->mass * system_.gravity;
      system_.second->torque = {};
    }

    const Contact c = contact();
    if (c.overlap <= 0.0) {
      spring_ = {};
      last_slip_velocity_ = {};
      return;
    }
    const Vec3 spin = c.lever_first * a.omega + (system_.second ? c.lever_second * system_.second->omega : Vec3{});
    const Vec3 slip_velocity = tangential_part(c.relative_velocity, c.normal) - cross(spin, c.normal); // (8, 9)

    const double closing_speed = -dot(c.relative_velocity, c.normal);
    const PredictedLaw step = predict(c, closing_speed);
    const NormalAction normal = predict_normal(step, {c.normal, c.overlap, closing_speed, slip_velocity, 0.0, 0.0});
    const double presses = std::fabs(normal.force); // as the hosts' friction counts it, with tension too
    if (slips) slip(step.law, c.normal, slip_velocity, presses);
    const double presses_then = std::fabs(normal.predicted);
    const TangentialAction tangential =
        step.law.tangential_stiffness == 0.0
            ? predict_tangential<Friction::dashpot>(step, spring_, slip_velocity, presses, presses_then)
        : system_.limited_together
            ? predict_tangential<Friction::limited_together>(step, spring_, slip_velocity, presses, presses_then)
            : predict_tangential<Friction::spring_and_dashpot>(step, spring_, slip_velocity, presses, presses_then);

    const Vec3 friction = tangential.mean();
    const Vec3 force = normal.mean() * c.normal + friction;
    const Vec3 moment = cross(c.normal, friction);
    a.force = a.force + force;
    a.torque = a.torque - c.lever_first * moment;
    if (system_.second) {
      system_.second->force = system_.second->force - force;
      system_.second->torque = system_.second->torque - c.lever_second * moment;
    }
  }

  PredictedLaw predict(const Contact &c, double closing_speed) const {
    const auto hertz = [&](auto law) {
      const IntegratedPrediction contact(law, c.reduced_mass, c.tangential_reduced_mass, dt_);
      std::optional<PredictedLaw> step;
      if (std::string_view(system_.predictor->name) == "rk2")
        step = contact.template at<RungeKutta2>(c.overlap, closing_speed);
      else
        step = contact.template at<RungeKutta4>(c.overlap, closing_speed);
      return step.value();
    };
    const auto &[kn, hn, ks, hs, mu, least] = system_.law;
    switch (system_.form) {
    case Form::hertz:
      return hertz(HertzMindlinLaw<DampingExponent::quarter>{kn, hn, ks, hs, mu, least});
    case Form::hertz_stiffness:
      return hertz(HertzMindlinLaw<DampingExponent::half>{kn, hn, ks, hs, mu, least});
    case Form::linear:
      break;
    }
    return LinearPrediction(system_.law, c.reduced_mass, c.tangential_reduced_mass, *system_.predictor, dt_)
        .at(c.overlap, closing_speed);
  }

  /// Eq. 7 by the trapezoid, the part of the old slip turned into the tangent plane of today; a new
  /// contact has slipped for half a step on average. A spring beyond Coulomb's limit slackens.
  void slip(const LinearLaw &law, const Vec3 &n, const Vec3 &slip_velocity, double normal_force) {
    if (law.tangential_stiffness <= 0.0) return;
    spring_ = tangential_part(spring_ + 0.5 * dt_ * last_slip_velocity_, n) + 0.5 * dt_ * slip_velocity;
    const double limit = law.friction * normal_force;
    const Vec3 beside = system_.limited_together ? law.tangential_damping * slip_velocity : Vec3{};
    const Vec3 pull = law.tangential_stiffness * spring_ + beside;
    if (norm(pull) > limit) spring_ = (1.0 / law.tangential_stiffness) * ((limit / norm(pull)) * pull - beside);
    last_slip_velocity_ = slip_velocity;
  }

  System system_;
  double dt_ = 0.0;
  Vec3 spring_{};             ///< xi(t) [m]
  Vec3 last_slip_velocity_{}; ///< w(t) once the contact has slipped [m/s]
};

} // namespace cfpm::reference
