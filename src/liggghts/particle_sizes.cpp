// SPDX-License-Identifier: GPL-2.0-or-later
#include "particle_sizes.h"

#include "host_contact_models.h"

#include "core/law/linear_law.h"

#include "fix_insert.h"
#include "fix_particledistribution_discrete.h"
#include "fix_template_sphere.h"

#include <algorithm>
#include <limits>

namespace cfpm::liggghts {

namespace {

/// Largest values of (-r, -m, r, m) per type, so that one MPI_MAX finds both ends of the ranges.
class Extremes {
public:
  explicit Extremes(int types) : values_(4 * (static_cast<std::size_t>(types) + 1), -never) {}

  void add(int type, const ParticleSize &size) {
    const double candidates[4] = {-size.radius, -size.mass, size.radius, size.mass};
    for (std::size_t k = 0; k < 4; ++k) {
      double &value = values_[4 * static_cast<std::size_t>(type) + k];
      value = std::max(value, candidates[k]);
    }
  }

  std::vector<SizeRange> over_all_ranks(MPI_Comm world) {
    MPI_Allreduce(MPI_IN_PLACE, values_.data(), static_cast<int>(values_.size()), MPI_DOUBLE, MPI_MAX, world);
    std::vector<SizeRange> ranges;
    for (std::size_t k = 0; k < values_.size(); k += 4) {
      const double *v = &values_[k];
      ranges.push_back(v[2] > 0.0 ? SizeRange{{-v[0], -v[1]}, {v[2], v[3]}} : SizeRange{});
    }
    return ranges;
  }

private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> values_;
};

double sphere_mass(double radius, double density) { return 4.0 / 3.0 * pi * radius * radius * radius * density; }

void add_templates(LAMMPS_NS::FixInsert &insertion, Extremes &extremes) {
  auto *distribution = insertion.get_distribution();
  for (int t = 0; t < distribution->n_particletemplates(); ++t) {
    auto *particle = distribution->particletemplates()[t];
    const double density = particle->massexpect() / particle->volexpect();
    for (int type = particle->mintype(); type <= particle->maxtype(); ++type)
      for (const double radius : {particle->min_rad(), particle->max_rad()})
        extremes.add(type, {radius, sphere_mass(radius, density)});
  }
}

} // namespace

std::vector<SizeRange> particle_sizes(LAMMPS_NS::LAMMPS &lmp) {
  Extremes extremes(lmp.atom->ntypes);
  for (int i = 0; i < lmp.atom->nlocal; ++i) extremes.add(lmp.atom->type[i], {lmp.atom->radius[i], lmp.atom->rmass[i]});
  for (int i = 0; i < lmp.modify->nfix; ++i)
    if (auto *insertion = dynamic_cast<LAMMPS_NS::FixInsert *>(lmp.modify->fix[i])) add_templates(*insertion, extremes);
  return extremes.over_all_ranks(lmp.world);
}

} // namespace cfpm::liggghts
