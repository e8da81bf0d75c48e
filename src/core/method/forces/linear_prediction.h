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
    const auto predicted = [&](double stiffness, double damping, double mass) {
      const Oscillator o{stiffness, damping, mass};
      const Propagator map = predictor.propagator(o, dt);
      const auto end_force = [&](const OscillatorState &start) {
        const OscillatorState end = map(start);
        return o.force(end.displacement, end.rate);
      };
      return Coefficients{end_force({1.0, 0.0}), end_force({0.0, 1.0})};
    };
    normal_ = predicted(law.normal_stiffness, law.normal_damping, reduced_mass);
    tangential_ = predicted(law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass);
  }

  double dt() const { return dt_; }

  /// overlap [m], closing speed [m/s]
  PredictedLaw at(double overlap, double closing_speed) const {
    return {law_, normal_.stiffness * overlap + normal_.damping * closing_speed, tangential_.stiffness,
            tangential_.damping, dt_};
  }

private:
  struct Coefficients {
    double stiffness; ///< [N/m]
    double damping;   ///< [kg/s]
  };

  LinearLaw law_;
  Coefficients normal_{};     ///< of the force predicted for t + dt
  Coefficients tangential_{}; ///< likewise
  double dt_;
};

} // namespace cfpm
