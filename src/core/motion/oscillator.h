// SPDX-License-Identifier: GPL-2.0-or-later
// The isolated two-body problem of one contact direction. With the linear law it is a damped
// oscillator of the reduced mass, m d'' + h d' + k d = 0, whose solution after a step is a linear
// function of the state before it. Every predictor is therefore a 2x2 map here, computed once for all
// contacts with the same parameters; predicting one costs two multiplications per value whatever the predictor.
#pragma once

namespace cfpm {

/// What a predictor advances. T: double for one direction, or a vector of several that are coupled.
template <class T> struct RelativeState {
  T displacement; ///< overlap d or slip xi [m]
  T rate;         ///< its time derivative [m/s]
};

using OscillatorState = RelativeState<double>;

/// Normal direction: overlap, its spring and dashpot, m*. Tangential: slip, with their counterparts. R: double, or a
/// Pack of several oscillators' numbers.
template <class R> struct BasicOscillator {
  R stiffness; ///< k [N/m], >= 0
  R damping;   ///< h [kg/s], >= 0
  R mass;      ///< reduced mass [kg], > 0

  [[gnu::always_inline]] constexpr R force(const R &displacement, const R &rate) const {
    return stiffness * displacement + damping * rate;
  }
  [[gnu::always_inline]] constexpr R acceleration(const R &displacement, const R &rate) const {
    return -force(displacement, rate) / mass;
  }
};

using Oscillator = BasicOscillator<double>;

/// State at t + dt as a linear map of the state at t. R: as of the oscillator.
template <class R> struct BasicPropagator {
  R displacement_from_displacement; ///< [-]
  R displacement_from_rate;         ///< [s]
  R rate_from_displacement;         ///< [1/s]
  R rate_from_rate;                 ///< [-]

  [[gnu::always_inline]] constexpr RelativeState<R> operator()(const RelativeState<R> &s) const {
    return {displacement_from_displacement * s.displacement + displacement_from_rate * s.rate,
            rate_from_displacement * s.displacement + rate_from_rate * s.rate};
  }
};

using Propagator = BasicPropagator<double>;

/// The map of a predictor over one step, from what the predictor makes of the two unit states.
template <class Predictor, class R>
[[gnu::always_inline]] inline BasicPropagator<R> map_of_unit_states(const BasicOscillator<R> &oscillator, const R &dt) {
  const RelativeState<R> from_displacement = Predictor::advance(oscillator, RelativeState<R>{1.0, 0.0}, dt);
  const RelativeState<R> from_rate = Predictor::advance(oscillator, RelativeState<R>{0.0, 1.0}, dt);
  return {from_displacement.displacement, from_rate.displacement, from_displacement.rate, from_rate.rate};
}
template <class Predictor> Propagator make_propagator(const Oscillator &oscillator, double dt) {
  return map_of_unit_states<Predictor>(oscillator, dt);
}

} // namespace cfpm
