// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/forces/predicted_law.h"
#include "core/motion/oscillator.h"

#include <utility>

namespace cfpm {

/// The parameters of contacts whose law depends on the overlap: m* d'' = -fn(d, d') and, coupled to it by d(t),
/// mt xi'' = -(ks(d) xi + hs(d) xi'). The second equation is linear in the slip, so what it makes of a unit
/// spring and of a unit slip velocity is all that the prediction needs to know of it.
/// Law: at(overlap) gives the LinearLaw that acts at an overlap, zero where the bodies are apart.
template <class L> class IntegratedPrediction {
public:
  using Law = L;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  IntegratedPrediction(const Law &law, double reduced_mass, double tangential_reduced_mass, double dt)
      : law_(law), per_mass_(1.0 / reduced_mass), per_tangential_mass_(1.0 / tangential_reduced_mass), dt_(dt) {}

  double dt() const { return dt_; }

  /// overlap [m], closing speed [m/s]; Predictor: one that predicts any law
  template <class Predictor> PredictedLaw at(double overlap, double closing_speed) const {
    return after<Predictor>(dt_, overlap, closing_speed).first;
  }

  /// Over a span of at most dt [s]. Bodies that have parted did so where the overlap vanishes, see LinearPrediction.
  template <class Predictor> PredictedTouch while_touching(double overlap, double closing_speed, double span) const {
    const auto [law, end_overlap] = after<Predictor>(span, overlap, closing_speed);
    return {law, end_overlap < 0.0 ? overlap / (overlap - end_overlap) * span : span};
  }

  /// The normal direction, and the tangential one started with a unit spring and with a unit slip velocity.
  struct Directions {
    double normal;
    double from_spring;
    double from_slip;

    friend Directions operator+(const Directions &a, const Directions &b) {
      return {a.normal + b.normal, a.from_spring + b.from_spring, a.from_slip + b.from_slip};
    }
    friend Directions operator*(double s, const Directions &a) {
      return {s * a.normal, s * a.from_spring, s * a.from_slip};
    }
  };

  /// For the predictor.
  Directions acceleration(const Directions &displacement, const Directions &rate) const {
    const LinearLaw law = law_.at(displacement.normal);
    const double ks = per_tangential_mass_ * law.tangential_stiffness;
    const double hs = per_tangential_mass_ * law.tangential_damping;
    return {-per_mass_ * law.normal_force(displacement.normal, rate.normal),
            -ks * displacement.from_spring - hs * rate.from_spring, -ks * displacement.from_slip - hs * rate.from_slip};
  }

private:
  /// And the overlap at the end, negative where the bodies are apart [m].
  template <class Predictor>
  std::pair<PredictedLaw, double> after(double span, double overlap, double closing_speed) const {
    const RelativeState<Directions> start{{overlap, 1.0, 0.0}, {closing_speed, 0.0, 1.0}};
    const auto [d, u] = Predictor::advance(*this, start, span);
    const LinearLaw end = law_.at(d.normal);
    return {{law_.at(overlap), end.normal_force(d.normal, u.normal),
             end.tangential_stiffness * d.from_spring + end.tangential_damping * u.from_spring,
             end.tangential_stiffness * d.from_slip + end.tangential_damping * u.from_slip, span},
            d.normal};
  }

  Law law_;
  double per_mass_;            ///< [1/kg]
  double per_tangential_mass_; ///< [1/kg]
  double dt_;                  ///< [s]
};

} // namespace cfpm
