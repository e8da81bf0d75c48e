// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"
#include "core/method/forces/predicted_law.h"
#include "core/motion/oscillator.h"
#include "core/numbers/pack.h"
#include "core/predict/predictor.h"

namespace cfpm {

/// What is predicted for the end of a span, as linear functions of the state at its beginning. R: double, or a Pack of
/// several contacts' numbers.
template <class R> struct BasicLinearEnd {
  struct Coefficients {
    R stiffness; ///< [N/m]
    R damping;   ///< [kg/s]
  };

  struct Overlap {
    R from_overlap = 0.0; ///< [-]
    R from_speed = 0.0;   ///< [s]
  };

  Overlap of_overlap;        ///< without tension nobody asks, as Eq. 36 ends the contact earlier
  Coefficients normal{};     ///< of the force
  Coefficients tangential{}; ///< likewise
  Coefficients spring{};     ///< of the part of that which the spring has

  /// overlap [m], closing speed [m/s]
  [[gnu::always_inline]] R force(const R &overlap, const R &closing_speed) const {
    return normal.stiffness * overlap + normal.damping * closing_speed;
  }
  [[gnu::always_inline]] R overlap(const R &overlap, const R &closing_speed) const {
    return of_overlap.from_overlap * overlap + of_overlap.from_speed * closing_speed;
  }
};

/// From what the span makes of both directions.
template <class R> [[gnu::always_inline]] inline BasicLinearEnd<R>
linear_end(const BasicLinearLaw<R> &law, const BasicPropagator<R> &normal, const BasicPropagator<R> &tangential) {
  const auto force =
      [](const R &stiffness, const R &damping, const BasicPropagator<R> &map) __attribute__((always_inline)) {
    return typename BasicLinearEnd<R>::Coefficients{
        stiffness * map.displacement_from_displacement + damping * map.rate_from_displacement,
        stiffness * map.displacement_from_rate + damping * map.rate_from_rate};
  };
  const auto pulls = law.least_force < R(0.0);
  return {{select(pulls, normal.displacement_from_displacement, R(0.0)),
           select(pulls, normal.displacement_from_rate, R(0.0))},
          force(law.normal_stiffness, law.normal_damping, normal),
          force(law.tangential_stiffness, law.tangential_damping, tangential),
          {law.tangential_stiffness * tangential.displacement_from_displacement,
           law.tangential_stiffness * tangential.displacement_from_rate}};
}

/// All that makes a contact's PredictedLaw of it.
template <class R> struct BasicLinearStep {
  BasicLinearLaw<R> law;
  BasicLinearEnd<R> end; ///< of the step
  R dt;                  ///< [s]

  /// overlap [m], closing speed [m/s]
  [[gnu::always_inline]] BasicPredictedLaw<R> at(const R &overlap, const R &closing_speed) const {
    const R force = end.force(overlap, closing_speed);
    const auto together = end.overlap(overlap, closing_speed) >= R(0.0);
    return {law,
            select(together, force, 0.0),
            end.tangential.stiffness,
            end.tangential.damping,
            end.spring.stiffness,
            end.spring.damping,
            dt};
  }
};

/// That of contacts of any masses, over numbers R, see propagator_in_packs(). reduced_mass: m* [kg],
/// tangential_reduced_mass: see LinearPrediction [kg], dt: [s]
template <class R>
[[gnu::always_inline]] inline BasicLinearStep<R> linear_step(const BasicLinearLaw<R> &law, const R &reduced_mass,
                                                             const R &tangential_reduced_mass,
                                                             const Predictor &predictor, const R &dt) {
  const BasicOscillator<R> normal{law.normal_stiffness, law.normal_damping, reduced_mass};
  const BasicOscillator<R> tangential{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass};
  return {law,
          linear_end<R>(law, Predictors::propagator_in_packs(predictor, normal, dt),
                        Predictors::propagator_in_packs(predictor, tangential, dt)),
          dt};
}

/// The parameters of contacts with the linear law: everything that depends only on materials, masses and the
/// step, computed once and kept. The force of a linear law at the end of a linear map is linear in the
/// state before it: the predicted force is the same law with other coefficients.
class LinearPrediction {
public:
  using Law = LinearLaw;
  template <class R> using Step = BasicLinearStep<R>;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  LinearPrediction(const LinearLaw &law, double reduced_mass, double tangential_reduced_mass,
                   const Predictor &predictor, double dt)
      : step_{law, end_after(dt, law, reduced_mass, tangential_reduced_mass, predictor), dt},
        reduced_mass_(reduced_mass), tangential_reduced_mass_(tangential_reduced_mass), predictor_(&predictor) {}
  /// The same with what linear_step() has made of it.
  LinearPrediction(const BasicLinearStep<double> &step, double reduced_mass, double tangential_reduced_mass,
                   const Predictor &predictor)
      : step_(step), reduced_mass_(reduced_mass), tangential_reduced_mass_(tangential_reduced_mass),
        predictor_(&predictor) {}

  double dt() const { return step_.dt; }
  const BasicLinearStep<double> &step() const { return step_; }

  /// overlap [m], closing speed [m/s]
  [[gnu::always_inline]] PredictedLaw at(double overlap, double closing_speed) const {
    return step_.at(overlap, closing_speed);
  }

  /// Over a span of at most dt [s]. Contacts with less than dt are rare, and any span may come: what they have is made
  /// for each of them anew.
  PredictedTouch while_touching(double overlap, double closing_speed, double span) const {
    if (span == step_.dt) return while_touching(step_.end, overlap, closing_speed, span);
    return while_touching(end_after(span, step_.law, reduced_mass_, tangential_reduced_mass_, *predictor_), overlap,
                          closing_speed, span);
  }

private:
  using End = BasicLinearEnd<double>;

  [[gnu::noinline]] static End end_after(double span, const LinearLaw &law, double reduced_mass,
                                         double tangential_reduced_mass, const Predictor &predictor) {
    const Oscillator normal{law.normal_stiffness, law.normal_damping, reduced_mass};
    const Oscillator tangential{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass};
    return linear_end(law, predictor.propagator(normal, span), predictor.propagator(tangential, span));
  }

  /// Bodies that have parted did so where the overlap vanishes, as Eq. 39 finds where the force does: by the straight
  /// line from its value now to the one that is predicted. There the dashpot alone acts, at a speed on such a line too.
  PredictedTouch while_touching(const End &end, double overlap, double closing_speed, double span) const {
    const double force = end.force(overlap, closing_speed);
    const double end_overlap = end.overlap(overlap, closing_speed);
    const bool parted = end_overlap < 0.0;
    const double part = parted ? overlap / (overlap - end_overlap) : 1.0;
    const double pull = step_.law.normal_damping * closing_speed;
    const double end_pull = force - step_.law.normal_stiffness * end_overlap;
    return {{step_.law, parted ? pull + part * (end_pull - pull) : force, end.tangential.stiffness,
             end.tangential.damping, end.spring.stiffness, end.spring.damping, span},
            part * span};
  }

  BasicLinearStep<double> step_;
  double reduced_mass_;            ///< [kg]
  double tangential_reduced_mass_; ///< [kg]
  const Predictor *predictor_;
};

} // namespace cfpm
