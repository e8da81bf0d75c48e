// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_heat_gran_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace cfpm::liggghts {

FixHeatGranCfpm::FixHeatGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : FixHeatGranCond(lmp, narg, arg) {
  for (int k = 5; k + 1 < narg; ++k)
    if (std::string(arg[k]) == "contact_area") areas_from_overlaps_ = std::string(arg[k + 1]) == "overlap";
  // the host finds its fix by the exact name
  const std::string own = "/cfpm";
  const std::string name = style;
  if (name.size() > own.size() && name.compare(name.size() - own.size(), own.size(), own) == 0)
    style[name.size() - own.size()] = '\0';
}

void FixHeatGranCfpm::init() {
  require_cfpm_pair(*lmp, "fix heat/gran/conduction/cfpm");
  FixHeatGranCond::init();
}

bool FixHeatGranCfpm::host_loop_is_right() const {
  return !areas_from_overlaps_ || !static_cast<PairGranCfpm *>(force->pair)->method().predicted;
}

void FixHeatGranCfpm::post_force(int vflag) {
  if (host_loop_is_right()) return FixHeatGranCond::post_force(vflag);
  updatePtrs();
  if (store_contact_data_) {
    fix_conduction_contact_area_->set_all(0.0);
    fix_n_conduction_contacts_->set_all(0.0);
  }
  const bool newton = force->newton_pair != 0;
  conduct([&](int i, int j, double flux, double area) {
    const Vec3 half = 0.5 * flux * (vec3(atom->x[i]) - vec3(atom->x[j])); // the flux is located at the contact
    const auto take = [&](int k, double heat) {
      heatFlux[k] += heat;
      add(half, directionalHeatFlux[k]);
      if (!store_contact_data_) return;
      conduction_contact_area_[k] += area;
      n_conduction_contacts_[k] += 1.0;
    };
    take(i, flux);
    if (newton || j < atom->nlocal) take(j, -flux);
  });
  if (newton) {
    fix_heatFlux->do_reverse_comm();
    fix_directionalHeatFlux->do_reverse_comm();
    if (store_contact_data_) fix_conduction_contact_area_->do_reverse_comm();
    if (store_contact_data_) fix_n_conduction_contacts_->do_reverse_comm();
  }
  if (!store_contact_data_) return;
  for (int i = 0; i < atom->nlocal; ++i) // the mean of its contacts
    conduction_contact_area_[i] /= std::max(1.0, n_conduction_contacts_[i]);
}

void FixHeatGranCfpm::cpl_evaluate(LAMMPS_NS::ComputePairGranLocal *caller) {
  if (host_loop_is_right()) return FixHeatGranCond::cpl_evaluate(caller);
  updatePtrs();
  conduct([&](int i, int j, double flux, double) { caller->add_heat(i, j, flux); });
}

/// Calls give(i, j, heat to i [W], contact area [m^2]) for every contact.
template <class Give> void FixHeatGranCfpm::conduct(const Give &give) {
  for (const PairOverlap &contact : static_cast<PairGranCfpm *>(force->pair)->overlaps()) {
    const auto [i, j, overlap] = contact;
    if (!(atom->mask[i] & groupbit) && !(atom->mask[j] & groupbit)) continue;
    const double area = contact_area(i, j, overlap);
    const double ki = conductivity_[atom->type[i] - 1];
    const double kj = conductivity_[atom->type[j] - 1];
    const double transfer = std::min(ki, kj) < SMALL_FIX_HEAT_GRAN ? 0.0 : 4.0 * ki * kj / (ki + kj) * std::sqrt(area);
    give(i, j, transfer * (Temp[j] - Temp[i]), area);
  }
}

/// Of the circle in which the spheres intersect, at most of the smaller one [m^2]. overlap: [m]
double FixHeatGranCfpm::contact_area(int i, int j, double overlap) const {
  const double ri = atom->radius[i];
  const double rj = atom->radius[j];
  if (area_correction_flag_) overlap *= deltan_ratio_[atom->type[i] - 1][atom->type[j] - 1];
  const double r = ri + rj - overlap;
  if (r < std::max(ri, rj)) return pi * std::min(ri, rj) * std::min(ri, rj);
  return 0.25 * pi * overlap * (r + ri - rj) * (r - ri + rj) * (r + ri + rj) / (r * r);
}

} // namespace cfpm::liggghts
