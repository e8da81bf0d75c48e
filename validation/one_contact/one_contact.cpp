// SPDX-License-Identifier: GPL-2.0-or-later
// Measures every method of Tables 2 and 3 by running it on one contact with a wall. Writes CSV to standard
// output, one number per line: family, method, quantity, at, value. The families are the conventional
// methods, each prediction alone, and the whole step of the contact force prediction method with it.
//   quantity          at              value
//   stable_to         0               largest t* = dt/tc found stable, 0 if none (stability.h)
//   unstable_from     0               smallest t* found unstable, 0 if none
//   energy_per_step   t*              mean change of ln(energy) per step, undamped (energy_change.h)
//   early_swing       t*              ln(largest/smallest energy) in the first 1000 steps
//   swing             t*              the same in all steps
//   growth            t*              energy_per_step over the whole range of t*
//   error_undamped    steps per tc/2  distance from the exact solution (accuracy.h)
//   error_damped      steps per tc/2  the same at a damping ratio of 0.7
#include "accuracy.h"
#include "adams_bashforth.h"
#include "core/predict/predictor.h"
#include "energy_change.h"
#include "explicit_euler.h"
#include "leapfrog.h"
#include "prediction_alone.h"
#include "predictor_corrector.h"
#include "stability.h"
#include "whole_step.h"

#include <cstdio>

namespace {

using namespace cfpm;
using namespace cfpm::validation;

/// start(contact, state, dt) begins a contact with the method.
template <class Start> void measure(const char *family, const char *method, const Start &start) {
  const auto write = [=](const char *quantity, double at, double value) {
    std::printf("%s,%s,%s,%.17g,%.17g\n", family, method, quantity, at, value);
  };
  const StabilityLimit limit = stability_limit(start);
  write("stable_to", 0.0, limit.stable);
  write("unstable_from", 0.0, limit.unstable);
  // a million steps: a loss of theta^4/24 per step then outweighs the swing, about theta^2, 200 times
  constexpr int steps = 1000000;
  for (const double theta : {0.05, 0.1}) {
    const EnergyChange change = energy_change(start, theta / pi, steps);
    write("energy_per_step", theta / pi, change.per_step);
    write("early_swing", theta / pi, change.early_swing);
    write("swing", theta / pi, change.swing);
  }
  for (int n = 4; n <= 120; ++n) {
    const double t_star = 0.01 * n;
    write("growth", t_star, energy_change(start, t_star, steps).per_step);
  }
  for (const int parts : {100, 200}) {
    write("error_undamped", parts, error_in_contact(start, 0.0, parts));
    write("error_damped", parts, error_in_contact(start, 0.7, parts));
  }
}

} // namespace

int main() {
  std::puts("family,method,quantity,at,value");
  measure("conventional", "euler",
          [](const auto &contact, const auto &state, double dt) { return ExplicitEuler(contact, state, dt); });
  measure("conventional", "adams-bashforth",
          [](const auto &contact, const auto &state, double dt) { return AdamsBashforth2(contact, state, dt); });
  measure("conventional", "leapfrog",
          [](const auto &contact, const auto &state, double dt) { return Leapfrog(contact, state, dt); });
  measure("conventional", "predictor-corrector",
          [](const auto &contact, const auto &state, double dt) { return PredictorCorrector(contact, state, dt); });
  for (const char *name : {"trapezoid", "rk2", "rk4", "exact"}) {
    const Predictor &predictor = *find_predictor(name);
    measure("alone", name, [&](const Oscillator &contact, const OscillatorState &state, double dt) {
      return PredictionAlone(predictor.propagator(contact, dt), state);
    });
    measure("whole", name, [&](const Oscillator &contact, const OscillatorState &state, double dt) {
      const auto predicted_force = [contact, map = predictor.propagator(contact, dt)](const OscillatorState &s) {
        const OscillatorState end = map(s);
        return contact.force(end.displacement, end.rate);
      };
      return WholeStep(contact, predicted_force, state, dt);
    });
  }
}
