// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_report.h"

#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"
#include "particle_sizes.h"

#include "../core/hertz_mindlin_law.h"

#include "fix_property_global.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <limits>
#include <set>
#include <string>

namespace cfpm::liggghts {

namespace {

std::string format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char *pattern, ...) {
  char line[256];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(line, sizeof line, pattern, values);
  va_end(values);
  return line;
}

struct ContactTimes {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;

  void add(double tc) {
    shortest = std::min(shortest, tc);
    longest = std::max(longest, tc);
  }
};

ContactTimes of_pairs(PredictedContacts &contacts, int i, const SizeRange &a, int j, const SizeRange &b, double speed) {
  ContactTimes times;
  for (const ParticleSize &p : {a.smallest, a.largest})
    for (const ParticleSize &q : {b.smallest, b.largest})
      times.add(contacts.contact_time({i, j, p.radius, q.radius, p.mass * q.mass / (p.mass + q.mass)}, speed));
  return times;
}

ContactTimes at_wall(PredictedContacts &contacts, int type, const SizeRange &a, int wall_type, double speed) {
  ContactTimes times;
  for (const ParticleSize &p : {a.smallest, a.largest})
    times.add(contacts.contact_time({type, wall_type, p.radius, p.radius, p.mass}, speed));
  return times;
}

/// The predictor's limit on dt/tc for one undamped contact of that law.
double limit_of(const Predictor &predictor, bool linear_law) {
  return linear_law ? predictor.stable_below : predictor.stable_below * stiffest_hertz_contact_time();
}

std::string limit_text(double limit) {
  return std::isinf(limit) ? "no stability limit on one contact"
                           : format("one contact is stable for nt > %.4g", 1.0 / limit);
}

/// At which the durations of nonlinear contacts are given: the deck's own choice, or 1 of its units.
double impact_speed(LAMMPS_NS::LAMMPS &lmp) {
  auto *fix = static_cast<LAMMPS_NS::FixPropertyGlobal *>(lmp.modify->find_fix_property(
      "characteristicVelocity", "property/global", "scalar", 0, 0, "pair_style gran/cfpm", false));
  return fix ? fix->compute_scalar() : 1.0;
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

  double least_nt_over_limit = std::numeric_limits<double>::infinity();
  std::string table;
  bool nonlinear = false;
  const double speed = impact_speed(lmp);
  const double pair_limit = limit_of(*pair.predictor(), pair.contacts().is_linear());
  const auto row = [&](const std::string &who, const ContactTimes &times, const PredictedContacts &contacts,
                       const Predictor &predictor) {
    const double limit = limit_of(predictor, contacts.is_linear());
    nonlinear = nonlinear || !contacts.is_linear();
    table += format("  %-18s tc = %.4g to %.4g, nt = tc/dt = %.4g to %.4g", who.c_str(), times.shortest, times.longest,
                    times.shortest / dt, times.longest / dt);
    if (&predictor != pair.predictor() || limit != pair_limit)
      table += format("; predict %s, ", predictor.name) + limit_text(limit);
    table += "\n";
    least_nt_over_limit = std::min(least_nt_over_limit, times.shortest / dt * limit);
  };

  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j)
      if (sizes[static_cast<std::size_t>(i)].present() && sizes[static_cast<std::size_t>(j)].present())
        row(format("types %d-%d:", i, j),
            of_pairs(pair.contacts(), i, sizes[static_cast<std::size_t>(i)], j, sizes[static_cast<std::size_t>(j)],
                     speed),
            pair.contacts(), *pair.predictor());
  for (int f = 0; f < lmp.modify->nfix; ++f)
    if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(lmp.modify->fix[f]))
      for (const int wall_type : wall_types(*wall))
        for (int i = 1; i <= types; ++i)
          if (sizes[static_cast<std::size_t>(i)].present())
            row(format("type %d-wall %s:", i, wall->id),
                at_wall(wall->contacts(), i, sizes[static_cast<std::size_t>(i)], wall_type, speed), wall->contacts(),
                *wall->predictor());

  std::string report =
      format("gran/cfpm: predict %s, dt = %.4g; ", pair.predictor()->name, dt) + limit_text(pair_limit);
  if (nonlinear) report += format("; Hertz: tc of an impact at speed %.4g, tc ~ speed^(-1/5)", speed);
  report += table.empty() ? "\n  no particles yet\n" : "\n" + table;
  return {report, least_nt_over_limit <= 1.0};
}

} // namespace cfpm::liggghts
