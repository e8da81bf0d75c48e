// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_wall_law.h"

#include "granular_coefficients.h"
#include "granular_contacts.h"
#include "granular_pair_law.h"
#include "host_versions.h"

#include "core/contact/wider_history.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace cfpm::lammps {

namespace {

constexpr std::array<std::string_view, 5> shapes = {"xplane", "yplane", "zplane", "zcylinder", "region"};

/// Of a sphere and a wall of one material, whose moduli older hosts mix in a way of their own: E/(2 (1 - nu)) is in
/// place of E* = E/(2 (1 - nu^2)), and for Mindlin's spring E (2 - nu) (1 + nu)/4 in place of 8 G* = 2 E/((2 - nu) (1 +
/// nu)).
GranularCoefficients with_moduli_of_wall(GranularCoefficients c) {
  if (!walls_mix_by_themselves || c.young == 0.0) return c;
  c.stiffness = 2.0 / 3.0 * c.young / (1.0 - c.poisson);
  if (c.tangential_stiffness < 0.0) c.tangential_stiffness = 0.25 * c.young * (2.0 - c.poisson) * (1.0 + c.poisson);
  return c;
}

class GranularWallLaw : public WallLaw {
public:
  /// words: "granular" and the sub-models.
  explicit GranularWallLaw(std::vector<std::string> words)
      : words_(std::move(words)), coefficients_(with_moduli_of_wall(read_granular_coefficients(words_, 1))),
        alone_(std::make_shared<GranularPairs>(GranularPairs{{{wall_type, wall_type}, coefficients_}})) {}

  LawKind kind() const override { return kind_of(coefficients_); }
  bool damped_friction() const override { return coefficients_.tangential_damping > 0.0; }
  std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const override {
    if (!coefficients_.unpredicted.empty()) return {};
    return {collision(coefficients_, partners, impact_speed)};
  }
  int law_history() const override { return 0; }
  int history_size(const Method &method) const override {
    return ask_for_wider_history(*alone_) ? WiderHistory::size : WallLaw::history_size(method);
  }
  std::string reason_against_energy(const Method &method) const override {
    return cfpm::lammps::reason_against_energy(*alone_, method);
  }
  std::string reason_against(const Method &method) const override {
    if (!coefficients_.unpredicted.empty())
      return "'" + coefficients_.unpredicted + "' has no predicted form; expected " + predicted_sub_models +
             ", or 'predict verlet' for pairs and walls";
    const WithoutForm without = without_form(coefficients_, method);
    if (!without.sub_model.empty())
      return "'" + without.sub_model + "' has no form with 'predict " + method.name + "'; expected one of " +
             without.methods + ", or 'predict verlet' for pairs and walls";
    if (predicts_granular(method, kind())) return "";
    return std::string("predictor '") + method.name + "' has no form for these sub-models; expected one of " +
           names_of_granular_methods(kind()) + ", or 'predict verlet' for pairs and walls";
  }
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const override {
    return make_granular_contacts(method, kind(), alone_);
  }
  std::vector<std::string> for_host_wall() const override { return words_; }
  bool is_checked_by_host() const override { return true; }

private:
  std::vector<std::string> words_;
  GranularCoefficients coefficients_;
  std::shared_ptr<const GranularPairs> alone_; ///< these as those of all particles
};

} // namespace

WallArguments read_granular_wall(LAMMPS_NS::LAMMPS &lmp, const std::string &command, std::vector<std::string> words) {
  const MethodArguments method = take_granular_method(lmp, command, ContactOwner::wall, words);
  const auto shape = std::find_first_of(words.begin(), words.end(), shapes.begin(), shapes.end());
  return {
      method, std::make_shared<GranularWallLaw>(std::vector<std::string>(words.begin(), shape)), {shape, words.end()}};
}

} // namespace cfpm::lammps
