// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/motion/oscillator.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// What friction does to the first body over a step.
struct FrictionImpulse {
  Vec3 impulse;     ///< [N s]
  Vec3 levered;     ///< the same, every part of it times its lever over the one at the beginning [N s]
  Vec3 time_moment; ///< the integral of the force times the time that is left [N s^2]
  Vec3 next;        ///< that the spring is carried on as, see spring_at_start() [m]
};

/// The same over a part of an isolated contact.
struct FrictionPart {
  Vec3 impulse;  ///< [N s]
  Vec3 end_slip; ///< [m/s]
  Vec3 moved;    ///< [m]
};

/// Between an instant and another, from how far a number is below 0 and where it is then, above, on a straight line:
/// the share of the time until it is 0.
inline double share_below(double at_start, double at_end) {
  return at_start < 0.0 ? at_start / (at_start - at_end) : 0.0;
}

/// Friction of an isolated contact, in equal parts of it that stick or slide, with the overlap and the tangential
/// stiffness that each has. Where Coulomb's limit holds the spring alone, which takes the dashpot with it, a part is
/// divided where the spring comes to it, by the straight line between its ends: the force has a jump there.
template <Friction friction, class Parameters> class FrictionAlone {
public:
  /// start: the spring at the beginning [m]; cohesive: see mean_force_of_impulse() [N]
  FrictionAlone(const Parameters &parameters, const NormalImpulse &normal, const ContactGeometry &g, const Vec3 &start,
                double cohesive)
      : parameters_(parameters), normal_(normal), g_(g), cohesive_(cohesive), law_(parameters.law(g.overlap)),
        limit_(limit_of(normal.force)), slip_(g.slip_velocity),
        spring_(slackened<friction>(start, law_, slip_, limit_)) {}

  /// Over the last span of a step [s].
  [[gnu::always_inline]] FrictionImpulse over(double span) {
    const auto add = [this](const NormalPart &p, const Propagator &stick) CFPM_INLINED { add_part(p, stick); };
    parameters_.in_parts(g_.overlap, normal_.closing_speed, normal_.contact_time, parts_, add);
    all_.time_moment = mass_ * (way_ + (span - normal_.contact_time) * slip_ - span * g_.slip_velocity);
    if (normal_.contact_time == span) all_.next = spring_ - 0.5 * parameters_.dt() * slip_;
    return all_;
  }

private:
  /// stick: how the bodies stick.
  [[gnu::always_inline]] void add_part(const NormalPart &p, const Propagator &stick) {
    const Vec3 end_slip = stick.rate_from_displacement * spring_ + stick.rate_from_rate * slip_;
    const Vec3 moved = stick.displacement_from_displacement * spring_ + stick.displacement_from_rate * slip_ - spring_;
    const double limit_impulse = parameters_.friction() * std::fabs(p.impulse + cohesive_ * part_);
    const double end_limit = limit_of(p.end_force);
    FrictionPart f{mass_ * (end_slip - slip_), end_slip, moved};
    const bool has_dashpot = law_.tangential_damping > 0.0 || p.end_law.tangential_damping > 0.0;
    if (friction == Friction::spring_and_dashpot && has_dashpot)
      f = limited_by_spring(f, p, limit_impulse, end_limit);
    else
      f = limited_by_impulse(f, f.impulse, limit_impulse);
    all_.impulse = all_.impulse + f.impulse;
    all_.levered = all_.levered + (1.0 - (p.overlap - g_.overlap) / levers_) * f.impulse;
    way_ = way_ + f.moved;
    slip_ = f.end_slip;
    law_ = p.end_law;
    limit_ = end_limit;
    spring_ = slackened<friction>(spring_ + f.moved, law_, slip_, limit_);
  }

  /// held: the impulse that the limit holds [N s]
  FrictionPart limited_by_impulse(const FrictionPart &f, const Vec3 &held, double limit_impulse) const {
    const double factor = coulomb_factor(limit_impulse / norm(held));
    return factor < 1.0 ? slides(0.0, {}, factor * held) : f;
  }

  FrictionPart limited_by_spring(const FrictionPart &f, const NormalPart &p, double limit_impulse,
                                 double end_limit) const {
    const Vec3 pull = law_.tangential_stiffness * spring_;
    const Vec3 end_pull = p.end_law.tangential_stiffness * (spring_ + f.moved);
    const double end_beyond = norm(end_pull) - end_limit;
    if (!(end_beyond > 0.0)) // by its impulse it may be, where the limit vanishes at the end
      return limited_by_impulse(f, f.impulse + p.law.tangential_damping * f.moved, limit_impulse);
    const double sticks = share_below(norm(pull) - limit_, end_beyond);
    // of a force that goes on a straight line too, with the impulse of f over the whole part
    const Vec3 force = sticking_friction(law_.tangential_stiffness, law_.tangential_damping, spring_, slip_);
    const Vec3 before = sticks * sticks * f.impulse + sticks * (1.0 - sticks) * part_ * force;
    if (limit_ + end_limit == 0.0) return slides(sticks, before, {});
    const double then = limit_ + sticks * (end_limit - limit_);
    const double of_limit = (1.0 - sticks) * (then + end_limit) / (limit_ + end_limit);
    const Vec3 halfway = 0.5 * ((1.0 - sticks) * pull + (1.0 + sticks) * end_pull); // through what slides
    return slides(sticks, before, (-of_limit * limit_impulse / norm(halfway)) * halfway);
  }

  /// After a share of the part, with an impulse, another one until its end [N s].
  FrictionPart slides(double share, const Vec3 &before, const Vec3 &impulse) const {
    const Vec3 then = slip_ + (1.0 / mass_) * before;
    const Vec3 end = then + (1.0 / mass_) * impulse;
    return {before + impulse, end, 0.5 * part_ * (share * (slip_ + then) + (1.0 - share) * (then + end))};
  }

  double limit_of(double force) const { return parameters_.friction() * std::fabs(force + cohesive_); }

  const Parameters &parameters_;
  const NormalImpulse &normal_;
  const ContactGeometry &g_;
  const double cohesive_;
  const int parts_ = parts_of_contact(normal_.contact_time, normal_.duration);
  const double part_ = normal_.contact_time / parts_; ///< [s]
  const double mass_ = parameters_.tangential_mass();
  const double levers_ = g_.lever_j > 0.0 ? g_.lever_i + g_.lever_j : 2.0 * g_.lever_i; ///< sum [m]

  // where the contact is
  LinearLaw law_;
  double limit_; ///< of Coulomb [N]
  Vec3 slip_;    ///< [m/s]
  Vec3 spring_;  ///< [m]
  Vec3 way_{};   ///< that it has slipped [m]
  FrictionImpulse all_{};
};

} // namespace cfpm
