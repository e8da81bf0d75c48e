// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/method/forces/predicted_law.h"
#include "core/motion/flow_by_series.h"
#include "core/motion/hertz_motion.h"
#include "core/motion/hertz_trajectory.h"
#include "core/motion/oscillator.h"
#include "core/numbers/pack.h"

#include <cmath>
#include <memory>
#include <utility>

namespace cfpm {

/// Table 3's missing entry: what makes a contact's PredictedLaw of its exact motion. In the tangent plane the stiffness
/// varies inside the step; that of the mean overlap stands for it. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicHertzStep {
  using Law = HertzMindlinLaw<DampingExponent::quarter, R>;

  Law law;
  BasicHertzMotion<R> motion;
  R slip_omega_squared; ///< ks/mt, at an overlap of 1 [1/(s^2 m^(1/2))]
  R slip_b;             ///< hs/(2 mt), likewise [1/(s m^(1/4))]
  R dt;                 ///< [s]

  struct End {
    BasicPredictedLaw<R> law;
    R contact_time; ///< [s]
  };

  /// overlap [m], closing speed [m/s]
  [[gnu::always_inline]] BasicPredictedLaw<R> at(const R &overlap, const R &closing_speed) const {
    return after(dt, overlap, closing_speed).law;
  }

  /// For the end of a span [s].
  [[gnu::always_inline]] End after(const R &span, const R &listed_overlap, const R &closing_speed) const {
    using std::sqrt;
    const R overlap = larger(R(0.0), listed_overlap);
    const R root = sqrt(overlap);
    const R fourth_root = sqrt(root);
    const BasicLinearLaw<R> now = law.at_root(root, fourth_root);
    const R holds = select(law.least_force < R(0.0), overlap, now.normal_force(overlap, closing_speed));
    const auto acts = (R(0.0) < holds) | (R(0.0) < closing_speed); // else the bodies are released, and do not approach
    const BasicHertzFlight<R> flight = motion.fly(overlap, fourth_root, closing_speed, span);
    const BasicLinearLaw<R> end = law.at(flight.overlap);
    const R mean_root = sqrt(flight.mean_overlap);
    const BasicPropagator<R> slip = flow_by_series(mean_root * slip_omega_squared, R(sqrt(mean_root)) * slip_b, span);
    const auto of = [&acts](const R &number) __attribute__((always_inline)) { return select(acts, number, R(0.0)); };
    return {{now, of(end.normal_force(flight.overlap, flight.closing_speed)),
             of(end.tangential_stiffness * slip.displacement_from_displacement +
                end.tangential_damping * slip.rate_from_displacement),
             of(end.tangential_stiffness * slip.displacement_from_rate + end.tangential_damping * slip.rate_from_rate),
             of(end.tangential_stiffness * slip.displacement_from_displacement),
             of(end.tangential_stiffness * slip.displacement_from_rate), span},
            of(flight.contact_time)};
  }
};

/// Of contacts whose trajectory is this; see HertzPrediction.
template <class R> [[gnu::always_inline]] inline BasicHertzStep<R>
hertz_step(const typename BasicHertzStep<R>::Law &law, const BasicHertzTrajectory<R> &trajectory, const R &reduced_mass,
           const R &tangential_reduced_mass, const R &dt) {
  return {law, hertz_motion(law.normal_stiffness, trajectory, reduced_mass),
          law.tangential_stiffness / tangential_reduced_mass, law.tangential_damping / (2.0 * tangential_reduced_mass),
          dt};
}

/// The parameters of contacts with Hertz' law and the damping of the paper, whose exact motion is read from the one
/// trajectory of its alpha.
class HertzPrediction {
public:
  using Law = HertzMindlinLaw<DampingExponent::quarter>;
  template <class R> using Step = BasicHertzStep<R>;

  /// trajectory: that of HertzImpulse::alpha(); tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  HertzPrediction(const Law &law, std::shared_ptr<const HertzTrajectory> trajectory, double reduced_mass,
                  double tangential_reduced_mass, double dt)
      : trajectory_(std::move(trajectory)),
        step_(hertz_step(law, trajectory_->tables(), reduced_mass, tangential_reduced_mass, dt)) {}

  double dt() const { return step_.dt; }
  const BasicHertzStep<double> &step() const { return step_; }

  /// overlap [m], closing speed [m/s]
  [[gnu::always_inline]] PredictedLaw at(double overlap, double closing_speed) const {
    return step_.at(overlap, closing_speed);
  }

  /// Of a contact that begins or ends inside the step; span: of the step from its beginning on [s]
  PredictedTouch while_touching(double overlap, double closing_speed, double span) const {
    const auto [law, contact_time] = step_.after(span, overlap, closing_speed);
    PredictedTouch touch{law, contact_time};
    if (contact_time < span) touch.law.predicted_normal_force = 0.0; // as it is where the contact ends
    return touch;
  }

private:
  std::shared_ptr<const HertzTrajectory> trajectory_;
  BasicHertzStep<double> step_;
};

} // namespace cfpm
