// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_report.h"

#include "fix_wall_gran_cfpm.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"
#include "poured_sizes.h"

#include "core/numbers/instruction_set.h"

#include <limits>
#include <string>
#include <vector>

namespace cfpm::lammps {

namespace {

constexpr double impact_speed = 1.0; // of the deck's units; the host's styles have no property for it

/// Of the particles of all ranks.
SizeRange particle_sizes(LAMMPS_NS::LAMMPS &lmp) {
  constexpr double never = -std::numeric_limits<double>::infinity();
  double extremes[4] = {never, never, never, never}; // -r, -m, r, m: one reduction finds both ends
  for (int i = 0; i < lmp.atom->nlocal; ++i) {
    const double r = lmp.atom->radius[i];
    const double m = lmp.atom->rmass[i];
    const double candidates[4] = {-r, -m, r, m};
    for (int k = 0; k < 4; ++k) extremes[k] = std::max(extremes[k], candidates[k]);
  }
  MPI_Allreduce(MPI_IN_PLACE, extremes, 4, MPI_DOUBLE, MPI_MAX, lmp.world);
  return extremes[2] > 0.0 ? SizeRange{{-extremes[0], -extremes[1]}, {extremes[2], extremes[3]}} : SizeRange{};
}

} // namespace

TimeStepReport report_time_step(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  const PairLaw &law = pair.law();
  TimeStepReport report(pair.method(), law.kind(), pair.onset_of(pair.method()), lmp.update->dt, impact_speed);
  if (pair.automatic()) report.set_auto(*pair.automatic());
  report.set_before(pair.ran());
  report.set_instructions(instruction_set());
  report.set_left_to_host(pair.left_to_host());
  const SizeRange sizes = joined(particle_sizes(lmp), poured_sizes(lmp));
  if (!sizes.present()) return report;
  const auto times_of = [&](bool wall, const auto &collide) {
    ContactTimes times;
    for (const ParticleSize &p : {sizes.smallest, sizes.largest}) {
      const ContactPartners partners =
          wall ? at_wall(0, p.radius, p.mass) : ContactPartners{0, 0, p.radius, p.radius, 0.5 * p.mass};
      const ParticleSize other = wall ? ParticleSize{} : p;
      for (const Collision &found : collide(partners)) {
        times.add(found.contact_time, found.restitution);
        times.collisions.push_back({found.contact_time, found.hertz, p.radius, other.radius, p.mass, other.mass});
      }
    }
    return times;
  };
  const ContactTimes times = times_of(false, [&](const ContactPartners &p) { return law.collisions(p, impact_speed); });
  report.add("pairs:", times, pair.method(), law.kind(), pair.onset_of(pair.method()), law.damped_friction());
  for (const LAMMPS_NS::Fix *fix : fixes(*lmp.modify))
    if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(fix)) {
      const WallLaw &of_wall = wall->law();
      const Method &method = wall->method_beside(pair);
      report.add(std::string("wall ") + wall->id + ":",
                 times_of(true, [&](const ContactPartners &p) { return of_wall.collisions(p, impact_speed); }), method,
                 of_wall.kind(), pair.onset_of(method), of_wall.damped_friction());
    }
  return report;
}

} // namespace cfpm::lammps
