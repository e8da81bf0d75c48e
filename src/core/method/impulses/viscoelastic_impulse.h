// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/motion/exact_flow.h"
#include "core/motion/flow_by_series.h"
#include "core/motion/hertz_motion.h"
#include "core/motion/oscillator.h"
#include "core/motion/viscoelastic_motion.h"
#include "core/numbers/pack.h"

#include <algorithm>

namespace cfpm {

/// The numbers that contacts in a crowd are computed from over a whole step, see HertzCrowdStep. Their damping ratios
/// grow with the overlap, so that the linear contact that touches the law is followed by series, not read from tables.
template <class R> struct ViscoelasticCrowdStep {
  R dt;              ///< [s]
  R reduced_mass;    ///< m* [kg]
  R tangential_mass; ///< mt [kg]
  R friction;
  HertzMindlinLaw<DampingExponent::half, R> law;
  BasicViscoelasticMotion<R> motion;

  /// See LinearImpulse.
  [[gnu::always_inline]] BasicNormalImpulse<R> normal_in_crowd(const R &signed_overlap, const R &closing_speed,
                                                               const R &crowding) const {
    const R overlap = larger(R(0.0), signed_overlap);
    const BasicCrowdResponse<R> response = response_at(overlap, closing_speed);
    const R softened = response.softening * overlap;
    const R force = law.at(softened).normal_force(softened, closing_speed);
    const R hold = select(law.least_force < R(0.0), softened, force);
    const auto gone = R(0.0) >= larger(hold, closing_speed); // nothing holds bodies that do not approach
    const auto end = motion.until_release(softened, fourth_root(softened), closing_speed, dt);
    const R impulse = response.relaxation(crowding) * reduced_mass * (closing_speed - end.closing_speed);
    BasicNormalImpulse<R> action;
    action.impulse = select(gone, 0.0, impulse);
    action.contact_time = select(gone, 0.0, dt);
    action.mean_overlap = larger(overlap, 0.5 * (overlap + end.overlap)); // at rest the others hold it where it is
    return action;
  }
  /// Along the normal, at an overlap that is not negative.
  [[gnu::always_inline]] BasicCrowdResponse<R> response_at(const R &overlap, const R &closing_speed) const {
    const R size = motion.size(overlap, fourth_root(overlap), closing_speed);
    const R root = size * size; // of the overlap where it comes to rest
    return crowd_response_by_series<R>({1.5 * root * law.normal_stiffness, root * law.normal_damping, reduced_mass},
                                       dt);
  }
  [[gnu::always_inline]] BasicCrowdResponse<R> slip_in_crowd(const BasicNormalImpulse<R> &action) const {
    return slip_after(dt, action.mean_overlap);
  }
  /// contact_time: [s]; mean_overlap: [m]
  [[gnu::always_inline]] BasicCrowdResponse<R> slip_after(const R &contact_time, const R &mean_overlap) const {
    using std::sqrt;
    const R root = sqrt(mean_overlap);
    const BasicOscillator<R> slip{root * law.tangential_stiffness, root * law.tangential_damping, tangential_mass};
    return crowd_response<R>(flow_by_series(slip, smaller(contact_time, time_of_largest_impulse_by_series(slip))), dt);
  }
  /// See LinearImpulse; both go with the area.
  [[gnu::always_inline]] R retardation(const BasicNormalImpulse<R> &) const {
    return select(R(0.0) < law.tangential_stiffness, law.tangential_damping / law.tangential_stiffness, R(0.0));
  }
};

/// See ViscoelasticImpulse.
template <class R> [[gnu::always_inline]] inline ViscoelasticCrowdStep<R>
viscoelastic_crowd_step(const HertzMindlinLaw<DampingExponent::half, R> &law, const R &reduced_mass,
                        const R &tangential_reduced_mass, const R &dt) {
  return {dt,
          reduced_mass,
          tangential_reduced_mass,
          law.friction,
          law,
          viscoelastic_motion(law.normal_stiffness, law.normal_damping, law.least_force, reduced_mass)};
}

/// The parameters of contacts with Hertz' law whose damping grows with the area of contact, see HertzImpulse. Their
/// exact motion is that of viscoelastic_motion.h.
class ViscoelasticImpulse {
public:
  using Law = HertzMindlinLaw<DampingExponent::half>;
  template <class R> using CrowdStep = ViscoelasticCrowdStep<R>;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  ViscoelasticImpulse(const Law &law, double reduced_mass, double tangential_reduced_mass, double dt)
      : crowd_(viscoelastic_crowd_step(law, reduced_mass, tangential_reduced_mass, dt)),
        undamped_duration_(hertz_contact_time_unit()) {}

  double dt() const { return crowd_.dt; }
  double reduced_mass() const { return crowd_.reduced_mass; }
  /// In a crowd over a whole step.
  const CrowdStep<double> *crowd_step() const { return &crowd_; }
  /// What acts at an overlap [m].
  LinearLaw law(double overlap) const { return crowd_.law.at(overlap); }

  NormalImpulse normal(double overlap, double closing_speed, double span) const {
    overlap = std::max(0.0, overlap);
    const double force = law(overlap).normal_force(overlap, closing_speed);
    if ((crowd_.law.tension() ? overlap : force) <= 0.0 && closing_speed <= 0.0) return {}; // the rare one first
    const double mass = reduced_mass();
    const BasicHertzFlight<double> end = crowd_.motion.fly(overlap, fourth_root(overlap), closing_speed, span);
    return {mass * (closing_speed - end.closing_speed),
            mass * (overlap + span * closing_speed - end.overlap),
            end.contact_time,
            force,
            end.mean_overlap,
            closing_speed,
            undamped_duration_ / end.phase_rate};
  }

  /// See LinearImpulse.
  double spring_energy(double overlap) const { return crowd_.law.spring_energy(overlap); }
  double softening(double overlap, double closing_speed) const {
    return crowd_.response_at(std::max(0.0, overlap), closing_speed).softening;
  }
  /// ks at an overlap [N/m], 0 without tangential spring.
  double spring_stiffness(double overlap) const { return law(overlap).tangential_stiffness; }

  /// See LinearImpulse.
  NormalImpulse normal_in_crowd(double overlap, double closing_speed, double span, double crowding) const {
    if (span == dt()) return crowd_.normal_in_crowd(overlap, closing_speed, crowding);
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
    for (int k = 0; k < parts; ++k) {
      const auto end = crowd_.motion.until_release(overlap, fourth_root(overlap), closing_speed, part);
      const LinearLaw end_law = law(end.overlap);
      const double mean_overlap = 0.5 * (overlap + end.overlap);
      const LinearLaw mean_law = law(mean_overlap);
      use(NormalPart{reduced_mass() * (closing_speed - end.closing_speed), mean_overlap,
                     end_law.limited(end_law.normal_force(end.overlap, end.closing_speed)), mean_law, end_law},
          exact_flow({mean_law.tangential_stiffness, mean_law.tangential_damping, tangential_mass()}, part));
      overlap = std::max(0.0, end.overlap);
      closing_speed = end.closing_speed;
    }
  }

  double tangential_mass() const { return crowd_.tangential_mass; }
  double friction() const { return crowd_.friction; }

private:
  CrowdStep<double> crowd_;
  double undamped_duration_; ///< in units of a contact's own, which damping changes by less than what depends on it
};

} // namespace cfpm
