// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_report.h"

#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"
#include "particle_sizes.h"

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

ContactTimes of_pairs(LawSource &source, int i, const SizeRange &a, int j, const SizeRange &b) {
  ContactTimes times;
  for (const ParticleSize &p : {a.smallest, a.largest})
    for (const ParticleSize &q : {b.smallest, b.largest}) {
      const double reduced_mass = p.mass * q.mass / (p.mass + q.mass);
      times.add(contact_time(source.law({i, j, p.radius, q.radius, reduced_mass}).normal_stiffness, reduced_mass));
    }
  return times;
}

ContactTimes at_wall(LawSource &source, int type, const SizeRange &a, int wall_type) {
  ContactTimes times;
  for (const ParticleSize &p : {a.smallest, a.largest})
    times.add(contact_time(source.law({type, wall_type, p.radius, p.radius, p.mass}).normal_stiffness, p.mass));
  return times;
}

std::string limit_of(const Predictor &predictor) {
  return std::isinf(predictor.stable_below)
             ? "no stability limit on one contact"
             : format("one contact is stable for nt > %.4g", 1.0 / predictor.stable_below);
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
  const auto row = [&](const std::string &who, const ContactTimes &times, const Predictor &predictor) {
    table += format("  %-18s tc = %.4g to %.4g, nt = tc/dt = %.4g to %.4g", who.c_str(), times.shortest, times.longest,
                    times.shortest / dt, times.longest / dt);
    if (&predictor != pair.predictor()) table += format("; predict %s, ", predictor.name) + limit_of(predictor);
    table += "\n";
    least_nt_over_limit = std::min(least_nt_over_limit, times.shortest / dt * predictor.stable_below);
  };

  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j)
      if (sizes[static_cast<std::size_t>(i)].present() && sizes[static_cast<std::size_t>(j)].present())
        row(format("types %d-%d:", i, j),
            of_pairs(pair.law_source(), i, sizes[static_cast<std::size_t>(i)], j, sizes[static_cast<std::size_t>(j)]),
            *pair.predictor());
  for (int f = 0; f < lmp.modify->nfix; ++f)
    if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(lmp.modify->fix[f]))
      for (const int wall_type : wall_types(*wall))
        for (int i = 1; i <= types; ++i)
          if (sizes[static_cast<std::size_t>(i)].present())
            row(format("type %d-wall %s:", i, wall->id),
                at_wall(wall->law_source(), i, sizes[static_cast<std::size_t>(i)], wall_type), *wall->predictor());

  const Predictor &predictor = *pair.predictor();
  std::string report = format("gran/cfpm: predict %s, dt = %.4g; ", predictor.name, dt) + limit_of(predictor) + "\n";
  report += table.empty() ? "  no particles yet\n" : table;
  return {report, least_nt_over_limit <= 1.0};
}

} // namespace cfpm::liggghts
