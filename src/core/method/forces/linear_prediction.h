// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"
#include "core/method/forces/predicted_law.h"
#include "core/motion/oscillator.h"
#include "core/predict/predictor.h"

namespace cfpm {

/// The parameters of contacts with the linear law: everything that depends only on materials, masses and the
/// step, computed once and kept. The force of a linear law at the end of a linear map is linear in the
/// state before it: the predicted force is the same law with other coefficients.
class LinearPrediction {
public:
  using Law = LinearLaw;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  LinearPrediction(const LinearLaw &law, double reduced_mass, double tangential_reduced_mass,
                   const Predictor &predictor, double dt)
      : law_(law), dt_(dt) {
    const Oscillator normal{law.normal_stiffness, law.normal_damping, reduced_mass};
    const Oscillator tangential{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass};
    const Propagator normal_map = predictor.propagator(normal, dt);
    const auto predicted = [](const Oscillator &o, const Propagator &map) {
      const auto end_force = [&](const OscillatorState &start) {
        const OscillatorState end = map(start);
        return o.force(end.displacement, end.rate);
      };
      return Coefficients{end_force({1.0, 0.0}), end_force({0.0, 1.0})};
    };
    normal_ = predicted(normal, normal_map);
    tangential_ = predicted(tangential, predictor.propagator(tangential, dt));
    if (law.tension()) overlap_ = {normal_map.displacement_from_displacement, normal_map.displacement_from_rate};
  }

  double dt() const { return dt_; }

  /// overlap [m], closing speed [m/s]
  PredictedLaw at(double overlap, double closing_speed) const {
    const double force = normal_.stiffness * overlap + normal_.damping * closing_speed;
    const bool together = overlap_.from_overlap * overlap + overlap_.from_speed * closing_speed >= 0.0;
    return {law_, together ? force : 0.0, tangential_.stiffness, tangential_.damping, dt_};
  }

private:
  struct Coefficients {
    double stiffness; ///< [N/m]
    double damping;   ///< [kg/s]
  };

  struct Overlap {
    double from_overlap = 0.0; ///< [-]
    double from_speed = 0.0;   ///< [s]
  };

  LinearLaw law_;
  Overlap overlap_;           ///< predicted for t + dt; without tension nobody asks, as Eq. 36 ends the contact earlier
  Coefficients normal_{};     ///< of the force predicted for t + dt
  Coefficients tangential_{}; ///< likewise
  double dt_;
};

} // namespace cfpm
