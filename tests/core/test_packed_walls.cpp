// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts with walls computed several at a time give to the last bit what they give one by one: of several types and
// sizes, some spheres at two walls, chunks that end at every length. What one gives is compared with the paper's in
// tests of the hosts.
#include "core/contact/inertia.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/linear_prediction.h"
#include "core/method/forces/mean_of_two_forces.h"
#include "core/step/add_wall_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr double dt = 2e-5;
using HertzLaw = HertzMindlinLaw<DampingExponent::quarter>;

template <class Law> Law law_of(const ContactPartners &p) {
  const double kn = 1e4 * p.type_i;
  const double hn = 0.2 * p.type_i * std::sqrt(kn * p.reduced_mass);
  return {kn, hn, 0.6 * kn, 0.4 * hn, 0.1 * p.type_i};
}

/// Parameters as a loop asks for them, all kept.
template <class Parameters, class Make> class Kept {
public:
  explicit Kept(const Make &make) : make_(make) {}
  const Parameters &operator()(const ContactPartners &p) const { return kept_.emplace_back(make_(p)); }

private:
  const Make &make_;
  mutable std::deque<Parameters> kept_;
};

/// What that many contacts do over three steps, bit by bit.
template <class Method> std::string bytes_after(const Method &method, int count, const InstructionSet &set) {
  std::mt19937_64 random(20051003);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const auto spheres = static_cast<std::size_t>(count + 1);
  std::vector<double> f(3 * spheres, 0.1);
  std::vector<double> torque(3 * spheres, 0.2);
  std::vector<double> springs(4 * spheres);
  for (double &s : springs) s = uniform(-1e-5, 1e-5);
  std::vector<WallContact> contacts;
  for (int k = 0; k < count; ++k) {
    const int type = 1 + k / 3 % 2;
    const double radius = 0.001 * type;
    const ContactPartners partners{type, 0, radius, std::numeric_limits<double>::infinity(), 1e-5 * type};
    const Vec3 direction{uniform(-1.0, 1.0), uniform(-1.0, 1.0), 1.0};
    const Vec3 normal = (1.0 / norm(direction)) * direction;
    const Motion motion{{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)},
                        {uniform(-80.0, 80.0), uniform(-80.0, 80.0), uniform(-80.0, 80.0)}};
    const StoredSpring spring{&springs[4 * static_cast<std::size_t>(k)], dt, true};
    const int i = k % 4 == 3 ? k - 1 : k; // a second wall
    contacts.push_back(
        {i,
         partners,
         {touching_wall(normal, radius * uniform(0.95, 1.0), radius, motion, {0.0, 0.1, 0.0}), dt, 0.0, spring}});
  }
  Particles particles;
  particles.f = VectorRows(f.data());
  particles.torque = VectorRows(torque.data());
  StepState step;
  step.dt = dt;
  for (int n = 0; n < 3; ++n) add_wall_forces<Friction::spring_and_dashpot>(contacts, particles, step, method, set);
  std::string bytes;
  for (const auto *const numbers : {&f, &torque, &springs})
    bytes.append(reinterpret_cast<const char *>(numbers->data()), numbers->size() * sizeof(double));
  return bytes;
}

template <class Method> void check(const Method &method) {
  for (const int count : {0, 1, 2, 3, 4, 5, 127, 128, 129, 300})
    for (const InstructionSet &set : instruction_sets) {
      if (!machine_has(set)) continue;
      EXPECT_EQ(bytes_after(method, count, set) == bytes_after(method, count, instruction_sets[0]), true)
          << count << ' ' << set.name;
    }
  EXPECT_NE(bytes_after(method, 2, instruction_sets[0]), bytes_after(method, 3, instruction_sets[0]));
}

TEST(PackedWalls, GiveTheSameBitsOfALinearLaw) {
  const auto make = [](const ContactPartners &p) -> LinearPrediction {
    const double mass = p.reduced_mass;
    return {law_of<LinearLaw>(p), mass, tangential_reduced_mass(mass, 3), predictor<Exact>, dt};
  };
  const Kept<LinearPrediction, decltype(make)> of(make);
  const PredictedByParameters at;
  check(MeanOfTwoForces(of, at));
}

TEST(PackedWalls, GiveTheSameBitsOfHertzAndMindlin) {
  const auto make = [](const ContactPartners &p) -> IntegratedPrediction<HertzLaw> {
    const double mass = p.reduced_mass;
    return {law_of<HertzLaw>(p), mass, tangential_reduced_mass(mass, 3), dt};
  };
  const Kept<IntegratedPrediction<HertzLaw>, decltype(make)> of(make);
  const PredictedBy<RungeKutta2> at;
  check(MeanOfTwoForces(of, at));
}

} // namespace
} // namespace cfpm::testing
