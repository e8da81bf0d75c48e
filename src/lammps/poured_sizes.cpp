// SPDX-License-Identifier: GPL-2.0-or-later
#include "poured_sizes.h"

#include "host.h"
#include "host_versions.h"

#include "core/deck/finite_number.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace cfpm::lammps {

namespace {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
using CreateFix = Fix *(*)(LAMMPS *, int, char **);

CreateFix host_pour = nullptr;
std::map<const Fix *, SizeRange> noted;

/// The numbers behind a keyword of the command, as many as there are.
std::vector<double> numbers_behind(const std::string &keyword, const std::vector<std::string> &words) {
  std::vector<double> numbers;
  auto word = std::find(words.begin(), words.end(), keyword);
  for (; word != words.end() && ++word != words.end();) {
    if (*word == "one" || *word == "range" || *word == "poly") continue; // how diameters are given
    const auto value = finite_number(*word);
    if (!value) break;
    numbers.push_back(*value);
  }
  return numbers;
}

ParticleSize sphere(double diameter, double density) {
  constexpr double pi = 3.14159265358979323846;
  return {0.5 * diameter, density * pi / 6.0 * diameter * diameter * diameter};
}

/// words: of a fix pour that the host has taken, from "pour" on. Not present() for molecules.
SizeRange sizes_in(const std::vector<std::string> &words) {
  if (std::find(words.begin(), words.end(), "mol") != words.end()) return {};
  std::vector<double> diameters = numbers_behind("diam", words);
  if (std::find(words.begin(), words.end(), "poly") != words.end()) {
    std::vector<double> alone; // behind how many there are each has its share
    for (std::size_t k = 1; k < diameters.size(); k += 2) alone.push_back(diameters[k]);
    diameters = alone;
  }
  if (diameters.empty()) diameters = {1.0}; // what the host does without these keywords
  std::vector<double> densities = numbers_behind("dens", words);
  if (densities.empty()) densities = {1.0};
  const auto [smallest, largest] = std::minmax_element(diameters.begin(), diameters.end());
  const auto [lightest, heaviest] = std::minmax_element(densities.begin(), densities.end());
  return {sphere(*smallest, *lightest), sphere(*largest, *heaviest)};
}

Fix *create_pour(LAMMPS *lmp, int narg, char **arg) {
  const std::vector<std::string> words(arg + std::min(narg, 2), arg + narg);
  Fix *const fix = host_pour(lmp, narg, arg);
  noted[fix] = sizes_in(words);
  return fix;
}

} // namespace

void note_poured_sizes(LAMMPS &lmp) {
  const auto found = lmp.modify->fix_map->find("pour");
  if (found == lmp.modify->fix_map->end() || found->second == create_pour) return;
  host_pour = found->second;
  found->second = create_pour;
}

SizeRange poured_sizes(LAMMPS &lmp) {
  SizeRange all{};
  for (const Fix *fix : fixes(*lmp.modify)) {
    const auto found = noted.find(fix);
    if (found != noted.end() && std::string(fix->style) == "pour") all = joined(all, found->second);
  }
  return all;
}

} // namespace cfpm::lammps
