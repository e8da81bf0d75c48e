// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"
#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/method/impulses/released_impulse.h"
#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"
#include "core/motion/release.h"
#include "core/numbers/pack.h"
#include "core/numbers/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// The numbers that contacts in a crowd are computed from over a whole step: of LinearImpulse that part which a loop
/// over a bed asks for hardly anything else than. R: double, or a Pack of several contacts' numbers.
template <class R> struct LinearCrowdStep {
  R dt;              ///< [s]
  R reduced_mass;    ///< m* [kg]
  R tangential_mass; ///< mt [kg]
  R friction;
  BasicCrowdResponse<R> response; ///< along the normal
  BasicPropagator<R> step;        ///< likewise
  BasicHold<R> hold;
  R ends_below; ///< of the hold at the end: 0, infinite where a collision ends within a step
  BasicReleasedImpulse<R> released;
  BasicCrowdResponse<R> slip;
  R retardation_time; ///< see retardation() [s]

  /// See LinearImpulse.
  [[gnu::always_inline]] BasicNormalImpulse<R> normal_in_crowd(const R &whole_overlap, const R &closing_speed,
                                                               const R &crowding) const {
    const R overlap = whole_overlap * response.softening;
    const RelativeState<R> start{overlap, closing_speed};
    const RelativeState<R> end = step(start);
    // both, as in a bed a branch would be mispredicted
    const R until_release = released(overlap, closing_speed);
    const R over_step = reduced_mass * (closing_speed - end.rate);
    const auto ends = hold(end) < ends_below;
    const auto gone = R(0.0) >= larger(hold(start), closing_speed); // nothing holds bodies that do not approach
    BasicNormalImpulse<R> action;
    action.impulse = select(gone, 0.0, response.relaxation(crowding) * select(ends, until_release, over_step));
    action.contact_time = select(gone, 0.0, dt);
    return action;
  }
  [[gnu::always_inline]] const BasicCrowdResponse<R> &slip_in_crowd(const BasicNormalImpulse<R> &) const {
    return slip;
  }
  [[gnu::always_inline]] const R &retardation(const BasicNormalImpulse<R> &) const { return retardation_time; }
};

/// See linear_crowd_step().
template <class R> struct MadeLinearCrowdStep {
  LinearCrowdStep<R> step;
  decltype(R() >= R()) fits; ///< whether its numbers say all, see LinearImpulse::crowd_step()
};

/// That of contacts of any masses, by series: over numbers R, doubles or packs. reduced_mass, tangential_reduced_mass:
/// see LinearImpulse [kg]; dt: [s].
///
/// With the frequency without damping w and the damping ratio zeta = cos(a) < 1 what holds the contact has the
/// frequency w sin(a), so that times are a/sin(a) or pi/sin(a) over w: without tension a contact that starts at rest
/// lasts a over that frequency and a collision 2 a, with tension pi - a and pi.
template <class R> [[gnu::always_inline]] inline MadeLinearCrowdStep<R>
linear_crowd_step(const BasicLinearLaw<R> &law, const R &reduced_mass, const R &tangential_reduced_mass, const R &dt) {
  using std::sqrt;
  const BasicOscillator<R> normal{law.normal_stiffness, law.normal_damping, reduced_mass};
  const BasicOscillator<R> tangential{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass};
  const R omega_squared = normal.stiffness / normal.mass;
  const R rate = sqrt(omega_squared);
  const R damping_ratio = normal.damping / (2.0 * normal.mass * rate);
  const auto tension = law.least_force < R(0.0);
  const auto fits = released_impulse_fits(damping_ratio, tension);
  const R zeta = select(fits, damping_ratio, R(0.0)); // any other one may be beyond what the series are for
  const R at_angle = angle_over_sine(zeta);
  const R collision = select(tension, pi / sqrt(R(1.0 - zeta * zeta)), 2.0 * at_angle);
  const R from_rest = collision - at_angle;
  const ReleasedPolynomials<R> released{zeta, exponential<R>(-zeta * from_rest), exponential<R>(-zeta * collision)};
  return {{dt,
           reduced_mass,
           tangential_reduced_mass,
           law.friction,
           crowd_response_by_series(normal, dt),
           flow_by_series(normal, dt),
           {select(tension, R(1.0), omega_squared), select(tension, R(0.0), normal.damping / normal.mass)},
           select(dt * rate >= collision, R(std::numeric_limits<double>::infinity()), R(0.0)),
           {reduced_mass, rate, released.retreat(tension), released.approach()},
           crowd_response_by_series(tangential, dt),
           cfpm::retardation(law)},
          fits};
}

/// The parameters of contacts with the linear law, whose exact motion over a step is a linear map wherever it is not
/// released inside the step; everything that depends only on materials, masses and the step is computed once and kept.
class LinearImpulse {
public:
  using Law = LinearLaw;
  template <class R> using CrowdStep = LinearCrowdStep<R>;

  /// tangential_reduced_mass mt: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij [kg]
  LinearImpulse(const LinearLaw &law, double reduced_mass, double tangential_reduced_mass, double dt)
      : law_(law), normal_{law.normal_stiffness, law.normal_damping, reduced_mass},
        tangential_{law.tangential_stiffness, law.tangential_damping, tangential_reduced_mass}, dt_(dt),
        release_(normal_, law.tension()), slip_time_(std::min(dt, time_of_largest_impulse(tangential_))),
        part_(dt / parts_of_contact(dt, release_.duration())), normal_part_(exact_flow(normal_, part_)),
        tangential_part_(exact_flow(tangential_, part_)) {
    const ReleasedImpulse released(normal_, release_, law.tension());
    released_fits_ = released.fits();
    crowd_ = {dt,
              reduced_mass,
              tangential_reduced_mass,
              law.friction,
              crowd_response(exact_flow(normal_, std::min(dt, time_of_largest_impulse(normal_))), dt),
              exact_flow(normal_, dt),
              release_.hold(),
              release_.duration() <= dt ? std::numeric_limits<double>::infinity() : 0.0,
              released.numbers(),
              crowd_response(exact_flow(tangential_, slip_time_), dt),
              cfpm::retardation(law)};
  }

  /// The same that in a crowd is as linear_crowd_step() has made it.
  LinearImpulse(const LinearImpulse &other, const MadeLinearCrowdStep<double> &made) : LinearImpulse(other) {
    if (made.fits) crowd_ = made.step;
  }

  double dt() const { return dt_; }
  /// In a crowd over a whole step, null where its numbers do not say all; see ReleasedImpulse.
  const CrowdStep<double> *crowd_step() const { return released_fits_ ? &crowd_ : nullptr; }
  double reduced_mass() const { return normal_.mass; }
  /// What acts at an overlap [m].
  const LinearLaw &law(double) const { return law_; }

  /// overlap, which is not negative [m], closing speed [m/s]; span: how long the bodies are followed, at most dt [s]
  NormalImpulse normal(double overlap, double closing_speed, double span) const {
    const OscillatorState start{overlap, closing_speed};
    if (released(start)) return {};
    Flight flight{crowd_.step(start), dt_};
    // what changes its sign once, in less than the time of a collision, is negative at the end if released
    if (span != dt_ || release_.duration() <= dt_ || release_.hold()(flight.end) < 0.0)
      flight = release_.fly(start, span);
    return {normal_.mass * (closing_speed - flight.end.rate),
            normal_.mass * (overlap + span * closing_speed - flight.end.displacement),
            flight.contact_time,
            normal_.force(overlap, closing_speed),
            0.0,
            closing_speed,
            release_.duration()};
  }

  /// The same in a crowd, impulse and contact time alone. There the others hold the bodies together all the time,
  /// though alone they would have been released. Inlined by order: the loop over a bed asks for hardly anything else.
  [[gnu::always_inline]] NormalImpulse normal_in_crowd(double overlap, double closing_speed, double span,
                                                       double crowding) const {
    if (span == dt_ && released_fits_) return crowd_.normal_in_crowd(overlap, closing_speed, crowding);
    NormalImpulse action = normal(overlap * crowd_.response.softening, closing_speed, span);
    action.impulse *= crowd_.response.relaxation(crowding);
    if (span == dt_ && action.contact_time > 0.0) action.contact_time = dt_;
    return action;
  }

  /// That the normal spring holds at an overlap [J].
  double spring_energy(double overlap) const { return law_.spring_energy(overlap); }
  /// Of the normal spring in a crowd, see CrowdResponse.
  double softening(double, double) const { return crowd_.response.softening; }
  /// ks at an overlap [N/m], 0 without tangential spring.
  double spring_stiffness(double) const { return law_.tangential_stiffness; }

  /// Of bodies that stick while they are in contact, in a crowd: spring [m], slip velocity [m/s].
  CrowdResponse slip_in_crowd(const NormalImpulse &normal) const {
    return normal.contact_time >= slip_time_ ? crowd_.slip
                                             : crowd_response(exact_flow(tangential_, normal.contact_time), dt_);
  }

  /// Of the tangential spring, see there [s].
  double retardation(const NormalImpulse &normal) const { return crowd_.retardation(normal); }

  /// A contact in parts of equal duration: calls use(NormalPart, Propagator of slip that sticks) for each.
  template <class Use> [[gnu::always_inline]] void in_parts(double overlap, double closing_speed, double contact_time,
                                                            int parts, const Use &use) const {
    const double part = contact_time / parts;
    const bool kept = part == part_;
    const Propagator step = kept ? normal_part_ : exact_flow(normal_, part);
    const Propagator stick = kept ? tangential_part_ : exact_flow(tangential_, part);
    OscillatorState state{overlap, closing_speed};
    for (int k = 0; k < parts; ++k) {
      const OscillatorState end = step(state);
      use(NormalPart{normal_.mass * (state.rate - end.rate), 0.5 * (state.displacement + end.displacement),
                     law_.limited(normal_.force(end.displacement, end.rate)), law_, law_},
          stick);
      state = end;
    }
  }

  double tangential_mass() const { return tangential_.mass; }
  double friction() const { return law_.friction; }

private:
  /// Of bodies that do not approach. What is rare is asked first, as a branch on the speed would be mispredicted.
  bool released(const OscillatorState &s) const { return release_.hold()(s) <= 0.0 && s.rate <= 0.0; }

  LinearLaw law_;
  Oscillator normal_;
  Oscillator tangential_;
  double dt_;
  LinearRelease release_;
  LinearCrowdStep<double> crowd_{};
  bool released_fits_ = false;
  double slip_time_; ///< that bodies of a crowd are followed in the tangent plane [s]
  double part_;      ///< of a step in contact [s]
  Propagator normal_part_;
  Propagator tangential_part_;
};

} // namespace cfpm
