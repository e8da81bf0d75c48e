// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/contact/tangential_spring.h"
#include "core/method/elastic_contact.h"
#include "core/method/impulses/crowd.h"
#include "core/method/impulses/impulse_friction.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/method/method.h"
#include "core/numbers/vec3.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// What an ExactImpulse does with a pack of contacts in a crowd, each over a whole step, see compute_pack(). others:
/// that hold the bodies, see Crowd [1/kg].
struct PackedImpulse {
  template <Friction friction, class R, class Step, class Springs> [[gnu::always_inline]] static BasicPairForce<R>
  act(const Step &step, const BasicSpherePair<R> &pair, const R &others, const Springs &springs) {
    constexpr bool with_spring = has_spring(friction);
    // none is const: the compiler would keep aggregates that are in memory
    BasicContactGeometry<R> g = touching_spheres(pair);
    R felt = crowding<R>(others, step.reduced_mass);
    BasicNormalImpulse<R> normal = step.normal_in_crowd(g.overlap, g.closing_speed, felt);
    const auto touching = R(0.0) < normal.contact_time;
    const auto if_touching = [&](const BasicVec3<R> &a) -> BasicVec3<R> {
      return {select(touching, a.x, 0.0), select(touching, a.y, 0.0), select(touching, a.z, 0.0)};
    };
    BasicVec3<R> spring{};
    if constexpr (with_spring) spring = spring_at_start(springs.stored.load(), step.dt, g);
    CrowdedFriction<R> f{};
    if constexpr (friction != Friction::none) {
      R limit = step.friction * fabs(normal.impulse);
      f = friction_in_crowd<friction, R>(step.slip_in_crowd(normal), step.tangential_mass, felt, limit, spring,
                                         g.slip_velocity, step.dt - 0.5 * step.dt, step.retardation(normal));
      if constexpr (with_spring) springs.store(if_touching(f.next), if_touching(spring));
    }
    BasicMeanForce<R> mean = mean_force_in_crowd<friction, R>(step.dt, normal, g.normal, f.impulse);
    return {{if_touching(mean.force), if_touching(mean.torque_per_lever), {}},
            g.lever_i,
            g.lever_j,
            select(touching, R(1.0), R(0.0))};
  }
};

/// In a loop over contacts, see MeanOfTwoForces: the exact impulse of the isolated contact, also of one that begins or
/// ends inside the step, and in a crowd what CrowdResponse leaves of it.
template <class ParametersOf> class ExactImpulse {
public:
  using Law = typename std::decay_t<decltype(std::declval<const ParametersOf &>()(ContactPartners{}))>::Law;
  using Packed = PackedImpulse;
  static constexpr bool wants_onset = true;
  static constexpr bool wants_crowd = PredictedImpulse::method.wants_crowd;

  /// dt: of the step [s]
  ExactImpulse(const ParametersOf &parameters_of, double dt) : parameters_of_(parameters_of), dt_(dt) {}

  struct Normal {
    NormalImpulse action;
    double crowding; ///< see crowding(); 1: the contact is isolated
    double dt;
    double mean() const { return action.impulse / dt; }
    bool in_contact() const { return action.contact_time > 0.0; }
  };

  decltype(auto) parameters(const ContactPartners &partners) const { return parameters_of_(partners); }
  /// What makes those of contacts of any sizes, where it is known, see made_steps.h.
  template <class Of = ParametersOf> auto maker() const -> decltype(std::declval<const Of &>().maker()) {
    return parameters_of_.maker();
  }
  decltype(auto) made_parameters(const ContactPartners &partners) const { return parameters_of_.made(partners); }

  /// span: from the touch to the end of the step [s]; others: that hold its bodies, see Crowd [1/kg].
  /// While the normal turns at the rate w, the centres, r apart, accelerate away from each other along the line between
  /// them by r w^2: half of it is lost to the closing speed by the middle of the contact, whose speed is the one that
  /// counts along the normal of the middle. At the touch the same to first order, never less than nothing: grazing
  /// bodies touch as well.
  template <class Parameters>
  Normal normal(const Parameters &parameters, const ContactGeometry &g, double span, double others) const {
    if (others > 0.0) {
      const double felt = crowding(others, parameters.reduced_mass());
      return {parameters.normal_in_crowd(g.overlap, g.closing_speed, span, felt), felt, dt_};
    }
    const NormalImpulse straight = parameters.normal(g.overlap, g.closing_speed, span);
    const double outward = 0.5 * dot(g.normal_rate, g.normal_rate) * (g.lever_i + g.lever_j);
    if (outward == 0.0 || straight.contact_time == 0.0) return {straight, 1.0, dt_};
    const double lost = outward * straight.contact_time;
    const double speed =
        g.overlap > 0.0 ? g.closing_speed - lost : g.closing_speed * g.closing_speed / (g.closing_speed + lost);
    return {parameters.normal(g.overlap, speed, span), 1.0, dt_};
  }

  /// See MeanOfTwoForces. In a crowd the impulse is that of a softened overlap, the force here is not.
  template <class Parameters>
  double force_now(const Parameters &parameters, const Normal &, const ContactGeometry &g) const {
    return parameters.law(g.overlap).normal_force(g.overlap, g.closing_speed);
  }

  template <Friction friction, class Parameters>
  MeanForce mean_force(const Parameters &parameters, const Normal &normal, const ContactGeometry &g, double span,
                       const StoredSpring &spring, double cohesive) const {
    return mean_force_of_impulse<friction>(parameters, normal.action, g, span, normal.crowding, spring, cohesive);
  }

  /// Along what the normal force acts.
  Vec3 acts_along(const Normal &normal, const ContactGeometry &g) const {
    return normal.crowding == 1.0 ? normal_halfway(g, normal.action.contact_time) : g.normal;
  }
  /// In a crowd the springs are those that the response is softened to.
  template <class Parameters>
  ElasticContact elastic(const Parameters &parameters, const Normal &normal, const ContactGeometry &g) const {
    const double stiffness = parameters.spring_stiffness(g.overlap);
    if (normal.crowding == 1.0 || !normal.in_contact()) return {parameters.spring_energy(g.overlap), stiffness};
    const double softening = parameters.softening(g.overlap, g.closing_speed);
    return {parameters.spring_energy(softening * g.overlap) / softening,
            parameters.slip_in_crowd(normal.action).softening * stiffness};
  }
  /// Of a contact that has acted.
  Vec3 spring_now(const StoredSpring &stored, const ContactGeometry &) const { return vec3(stored.now); }

private:
  const ParametersOf &parameters_of_;
  double dt_; ///< [s]
};

} // namespace cfpm
