// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/crowd_response_table.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/motion/exact_flow.h"
#include "core/motion/hertz_motion.h"
#include "core/motion/hertz_trajectory.h"
#include "core/motion/oscillator.h"
#include "core/motion/release.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace cfpm {

/// What contacts with the same ratios share.
struct HertzTables {
  std::shared_ptr<const HertzTrajectory> trajectory;      ///< of HertzImpulse::alpha()
  std::shared_ptr<const CrowdResponseTable> normal, slip; ///< of the damping ratios of normal_at() and slip_at()
};

/// The numbers that contacts in a crowd are computed from over a whole step, see LinearCrowdStep. A contact answers as
/// the linear one that touches its law at the overlap which the state has where it comes to rest without damping,
/// nearly: in all of them time runs as the fourth root of the overlap.
template <class R> struct HertzCrowdStep {
  R dt;              ///< [s]
  R reduced_mass;    ///< m* [kg]
  R tangential_mass; ///< mt [kg]
  R friction;
  HertzMindlinLaw<DampingExponent::quarter, R> law;
  BasicHertzMotion<R> motion;
  R normal_rate; ///< see CrowdResponseTable, at an overlap of 1 [1/(s m^(1/4))]
  R slip_rate;   ///< likewise
  BasicCrowdResponseTable<R> normal, slip;

  /// See LinearImpulse.
  [[gnu::always_inline]] BasicNormalImpulse<R> normal_in_crowd(const R &signed_overlap, const R &closing_speed,
                                                               const R &crowding) const {
    const R overlap = larger(R(0.0), signed_overlap);
    const BasicCrowdResponse<R> response = response_at(overlap, closing_speed);
    const R softened = response.softening * overlap;
    const R force = law.at(softened).normal_force(softened, closing_speed);
    const R hold = select(law.least_force < R(0.0), softened, force);
    const auto gone = R(0.0) >= larger(hold, closing_speed); // nothing holds bodies that do not approach
    const auto start = motion.place(softened, fourth_root(softened), closing_speed);
    const R end = start.phase + motion.rate * start.l * dt;
    const auto held = end < motion.trajectory.duration;
    const std::array<R, 2> state = motion.trajectory.state(end);
    const R d = select(held, state[0], motion.trajectory.release_overlap);
    const R u = select(held, state[1], motion.trajectory.release_speed);
    const R length = start.l * start.l * start.l * start.l;
    const R impulse =
        response.relaxation(crowding) * reduced_mass * (closing_speed - motion.rate * start.l * length * u);
    BasicNormalImpulse<R> action;
    action.impulse = select(gone, 0.0, impulse);
    action.contact_time = select(gone, 0.0, dt);
    action.mean_overlap = larger(overlap, 0.5 * (overlap + length * d)); // at rest the others hold it where it is
    return action;
  }
  /// Along the normal, at an overlap that is not negative.
  [[gnu::always_inline]] BasicCrowdResponse<R> response_at(const R &overlap, const R &closing_speed) const {
    return normal.at(normal_rate * motion.size(overlap, fourth_root(overlap), closing_speed), dt, dt);
  }
  [[gnu::always_inline]] BasicCrowdResponse<R> slip_in_crowd(const BasicNormalImpulse<R> &action) const {
    return slip_after(dt, action.mean_overlap);
  }
  /// contact_time: [s]; mean_overlap: [m]
  [[gnu::always_inline]] BasicCrowdResponse<R> slip_after(const R &contact_time, const R &mean_overlap) const {
    return slip.at(slip_rate * fourth_root(mean_overlap), contact_time, dt);
  }
  /// See LinearImpulse; that of the mean overlap.
  [[gnu::always_inline]] R retardation(const BasicNormalImpulse<R> &action) const {
    const R stiffness = law.tangential_stiffness * fourth_root(action.mean_overlap);
    return select(R(0.0) < stiffness, law.tangential_damping / stiffness, R(0.0));
  }
};

/// Of contacts whose tables are these; see HertzImpulse.
template <class R> [[gnu::always_inline]] inline HertzCrowdStep<R>
hertz_crowd_step(const HertzMindlinLaw<DampingExponent::quarter, R> &law, const BasicHertzTrajectory<R> &trajectory,
                 const BasicCrowdResponseTable<R> &normal, const BasicCrowdResponseTable<R> &slip,
                 const R &reduced_mass, const R &tangential_reduced_mass, const R &dt) {
  const BasicLinearLaw<R> unit = law.at(R(1.0));
  return {dt,
          reduced_mass,
          tangential_reduced_mass,
          law.friction,
          law,
          hertz_motion(law.normal_stiffness, trajectory, reduced_mass),
          response_rate<R>({1.5 * unit.normal_stiffness, unit.normal_damping, reduced_mass}),
          response_rate<R>({unit.tangential_stiffness, unit.tangential_damping, tangential_reduced_mass}),
          normal,
          slip};
}

/// The parameters of contacts with Hertz' law and the damping of the paper, whose exact motion is read from the one
/// trajectory of its alpha. The tangential stiffness varies inside the step: the one of the mean overlap stands for it,
/// in each part of an isolated contact, over the whole of a crowded one.
class HertzImpulse {
public:
  using Law = HertzMindlinLaw<DampingExponent::quarter>;
  template <class R> using CrowdStep = HertzCrowdStep<R>;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  HertzImpulse(const Law &law, HertzTables tables, double reduced_mass, double tangential_reduced_mass, double dt)
      : law_(law), tables_(std::move(tables)),
        motion_(hertz_motion(law.normal_stiffness, tables_.trajectory->tables(), reduced_mass)), mass_(reduced_mass),
        tangential_mass_(tangential_reduced_mass), dt_(dt),
        crowd_(hertz_crowd_step(law, tables_.trajectory->tables(), tables_.normal->table(), tables_.slip->table(),
                                reduced_mass, tangential_reduced_mass, dt)) {}

  /// h/sqrt(k m*), below sqrt(5) where the damping lets bodies rebound.
  static double alpha(const Law &law, double reduced_mass) {
    return law.normal_damping / std::sqrt(law.normal_stiffness * reduced_mass);
  }

  /// The linear contact that touches the law at an overlap [m].
  static Oscillator normal_at(const Law &law, double reduced_mass, double overlap) {
    const LinearLaw secant = law.at(overlap);
    return {1.5 * secant.normal_stiffness, secant.normal_damping, reduced_mass};
  }
  static Oscillator slip_at(const Law &law, double tangential_reduced_mass, double overlap) {
    const LinearLaw secant = law.at(overlap);
    return {secant.tangential_stiffness, secant.tangential_damping, tangential_reduced_mass};
  }

  double dt() const { return dt_; }
  double reduced_mass() const { return mass_; }
  /// In a crowd over a whole step.
  const CrowdStep<double> *crowd_step() const { return &crowd_; }
  /// What acts at an overlap [m].
  LinearLaw law(double overlap) const { return law_.at(overlap); }

  NormalImpulse normal(double overlap, double closing_speed, double span) const {
    overlap = std::max(0.0, overlap);
    const double force = law_.at(overlap).normal_force(overlap, closing_speed);
    if (released(overlap, force, closing_speed)) return {};
    const BasicHertzFlight<double> end = motion_.fly(overlap, fourth_root(overlap), closing_speed, span);
    return {mass_ * (closing_speed - end.closing_speed),
            mass_ * (overlap + span * closing_speed - end.overlap),
            end.contact_time,
            force,
            end.mean_overlap,
            closing_speed,
            motion_.trajectory.duration / end.phase_rate};
  }

  /// See LinearImpulse.
  double spring_energy(double overlap) const { return law_.spring_energy(overlap); }
  double softening(double overlap, double closing_speed) const {
    return crowd_.response_at(std::max(0.0, overlap), closing_speed).softening;
  }
  /// ks at an overlap [N/m], 0 without tangential spring.
  double spring_stiffness(double overlap) const { return law_.at(overlap).tangential_stiffness; }

  /// See LinearImpulse.
  NormalImpulse normal_in_crowd(double overlap, double closing_speed, double span, double crowding) const {
    if (span == dt_) return crowd_.normal_in_crowd(overlap, closing_speed, crowding);
    overlap = std::max(0.0, overlap);
    if (overlap == 0.0 && closing_speed <= 0.0) return {};
    const CrowdResponse response = crowd_.response_at(overlap, closing_speed);
    NormalImpulse action = normal(response.softening * overlap, closing_speed, span);
    action.impulse *= response.relaxation(crowding);
    return action;
  }

  /// See LinearImpulse.
  CrowdResponse slip_in_crowd(const NormalImpulse &normal) const {
    return crowd_.slip_after(normal.contact_time, normal.mean_overlap);
  }
  /// See LinearImpulse.
  double retardation(const NormalImpulse &normal) const { return crowd_.retardation(normal); }

  /// See LinearImpulse; the tangential stiffness of a part is that of its mean overlap.
  template <class Use> [[gnu::always_inline]] void in_parts(double overlap, double closing_speed, double contact_time,
                                                            int parts, const Use &use) const {
    const double part = contact_time / parts;
    overlap = std::max(0.0, overlap);
    const auto [phase, l] = motion_.place(overlap, fourth_root(overlap), closing_speed);
    const double length = l * l * l * l;
    for (int k = 1; k <= parts; ++k) {
      const auto [d, u] =
          motion_.trajectory.state(std::min(motion_.trajectory.duration, phase + k * part * motion_.rate * l));
      const double end_overlap = length * d;
      const double end_speed = motion_.rate * l * length * u;
      const LinearLaw end_law = law_.at(end_overlap);
      const double mean_overlap = 0.5 * (overlap + end_overlap);
      use(NormalPart{mass_ * (closing_speed - end_speed), mean_overlap,
                     end_law.limited(end_law.normal_force(end_overlap, end_speed)), law_.at(mean_overlap), end_law},
          exact_flow(slip_at(law_, tangential_mass_, mean_overlap), part));
      overlap = end_overlap;
      closing_speed = end_speed;
    }
  }

  double tangential_mass() const { return tangential_mass_; }
  double friction() const { return law_.friction; }

private:
  /// Of bodies that do not approach.
  bool released(double overlap, double force, double closing_speed) const {
    return (law_.tension() ? overlap : force) <= 0.0 && closing_speed <= 0.0; // the rare one first
  }

  Law law_;
  HertzTables tables_;
  BasicHertzMotion<double> motion_;
  double mass_;            ///< [kg]
  double tangential_mass_; ///< [kg]
  double dt_;              ///< [s]
  CrowdStep<double> crowd_;
};

} // namespace cfpm
