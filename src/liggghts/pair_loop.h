// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "mean_friction.h"
#include "pair_gran_cfpm.h"
#include "prediction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cfpm::liggghts {

/// Ends the contacts of listed pairs that are apart. The host's own loop does not see them before the
/// next neighbour build, and a pair that meets again by then would find its old spring.
void end_separated_contacts(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp);

/// One particle of a contact, as far as the kind of contact depends on it.
struct ContactBody {
  int type;
  bool frozen;
  double radius; ///< [m]
  double mass;   ///< [kg]

  bool operator==(const ContactBody &other) const {
    return type == other.type && frozen == other.frozen && radius == other.radius && mass == other.mass;
  }
};

inline ContactPartners partners(const ContactBody &i, const ContactBody &j) {
  const double reduced = j.frozen ? i.mass : i.frozen ? j.mass : i.mass * j.mass / (i.mass + j.mass);
  return {i.type, j.type, i.radius, j.radius, reduced};
}

/// The host's array of vectors. Its rows lie one behind the other in one block, so that an index finds
/// them without a look at the table of their addresses.
class VectorRows {
public:
  explicit VectorRows(double **rows) : first_(rows[0]) {}
  double *operator[](int i) const { return first_ + static_cast<std::ptrdiff_t>(i) * 3; }

private:
  double *first_;
};

/// For the flags and the tangential spring (null without one) in the history of a pair that is apart.
inline void end_contact(int &flags, double *spring) {
  flags &= ~(models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL);
  if (spring) std::fill_n(spring, 3, 0.0);
}

/// Adds the predicted forces of all listed pairs to f and torque, without what the host's own loop
/// carries along for output and for further contact models. Both loops give the same forces to the
/// last bit, so that it does not matter which one a step takes.
/// Tangential: the host's id; kind_of(partners): a reference to the kind of contact, valid until the
/// next call; step_of(kind, overlap, closing speed): its ContactStep.
template <int Tangential, class KindOf, class StepOf> void
add_predicted_pair_forces(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp, const KindOf &kind_of, const StepOf &step_of) {
  constexpr bool has_spring = Tangential == models::TANGENTIAL_HISTORY;
  constexpr int in_contact = models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
  const LAMMPS_NS::NeighList &list = *pair.list;
  if (list.inum == 0) return;
  LAMMPS_NS::Atom &atom = *lmp.atom;
  const VectorRows x(atom.x);
  const VectorRows v(atom.v);
  const VectorRows omega(atom.omega);
  const VectorRows f(atom.f);
  const VectorRows torque(atom.torque);
  const double *const radius = atom.radius;
  const double *const rmass = atom.rmass;
  const int *const type = atom.type;
  const int *const mask = atom.mask;
  const int frozen = pair.freeze_group_bit();
  const int receiving = lmp.force->newton_pair ? atom.nlocal + atom.nghost : atom.nlocal;
  StoredSpring stored{nullptr, pair.contacts().spring_step(), pair.shearupdate() != 0};
  const LAMMPS_NS::NeighList *const histories = pair.listgranhistory;
  const int history_size = pair.dnum();
  const int spring_offset = pair.contacts().spring_offset();

  const auto body = [=](int i) { return ContactBody{type[i], (mask[i] & frozen) != 0, radius[i], rmass[i]}; };

  // most contacts are of the kind of the one before
  ContactBody last_i{};
  ContactBody last_j{};
  decltype(&kind_of(partners(last_i, last_j))) kind = nullptr;

  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    const Vec3 xi = vec3(x[i]);
    const Motion motion_i{vec3(v[i]), vec3(omega[i])};
    const ContactBody body_i = body(i);
    if (!(body_i == last_i)) kind = nullptr;
    last_i = body_i;
    Vec3 force_i = vec3(f[i]);
    Vec3 torque_i = vec3(torque[i]);
    const int *const neighbors = list.firstneigh[i];
    int *const flags = histories ? histories->firstneigh[i] : nullptr;
    double *const springs = has_spring && histories ? histories->firstdouble[i] + spring_offset : nullptr;

    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      const int j = neighbors[jj] & NEIGHMASK;
      const Vec3 separation = xi - vec3(x[j]);
      const double squared = dot(separation, separation);
      const double touching = body_i.radius + radius[j];
      double *const spring = has_spring ? springs + static_cast<std::ptrdiff_t>(jj) * history_size : nullptr;
      if (squared >= touching * touching) {
        if (flags && flags[jj]) end_contact(flags[jj], spring);
        continue;
      }

      if (flags) flags[jj] |= in_contact;
      const ContactBody body_j = body(j);
      if (!kind || !(body_j == last_j)) {
        last_j = body_j;
        kind = &kind_of(partners(body_i, body_j));
      }
      const ContactGeometry geometry = touching_spheres(separation, std::sqrt(squared), body_i.radius, body_j.radius,
                                                        motion_i, {vec3(v[j]), vec3(omega[j])});
      const ContactStep contact = step_of(*kind, geometry.overlap, geometry.closing_speed);
      const NormalAction normal = predict_normal(contact, geometry);
      stored.values = spring;
      const Vec3 friction = mean_friction<Tangential>(contact, geometry, stored, normal.force, normal.predicted);
      const Vec3 force = normal.mean() * geometry.normal + friction;
      const Vec3 moment = cross(geometry.normal, friction);
      force_i = force_i + force;
      torque_i = torque_i + -geometry.lever_i * moment;
      if (j >= receiving) continue;
      add(-force, f[j]);
      add(-geometry.lever_j * moment, torque[j]);
    }
    set(force_i, f[i]);
    set(torque_i, torque[i]);
  }
}

} // namespace cfpm::liggghts
