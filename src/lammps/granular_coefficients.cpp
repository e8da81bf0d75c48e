// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_coefficients.h"

#include "host_versions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace cfpm::lammps {

namespace {

using Coefficients = GranularCoefficients;
using Damping = Coefficients::Damping;
using Normal = Coefficients::Normal;
using Tangential = Coefficients::Tangential;
using Twisting = Coefficients::Twisting;

/// The words one after the other.
class Words {
public:
  Words(const std::vector<std::string> &words, std::size_t first) : words_(words), next_(first) {}
  bool left() const { return next_ < words_.size(); }
  std::string word() { return left() ? words_[next_++] : ""; }
  double number() { return std::strtod(word().c_str(), nullptr); }

private:
  const std::vector<std::string> &words_;
  std::size_t next_;
};

/// False if the model has no predicted form.
bool read_normal(const std::string &model, Words &words, Coefficients &c) {
  c.adheres = model == "dmt";
  const bool of_material = c.adheres || model == "hertz/material";
  if (model != "hooke" && model != "hertz" && !of_material) return false;
  c.normal = model == "hooke" ? Normal::hooke : Normal::hertz;
  c.stiffness = words.number();
  c.damping_coefficient = words.number();
  if (!of_material) return true;
  c.young = c.stiffness;
  c.poisson = words.number();
  if (c.adheres) c.surface_energy = words.number();
  return true;
}

bool read_damping(const std::string &model, Coefficients &c) {
  const struct {
    const char *name;
    Damping damping;
  } models[] = {{"velocity", Damping::velocity},
                {"mass_velocity", Damping::mass_velocity},
                {"viscoelastic", Damping::viscoelastic},
                {"tsuji", Damping::tsuji},
                {"coeff_restitution", Damping::coeff_restitution}};
  for (const auto &known : models)
    if (model == known.name) {
      c.damping = known.damping;
      return true;
    }
  return false;
}

bool read_tangential(const std::string &model, Words &words, Coefficients &c) {
  const struct {
    const char *name;
    Tangential tangential;
    bool spring, keeps_force, rescales;
  } models[] = {{"linear_nohistory", Tangential::linear, false, false, false},
                {"linear_history", Tangential::linear, true, false, false},
                {"mindlin", Tangential::mindlin, true, false, false},
                {"mindlin/force", Tangential::mindlin, true, true, false},
                {"mindlin_rescale", Tangential::mindlin, true, false, true},
                {"mindlin_rescale/force", Tangential::mindlin, true, true, true}};
  const auto *const found =
      std::find_if(std::begin(models), std::end(models), [&](const auto &known) { return model == known.name; });
  if (found == std::end(models)) return false;
  c.tangential = found->tangential;
  c.has_spring = found->spring;
  c.keeps_force = found->keeps_force;
  c.rescales = found->rescales;
  if (c.has_spring) {
    const std::string stiffness = words.word();
    c.tangential_stiffness = stiffness == "NULL" ? -1.0 : std::strtod(stiffness.c_str(), nullptr);
  }
  c.tangential_damping = words.number();
  c.friction = words.number();
  return true;
}

bool read_rolling(const std::string &model, Words &words, Coefficients &c) {
  c.rolls = model == "sds";
  if (c.rolls) {
    c.rolling_stiffness = words.number();
    c.rolling_damping = words.number();
    c.rolling_friction = words.number();
  }
  return c.rolls || model == "none";
}

bool read_twisting(const std::string &model, Words &words, Coefficients &c) {
  c.twisting = model == "sds" ? Twisting::sds : model == "marshall" ? Twisting::marshall : Twisting::none;
  if (c.twisting == Twisting::sds) {
    c.twisting_stiffness = words.number();
    c.twisting_damping = words.number();
    c.twisting_friction = words.number();
  }
  return c.twisting != Twisting::none || model == "none";
}

/// The host of 2021 takes any number, -1 as the stiffness of the material. A restitution of 0 has no damping_ratio()
/// but Tsuji's.
bool is_physical(const Coefficients &c) {
  const bool of_restitution = c.damping == Damping::tsuji || c.damping == Damping::coeff_restitution;
  const bool of_material = c.tangential_stiffness == -1.0 && c.young > 0.0;
  return c.stiffness >= 0.0 && (c.tangential_stiffness >= 0.0 || of_material) && c.damping_coefficient >= 0.0 &&
         !(of_restitution && c.damping_coefficient > 1.0) &&
         !(c.damping == Damping::coeff_restitution && c.damping_coefficient == 0.0) && std::fabs(c.poisson) < 1.0 &&
         c.surface_energy >= 0.0 && c.tangential_damping >= 0.0 && c.friction >= 0.0 && c.rolling_stiffness >= 0.0 &&
         c.rolling_damping >= 0.0 && c.rolling_friction >= 0.0 && c.twisting_stiffness >= 0.0 &&
         c.twisting_damping >= 0.0 && c.twisting_friction >= 0.0;
}

// The host's order of operations in what follows: "predict verlet" is to have its bits.

/// 4/3 E*
double stiffness_of(double young_i, double poisson_i, double young_j, double poisson_j) {
  return 4.0 / 3.0 * (1.0 / ((1.0 - poisson_i * poisson_i) / young_i + (1.0 - poisson_j * poisson_j) / young_j));
}

/// 8 G* of two bodies of the material
double tangential_stiffness_of(const Coefficients &c) {
  if (c.tangential_stiffness >= 0.0) return c.tangential_stiffness;
  return 8.0 / (2.0 * (2.0 * (2.0 - c.poisson) * (1.0 + c.poisson) / c.young));
}

/// Of a restitution e. Tsuji's is a fit, the other the exact solution of a contact that lasts until the bodies part.
double damping_ratio(const Coefficients &c) {
  const double e = c.damping_coefficient;
  if (c.damping == Damping::tsuji) {
    const double square = e * e;
    const double fourth = square * square;
    const double quadratic = 1.2728 - 4.2783 * e + 11.087 * square;
    const double cubic = 22.348 * (square * e);
    const double quartic = 27.467 * fourth;
    const double quintic = 18.022 * (e * fourth);
    const double sextic = 4.8218 * (square * fourth);
    if constexpr (granular_order == GranularOrder::of_2021)
      return quadratic - cubic + quartic - quintic + sextic;
    else
      return quadratic + (quartic - cubic) + (sextic - quintic);
  }
  if (c.damping != Damping::coeff_restitution) return 0.0;
  const double log = std::log(e);
  return (c.normal == Normal::hooke ? -2.0 : -std::sqrt(5.0)) * log / std::sqrt(pi * pi + log * log);
}

} // namespace

const GranularCoefficients &of_types(const GranularPairs &pairs, int type_i, int type_j) {
  if (type_j == wall_type) return pairs.at({wall_type, wall_type});
  return pairs.at({std::min(type_i, type_j), std::max(type_i, type_j)});
}

GranularCoefficients read_granular_coefficients(const std::vector<std::string> &words, std::size_t first) {
  Coefficients c;
  Words next(words, first);
  const auto give_up = [&c](const std::string &what) {
    if (c.unknown.empty()) c.unknown = what;
    c.unpredicted = what;
    return c;
  };
  while (next.left()) {
    const std::string word = next.word();
    if (word == "limit_damping") {
      c.limit_damping = true;
    } else if (word == "cutoff") { // for the host's lists
      next.word();
    } else if (word == "damping" || word == "tangential" || word == "rolling" || word == "twisting") {
      const std::string model = next.word();
      const bool known = word == "damping"      ? read_damping(model, c)
                         : word == "tangential" ? read_tangential(model, next, c)
                         : word == "rolling"    ? read_rolling(model, next, c)
                                                : read_twisting(model, next, c);
      if (!known) return give_up(std::string(word).append(" ").append(model));
    } else if (!read_normal(word, next, c)) {
      return give_up(word);
    } else if (c.adheres && limits_dmt_at_random && c.unknown.empty()) {
      c.unknown = word;
    }
  }
  if (!is_physical(c)) return give_up("a coefficient out of its range");
  c.damping_ratio = damping_ratio(c);
  if (c.young > 0.0) c.stiffness = stiffness_of(c.young, c.poisson, c.young, c.poisson);
  return c;
}

GranularCoefficients mixed(const GranularCoefficients &a, const GranularCoefficients &b) {
  Coefficients c = a;
  const bool alike = a.normal == b.normal && a.adheres == b.adheres && a.damping == b.damping &&
                     a.tangential == b.tangential && a.keeps_force == b.keeps_force && a.rescales == b.rescales &&
                     a.rolls == b.rolls && a.twisting == b.twisting && (a.young > 0.0) == (b.young > 0.0) &&
                     a.limit_damping == b.limit_damping;
  c.unpredicted = !a.unpredicted.empty() ? a.unpredicted : !b.unpredicted.empty() ? b.unpredicted : "";
  if (!alike && c.unpredicted.empty()) c.unpredicted = "a mixture of different sub-models";
  const auto mean = [](double x, double y) { return std::sqrt(x * y); };
  c.young = mean(a.young, b.young);
  c.poisson = mean(a.poisson, b.poisson);
  c.surface_energy = mean(a.surface_energy, b.surface_energy);
  c.stiffness = a.young > 0.0 && b.young > 0.0 ? stiffness_of(a.young, a.poisson, b.young, b.poisson)
                                               : mean(a.stiffness, b.stiffness);
  c.damping_coefficient = mean(a.damping_coefficient, b.damping_coefficient);
  c.damping_ratio = damping_ratio(c);
  const bool of_material = a.tangential_stiffness < 0.0 || b.tangential_stiffness < 0.0;
  c.tangential_stiffness = of_material ? -1.0 : mean(a.tangential_stiffness, b.tangential_stiffness);
  c.tangential_damping = mean(a.tangential_damping, b.tangential_damping);
  c.friction = mean(a.friction, b.friction);
  c.rolling_stiffness = mean(a.rolling_stiffness, b.rolling_stiffness);
  c.rolling_damping = mean(a.rolling_damping, b.rolling_damping);
  c.rolling_friction = mean(a.rolling_friction, b.rolling_friction);
  c.twisting_stiffness = mean(a.twisting_stiffness, b.twisting_stiffness);
  c.twisting_damping = mean(a.twisting_damping, b.twisting_damping);
  c.twisting_friction = mean(a.twisting_friction, b.twisting_friction);
  return c;
}

std::string GranularCoefficients::resistance() const {
  if (rolls) return "rolling sds";
  return twisting == Twisting::sds ? "twisting sds" : twisting == Twisting::marshall ? "twisting marshall" : "";
}

GranularMaterial<double> material_of(const GranularCoefficients &c) {
  GranularMaterial<double> material{};
  (c.normal == Normal::hertz ? material.normal_area : material.normal_constant) = c.stiffness;
  switch (c.damping) {
  case Damping::velocity:
    material.damping_constant = c.damping_coefficient;
    break;
  case Damping::mass_velocity:
    material.damping_mass = c.damping_coefficient;
    break;
  case Damping::viscoelastic:
    material.damping_area = c.damping_coefficient;
    break;
  case Damping::tsuji:
  case Damping::coeff_restitution:
    material.damping_ratio = c.damping_ratio;
    break;
  }
  if (c.tangential == Tangential::mindlin)
    material.tangential_area = tangential_stiffness_of(c);
  else
    material.tangential_constant = c.tangential_stiffness;
  material.tangential_damping = c.tangential_damping;
  material.friction = c.friction;
  material.least_force = without_tension;
  if (!c.limit_damping) material.least_force = with_tension;
  return material;
}

BasicAreaSpring<double> area_spring_of(const GranularCoefficients &c) {
  if (!c.follows_area()) return {};
  return {c.keeps_force ? 1.0 : 0.0, c.rescales ? 1.0 : 0.0};
}

AdhesiveMaterial<double> adhesion_of(const GranularCoefficients &c) {
  if (!c.adheres) return {};
  return {4.0 * pi * c.surface_energy, 1.0};
}

BasicTurnResistance<double> turn_resistance_of(const GranularCoefficients &c) {
  return {c.rolling_stiffness,
          c.rolling_damping,
          c.rolling_friction,
          c.twisting_stiffness,
          c.twisting_damping,
          c.twisting_friction,
          c.twisting == Twisting::marshall ? 1.0 : 0.0,
          material_of(c),
          adhesion_of(c)};
}

GranularSubModels<double> sub_models_of(const GranularCoefficients &c) {
  const auto number = [](bool holds) { return holds ? 1.0 : 0.0; };
  const double pull_of_radius = 4.0 * pi * c.surface_energy; // in the host's order
  return {number(!c.has_spring),
          number(!c.has_spring || c.keeps_force),
          number(c.rescales),
          number(c.rolls),
          c.rolling_stiffness,
          c.rolling_damping,
          c.rolling_friction,
          number(c.resists_twisting()),
          number(c.twisting == Twisting::marshall),
          c.twisting_stiffness,
          c.twisting_damping,
          c.twisting_friction,
          number(c.adheres),
          c.adheres ? pull_of_radius : 0.0};
}

bool has_more_sub_models(const GranularCoefficients &c) {
  return c.keeps_force || c.rescales || c.resists_twisting() || c.adheres;
}

bool ask_for_wider_history(const GranularPairs &pairs) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [](const auto &pair) { return pair.second.follows_area() || pair.second.resists_turns(); });
}

std::string reason_against_energy(const GranularPairs &pairs, const Method &method) {
  if (!method.predicted) return "with 'predict verlet' its contacts are not told of; expected predicted contacts";
  if (!ask_for_wider_history(pairs)) return "";
  return "what springs hold of rolling, twisting, mindlin/force and mindlin_rescale is not told of; expected none of "
         "these";
}

GranularLaw law_of(const GranularCoefficients &coefficients, const ContactPartners &partners) {
  return granular_law(material_of(coefficients), sizes_of(partners));
}

LawKind kind_of(const GranularCoefficients &c) {
  if (c.follows_area() || c.adheres) return LawKind::any;
  const bool no_spring = c.tangential_stiffness == 0.0;
  if (c.normal == Normal::hooke && c.damping != Damping::viscoelastic &&
      (no_spring || c.tangential == Tangential::linear))
    return LawKind::linear;
  const bool undamped =
      (c.damping == Damping::velocity || c.damping == Damping::mass_velocity) && c.damping_coefficient == 0.0;
  const bool tsuji = c.damping == Damping::tsuji || c.damping == Damping::coeff_restitution || undamped;
  const bool grows = c.normal == Normal::hertz && (no_spring || c.tangential == Tangential::mindlin);
  if (grows && tsuji) return LawKind::self_similar;
  return grows && c.damping == Damping::viscoelastic ? LawKind::viscoelastic : LawKind::any;
}

Collision collision(const GranularCoefficients &c, const ContactPartners &partners, double impact_speed) {
  const double mass = partners.reduced_mass;
  const GranularLaw law = law_of(c, partners);
  const LawKind kind = kind_of(c);
  if (c.normal == Normal::hooke)
    return {contact_time(law.normal_constant, mass), false,
            kind == LawKind::linear ? restitution(as_linear(law), mass) : Restitution{}};
  return {hertz_contact_time(law.normal_half, mass, impact_speed), true,
          kind == LawKind::self_similar ? restitution(as_self_similar(law), mass) : Restitution{}};
}

} // namespace cfpm::lammps
