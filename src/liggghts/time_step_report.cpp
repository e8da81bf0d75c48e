// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_report.h"

#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"
#include "particle_sizes.h"

#include "core/numbers/instruction_set.h"

#include "fix_property_global.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

namespace cfpm::liggghts {

namespace {

/// q: of no size at a wall.
void add(ContactTimes &times, ContactModelInterface &model, const ContactPartners &partners, double speed,
         const ParticleSize &p, const ParticleSize &q) {
  const double tc = model.contact_time(partners, speed);
  times.add(tc, model.restitution(partners));
  times.collisions.push_back({tc, model.law() != LawKind::linear, p.radius, q.radius, p.mass, q.mass});
}

ContactTimes of_pairs(ContactModelInterface &model, int i, const SizeRange &a, int j, const SizeRange &b,
                      double speed) {
  ContactTimes times;
  for (const ParticleSize &p : {a.smallest, a.largest})
    for (const ParticleSize &q : {b.smallest, b.largest})
      add(times, model, {i, j, p.radius, q.radius, p.mass * q.mass / (p.mass + q.mass)}, speed, p, q);
  return times;
}

ContactTimes at_wall(ContactModelInterface &model, int type, const SizeRange &a, int wall_type, double speed) {
  ContactTimes times;
  constexpr double flat = 1e12; // a model of pairs asks for the other radius, one of a wall does not
  for (const ParticleSize &p : {a.smallest, a.largest})
    add(times, model, {type, wall_type, p.radius, flat * p.radius, p.mass}, speed, p, {});
  return times;
}

/// At which the durations of nonlinear contacts are given: the deck's own choice, or 1 of its units.
double impact_speed(LAMMPS_NS::LAMMPS &lmp) {
  auto *fix = static_cast<LAMMPS_NS::FixPropertyGlobal *>(lmp.modify->find_fix_property(
      "characteristicVelocity", "property/global", "scalar", 0, 0, "pair_style gran/cfpm", false));
  return fix ? fix->compute_scalar() : 1.0;
}

/// Least over the particles of all types; infinite without elastic constants in the deck.
double least_rayleigh_time(LAMMPS_NS::LAMMPS &lmp, const std::vector<SizeRange> &sizes) {
  double least = std::numeric_limits<double>::infinity();
  const auto property = [&lmp](const char *name) {
    return static_cast<LAMMPS_NS::FixPropertyGlobal *>(lmp.modify->find_fix_property(
        name, "property/global", "peratomtype", lmp.atom->ntypes, 0, "pair_style gran/cfpm", false));
  };
  LAMMPS_NS::FixPropertyGlobal *const young = property("youngsModulus");
  LAMMPS_NS::FixPropertyGlobal *const poisson = property("poissonsRatio");
  if (!young || !poisson) return least;
  for (int i = 1; i <= lmp.atom->ntypes; ++i) {
    const SizeRange &size = sizes[static_cast<std::size_t>(i)];
    if (size.present())
      least =
          std::min(least, rayleigh_time(size.smallest, young->compute_vector(i - 1), poisson->compute_vector(i - 1)));
  }
  return least;
}

std::set<int> wall_types(const FixWallGranCfpm &wall) {
  if (!wall.is_mesh_wall()) return {wall.atom_type_wall()};
  std::set<int> types;
  for (int m = 0; m < wall.n_meshes(); ++m) types.insert(wall.mesh_list()[m]->atomTypeWall());
  return types;
}

} // namespace

TimeStepReport report_time_step(LAMMPS_NS::LAMMPS &lmp) {
  const auto &pair = static_cast<const PairGranCfpm &>(*lmp.force->pair);
  const double dt = lmp.update->dt;
  const std::vector<SizeRange> sizes = particle_sizes(lmp);
  const int types = lmp.atom->ntypes;

  const double speed = impact_speed(lmp);
  TimeStepReport report(pair.method(), pair.contact_model().law(), pair.onset_of(pair.method()), dt, speed);
  if (pair.automatic()) report.set_auto(*pair.automatic());
  report.set_before(pair.ran());
  report.set_left_to_host(pair.left_to_host());
  if (!pair.contact_model().has_host_models()) report.set_instructions(instruction_set()); // else the host's loop runs
  const auto add = [&](const std::string &who, const ContactTimes &times, const ContactModelInterface &model,
                       const Method &method) { report.add(who, times, method, model.law(), pair.onset_of(method)); };
  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j)
      if (sizes[static_cast<std::size_t>(i)].present() && sizes[static_cast<std::size_t>(j)].present())
        add("types " + std::to_string(i) + "-" + std::to_string(j) + ":",
            of_pairs(pair.contact_model(), i, sizes[static_cast<std::size_t>(i)], j, sizes[static_cast<std::size_t>(j)],
                     speed),
            pair.contact_model(), pair.method());
  for (int f = 0; f < lmp.modify->nfix; ++f)
    if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(lmp.modify->fix[f]))
      for (const int wall_type : wall_types(*wall))
        for (int i = 1; i <= types; ++i)
          if (sizes[static_cast<std::size_t>(i)].present())
            add("type " + std::to_string(i) + "-wall " + wall->id + ":",
                at_wall(wall->contact_model(), i, sizes[static_cast<std::size_t>(i)], wall_type, speed),
                wall->contact_model(), wall->method());

  report.set_rayleigh_time(least_rayleigh_time(lmp, sizes));
  return report;
}

double shortest_contact(LAMMPS_NS::LAMMPS &lmp) {
  ContactModelInterface &model = static_cast<const PairGranCfpm &>(*lmp.force->pair).contact_model();
  const double speed = impact_speed(lmp);
  const std::vector<SizeRange> sizes = particle_sizes(lmp);
  const int types = lmp.atom->ntypes;
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= types; ++i) {
    const SizeRange &a = sizes[static_cast<std::size_t>(i)];
    if (!a.present()) continue;
    for (int j = i; j <= types; ++j) {
      const SizeRange &b = sizes[static_cast<std::size_t>(j)];
      if (b.present()) shortest = std::min(shortest, of_pairs(model, i, a, j, b, speed).shortest);
    }
    for (int f = 0; f < lmp.modify->nfix; ++f)
      if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(lmp.modify->fix[f]))
        for (const int wall_type : wall_types(*wall))
          shortest = std::min(shortest, at_wall(model, i, a, wall_type, speed).shortest);
  }
  return shortest;
}

} // namespace cfpm::liggghts
