// SPDX-License-Identifier: GPL-2.0-or-later
// Reads a system from standard input, one item a line, and prints its motion, a line per time level:
//
//   predictor NAME
//   law FORM KN HN KS HS MU LEAST                          FORM: linear, hertz or hertz/stiffness; LEAST: of the
//                                                          normal force, 0 or with tension -inf
//   limited_together                                       optional: Coulomb's limit holds the tangential spring with
//                                                          its dashpot, not alone
//   gravity GX GY GZ                                       optional
//   sphere RADIUS MASS X Y Z VX VY VZ WX WY WZ             the first; a second one may be MASS inf
//   plane PX PY PZ NX NY NZ VX VY VZ                       or a wall
//   run DT STEPS                                           any number, carried out in order
//
// Output: step, then x y z vx vy vz wx wy wz of every sphere.
#include "reference_scheme.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using cfpm::Vec3;
using namespace cfpm::reference;

[[noreturn]] void fail(const std::string &what) {
  std::cerr << "reference_scheme: " << what << '\n';
  std::exit(EXIT_FAILURE);
}

/// Numbers of one line; strtod, unlike a stream, reads "inf" and every bit of "%.17g".
class Line {
public:
  explicit Line(const std::string &text) : text_(text), words_(text) { words_ >> key_; }

  const std::string &key() const { return key_; }
  std::string word() {
    std::string word;
    if (!(words_ >> word)) fail("too few values in line '" + text_ + "'");
    return word;
  }
  double number() {
    const std::string value = word();
    char *end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (*end != '\0') fail("expected a number, found '" + value + "' in line '" + text_ + "'");
    return number;
  }
  Vec3 vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  void finish() {
    std::string rest;
    if (words_ >> rest) fail("unexpected '" + rest + "' in line '" + text_ + "'");
  }

private:
  std::string text_;
  std::istringstream words_;
  std::string key_;
};

struct Run {
  double dt;
  long steps;
};

Form form_named(const std::string &name) {
  if (name == "linear") return Form::linear;
  if (name == "hertz") return Form::hertz;
  if (name == "hertz/stiffness") return Form::hertz_stiffness;
  fail("unknown law '" + name + "'; expected linear, hertz or hertz/stiffness");
}

std::pair<System, std::vector<Run>> read(std::istream &input) {
  System system;
  std::vector<Run> runs;
  int spheres = 0;
  for (std::string text; std::getline(input, text);) {
    Line line(text);
    const std::string &key = line.key();
    if (key.empty()) continue;
    if (key == "predictor") {
      system.predictor = cfpm::find_predictor(line.word());
    } else if (key == "law") {
      system.form = form_named(line.word());
      const double kn = line.number();
      const double hn = line.number();
      const double ks = line.number();
      const double hs = line.number();
      const double mu = line.number();
      system.law = {kn, hn, ks, hs, mu, line.number()};
    } else if (key == "limited_together") {
      system.limited_together = true;
    } else if (key == "gravity") {
      system.gravity = line.vector();
    } else if (key == "sphere") {
      Sphere sphere{};
      sphere.radius = line.number();
      sphere.mass = line.number();
      sphere.x = line.vector();
      sphere.v = line.vector();
      sphere.omega = line.vector();
      if (spheres++ == 0)
        system.first = sphere;
      else
        system.second = sphere;
    } else if (key == "plane") {
      const Vec3 x = line.vector();
      const Vec3 normal = line.vector();
      system.plane = Plane{x, normal, line.vector()};
    } else if (key == "run") {
      const double dt = line.number();
      runs.push_back({dt, static_cast<long>(line.number())});
    } else {
      fail("unknown item '" + key + "'; expected predictor, law, limited_together, gravity, sphere, plane or run");
    }
    line.finish();
  }
  if (!system.predictor) fail("expected 'predictor' with one of exact, trapezoid, rk2, rk4");
  if (system.form != Form::linear && !system.predictor->predicts(cfpm::LawKind::any))
    fail(std::string("predictor ") + system.predictor->name + " has no form for this law");
  if (spheres + (system.plane ? 1 : 0) != 2 || spheres == 0) fail("expected two spheres, or a sphere and a plane");
  return {system, runs};
}

void print(long step, const System &system) {
  std::printf("%ld", step);
  const auto sphere = [](const Sphere &s) {
    for (const Vec3 &a : {s.x, s.v, s.omega}) std::printf(" %.17g %.17g %.17g", a.x, a.y, a.z);
  };
  sphere(system.first);
  if (system.second) sphere(*system.second);
  std::printf("\n");
}

} // namespace

int main() {
  const auto [system, runs] = read(std::cin);
  Scheme scheme(system);
  long step = 0;
  print(step, scheme.system());
  for (const Run &run : runs) {
    scheme.start(run.dt);
    for (long n = 0; n < run.steps; ++n) {
      scheme.step();
      print(++step, scheme.system());
    }
  }
}
