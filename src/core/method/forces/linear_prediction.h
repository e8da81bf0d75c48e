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
      : law_(law), end_(end_after(dt, law, reduced_mass, tangential_reduced_mass, predictor)), dt_(dt),
        reduced_mass_(reduced_mass), tangential_reduced_mass_(tangential_reduced_mass), predictor_(&predictor) {}

  double dt() const { return dt_; }

  /// overlap [m], closing speed [m/s]
  PredictedLaw at(double overlap, double closing_speed) const {
    const double force = end_.force(overlap, closing_speed);
    const bool together = end_.overlap(overlap, closing_speed) >= 0.0;
    return {law_, together ? force : 0.0, end_.tangential.stiffness, end_.tangential.damping, dt_};
  }

  /// Over a span of at most dt [s]. Contacts with less than dt are rare, and any span may come: what they have is made
  /// for each of them anew.
  PredictedTouch while_touching(double overlap, double closing_speed, double span) const {
    if (span == dt_) return while_touching(end_, overlap, closing_speed, span);
    return while_touching(end_after(span, law_, reduced_mass_, tangential_reduced_mass_, *predictor_), overlap,
                          closing_speed, span);
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

  /// What is predicted for the end, as linear functions of the state at the beginning.
  struct End {
    Overlap of_overlap;        ///< without tension nobody asks, as Eq. 36 ends the contact earlier
    Coefficients normal{};     ///< of the force
    Coefficients tangential{}; ///< likewise

    double force(double overlap, double closing_speed) const {
      return normal.stiffness * overlap + normal.damping * closing_speed;
    }
    double overlap(double overlap, double closing_speed) const {
      return of_overlap.from_overlap * overlap + of_overlap.from_speed * closing_speed;
    }
  };

  [[gnu::noinline]] static End end_after(double span, const LinearLaw &law, double reduced_mass,
                                         double tangential_reduced_mass, const Predictor &predictor) {
    const Oscillator normal{law.normal_stiffness, law.normal_damping, reduced_mass};
    const Oscillator tangential{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass};
    const Propagator normal_map = predictor.propagator(normal, span);
    const auto predicted = [](const Oscillator &o, const Propagator &map) {
      const auto end_force = [&](const OscillatorState &start) {
        const OscillatorState end = map(start);
        return o.force(end.displacement, end.rate);
      };
      return Coefficients{end_force({1.0, 0.0}), end_force({0.0, 1.0})};
    };
    End end;
    end.normal = predicted(normal, normal_map);
    end.tangential = predicted(tangential, predictor.propagator(tangential, span));
    if (law.tension()) end.of_overlap = {normal_map.displacement_from_displacement, normal_map.displacement_from_rate};
    return end;
  }

  /// Bodies that have parted did so where the overlap vanishes, as Eq. 39 finds where the force does: by the straight
  /// line from its value now to the one that is predicted. There the dashpot alone acts, at a speed on such a line too.
  PredictedTouch while_touching(const End &end, double overlap, double closing_speed, double span) const {
    const double force = end.force(overlap, closing_speed);
    const double end_overlap = end.overlap(overlap, closing_speed);
    const bool parted = end_overlap < 0.0;
    const double part = parted ? overlap / (overlap - end_overlap) : 1.0;
    const double pull = law_.normal_damping * closing_speed;
    const double end_pull = force - law_.normal_stiffness * end_overlap;
    return {{law_, parted ? pull + part * (end_pull - pull) : force, end.tangential.stiffness, end.tangential.damping,
             span},
            part * span};
  }

  LinearLaw law_;
  End end_; ///< of the step
  double dt_;
  double reduced_mass_;            ///< [kg]
  double tangential_reduced_mass_; ///< [kg]
  const Predictor *predictor_;
};

} // namespace cfpm
