// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/adhesion.h"
#include "core/law/follows_area.h"
#include "core/method/forces/predicted_law.h"
#include "core/motion/oscillator.h"

#include <utility>

namespace cfpm {

/// The normal direction, and the tangential one started with a unit spring and with a unit slip velocity.
template <class R> struct BasicDirections {
  R normal;
  R from_spring;
  R from_slip;

  [[gnu::always_inline]] friend BasicDirections operator+(const BasicDirections &a, const BasicDirections &b) {
    return {a.normal + b.normal, a.from_spring + b.from_spring, a.from_slip + b.from_slip};
  }
  [[gnu::always_inline]] friend BasicDirections operator*(const R &s, const BasicDirections &a) {
    return {s * a.normal, s * a.from_spring, s * a.from_slip};
  }
};

/// The numbers that a contact whose law depends on the overlap is predicted by: m* d'' = -fn(d, d') and, coupled to it
/// by d(t), mt xi'' = -(ks(d) xi + hs(d) xi'). The second equation is linear in the slip, so what it makes of a unit
/// spring and of a unit slip velocity is all that the prediction needs to know of it.
/// Law: at(overlap) gives the BasicLinearLaw<R> that acts at an overlap, zero where the bodies are apart.
template <class Law, class R> struct IntegratedStep {
  using Directions = BasicDirections<R>;
  using Predicted = std::conditional_t<adheres<Law>, BasicPredictedAdhesion<R>, BasicPredictedLaw<R>>;

  Law law;
  R per_mass;            ///< [1/kg]
  R per_tangential_mass; ///< [1/kg]
  R dt;                  ///< [s]

  /// overlap [m], closing speed [m/s]; Predictor: one that predicts any law
  template <class Predictor> [[gnu::always_inline]] Predicted at(const R &overlap, const R &closing_speed) const {
    return after<Predictor>(dt, overlap, closing_speed).first;
  }

  /// For the end of a span [s]. And the overlap there, negative where the bodies are apart [m].
  template <class Predictor>
  [[gnu::always_inline]] std::pair<Predicted, R> after(const R &span, const R &overlap, const R &closing_speed) const {
    const RelativeState<Directions> start{{overlap, 1.0, 0.0}, {closing_speed, 0.0, 1.0}};
    if constexpr (follows_area<Law>) {
      const SinceStart contact{*this, Law::root_of(overlap)};
      const auto [d, u] = Predictor::advance(contact, start, span);
      const auto end = law.springs_at(d.normal, contact.root);
      return {predicted({law.at(overlap), end.law.normal_force(d.normal, u.normal),
                         SinceStart::pull(end, d.from_spring) + end.law.tangential_damping * u.from_spring,
                         end.fresh * d.from_slip + end.law.tangential_damping * u.from_slip,
                         SinceStart::pull(end, d.from_spring), end.fresh * d.from_slip, span},
                        overlap, d.normal),
              d.normal};
    } else {
      const auto [d, u] = Predictor::advance(*this, start, span);
      const BasicLinearLaw<R> end = law.at(d.normal);
      return {predicted({law.at(overlap), end.normal_force(d.normal, u.normal),
                         end.tangential_stiffness * d.from_spring + end.tangential_damping * u.from_spring,
                         end.tangential_stiffness * d.from_slip + end.tangential_damping * u.from_slip,
                         end.tangential_stiffness * d.from_spring, end.tangential_stiffness * d.from_slip, span},
                        overlap, d.normal),
              d.normal};
    }
  }

  /// For the predictor.
  [[gnu::always_inline]] Directions acceleration(const Directions &displacement, const Directions &rate) const {
    const BasicLinearLaw<R> now = law.at(displacement.normal);
    const R ks = per_tangential_mass * now.tangential_stiffness;
    const R hs = per_tangential_mass * now.tangential_damping;
    return {-per_mass * now.normal_force(displacement.normal, rate.normal),
            -ks * displacement.from_spring - hs * rate.from_spring, -ks * displacement.from_slip - hs * rate.from_slip};
  }

private:
  [[gnu::always_inline]] Predicted predicted(const BasicPredictedLaw<R> &forces, [[maybe_unused]] const R &overlap,
                                             [[maybe_unused]] const R &end) const {
    if constexpr (adheres<Law>)
      return {forces, law.adhesion.presses, law.pressing_at(overlap), law.pressing_at(end)};
    else
      return forces;
  }

  /// The same contact with springs that follow the area from the root of the overlap that it had at the start.
  struct SinceStart {
    const IntegratedStep &step;
    R root; ///< [m^(1/2)]

    /// By a unit spring that has become that long.
    template <class Springs> [[gnu::always_inline]] static R pull(const Springs &now, const R &length) {
      return now.fresh * length + (now.kept - now.fresh);
    }
    [[gnu::always_inline]] Directions acceleration(const Directions &displacement, const Directions &rate) const {
      const auto now = step.law.springs_at(displacement.normal, root);
      const R damping = now.law.tangential_damping;
      return {-step.per_mass * now.law.normal_force(displacement.normal, rate.normal),
              -step.per_tangential_mass * (pull(now, displacement.from_spring) + damping * rate.from_spring),
              -step.per_tangential_mass * (now.fresh * displacement.from_slip + damping * rate.from_slip)};
    }
  };
};

/// The parameters of contacts whose law depends on the overlap, see IntegratedStep.
template <class L> class IntegratedPrediction {
public:
  using Law = L;
  using Directions = BasicDirections<double>;
  template <class R> using Step = IntegratedStep<typename L::template Over<R>, R>;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  IntegratedPrediction(const Law &law, double reduced_mass, double tangential_reduced_mass, double dt)
      : step_{law, 1.0 / reduced_mass, 1.0 / tangential_reduced_mass, dt} {}

  double dt() const { return step_.dt; }
  const Step<double> &step() const { return step_; }

  /// overlap [m], closing speed [m/s]; Predictor: one that predicts any law
  template <class Predictor> [[gnu::always_inline]] auto at(double overlap, double closing_speed) const {
    return step_.template at<Predictor>(overlap, closing_speed);
  }

  /// Over a span of at most dt [s]. Bodies that have parted did so where the overlap vanishes, see LinearPrediction.
  template <class Predictor> auto while_touching(double overlap, double closing_speed, double span) const {
    const auto [law, end_overlap] = step_.template after<Predictor>(span, overlap, closing_speed);
    return BasicPredictedTouch<typename Step<double>::Predicted>{
        law, end_overlap < 0.0 ? overlap / (overlap - end_overlap) * span : span};
  }

  /// For the predictor.
  Directions acceleration(const Directions &displacement, const Directions &rate) const {
    return step_.acceleration(displacement, rate);
  }

private:
  Step<double> step_;
};

} // namespace cfpm
