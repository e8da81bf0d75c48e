// SPDX-License-Identifier: GPL-2.0-or-later
// What a step of one contact costs with every method of Tables 2 and 3: Google Benchmark, whose options
// apply; items are steps. Every method runs the same loop, one collision in 100 steps that depend on each
// other, and works with what it can know before: the law and the step, not their quotients.
//   conventional/...  the methods of Table 2
//   formulas/...      the whole step, the prediction computed from its formulas at every step; exact as
//                     the map it is, because exp and cos at every step would not be what the paper timed
//   prepared/...      the whole step as the plugin does it, with the predicted force as a law of its own
//   alone/...         the prediction without the step around it
#include "adams_bashforth.h"
#include "collision.h"
#include "core/predict/predictor.h"
#include "explicit_euler.h"
#include "leapfrog.h"
#include "prediction_alone.h"
#include "predictor_corrector.h"
#include "whole_step.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace cfpm;
using namespace cfpm::validation;

constexpr int steps = 100;
constexpr double zeta = 0.7;

/// start(contact, dt) begins a collision with the method.
template <class Start> void add(const std::string &name, const Start &start) {
  benchmark::RegisterBenchmark(name.c_str(), [start](benchmark::State &runs) {
    Oscillator contact = wall_contact(zeta);
    double dt = tc / steps;
    for (auto _ : runs) {
      benchmark::DoNotOptimize(contact); // values the compiler must not know
      benchmark::DoNotOptimize(dt);
      auto method = start(contact, dt);
      for (int n = 0; n < steps; ++n) method.step();
      OscillatorState end = method.state();
      benchmark::DoNotOptimize(end);
    }
    runs.SetItemsProcessed(runs.iterations() * steps);
  });
}

/// prediction(contact, dt) gives the map of a state to the state a step later.
template <class Prediction> void add_predicted(const std::string &name, const Prediction &prediction) {
  add("formulas/" + name, [=](const Oscillator &contact, double dt) {
    const auto predicted_force = [contact, advance = prediction(contact, dt)](const OscillatorState &s) {
      const OscillatorState end = advance(s);
      return contact.force(end.displacement, end.rate);
    };
    return WholeStep(contact, predicted_force, touch, dt);
  });
  add("alone/" + name,
      [=](const Oscillator &contact, double dt) { return PredictionAlone(prediction(contact, dt), touch); });
}

/// The force at the end of a linear map is linear in the state before it.
Oscillator predicted_law(const Oscillator &contact, const Propagator &map) {
  const auto end_force = [&](const OscillatorState &start) {
    const OscillatorState end = map(start);
    return contact.force(end.displacement, end.rate);
  };
  return {end_force({1.0, 0.0}), end_force({0.0, 1.0}), contact.mass};
}

void add_prepared(const char *name) {
  const Oscillator law = wall_contact(zeta);
  const Oscillator predicted = predicted_law(law, find_predictor(name)->propagator(law, tc / steps));
  add(std::string("prepared/") + name, [predicted](const Oscillator &contact, double dt) {
    const auto predicted_force = [predicted](const OscillatorState &s) {
      return predicted.force(s.displacement, s.rate);
    };
    return WholeStep(contact, predicted_force, touch, dt);
  });
}

template <class Rule> auto formulas(const Oscillator &contact, double dt) {
  return [contact, dt](const OscillatorState &s) { return Rule::advance(contact, s, dt); };
}

} // namespace

int main(int argc, char **argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;

  add("conventional/euler", [](const Oscillator &contact, double dt) { return ExplicitEuler(contact, touch, dt); });
  add("conventional/adams-bashforth",
      [](const Oscillator &contact, double dt) { return AdamsBashforth2(contact, touch, dt); });
  add("conventional/leapfrog", [](const Oscillator &contact, double dt) { return Leapfrog(contact, touch, dt); });
  add("conventional/predictor-corrector",
      [](const Oscillator &contact, double dt) { return PredictorCorrector(contact, touch, dt); });
  add_predicted("trapezoid", formulas<Trapezoid>);
  add_predicted("rk2", formulas<RungeKutta2>);
  add_predicted("rk4", formulas<RungeKutta4>);
  // once per kind of contact, so outside the loop that is timed
  const Propagator exact = make_propagator<Exact>(wall_contact(zeta), tc / steps);
  add_predicted("exact", [exact](const Oscillator &, double) { return exact; });
  for (const char *name : {"trapezoid", "rk2", "rk4", "exact"}) add_prepared(name);

  benchmark::RunSpecifiedBenchmarks();
}
