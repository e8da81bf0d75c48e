// SPDX-License-Identifier: GPL-2.0-or-later
// Rolling and twisting resistance of contacts whose forces are means over a step: behind the contact's force, of which
// limits count the mean along the normal, or what adhesion presses by in the middle of the step, so that it is the same
// for all laws and methods, and compiled once.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/inertia.h"
#include "core/contact/parameter_cache.h"
#include "core/contact/resisted_turn.h"
#include "core/contact/tangential_spring.h"
#include "core/contact/turn_resistance.h"
#include "core/contact/wider_history.h"
#include "core/numbers/instruction_set.h"
#include "core/numbers/pack.h"
#include "core/numbers/rows.h"
#include "core/numbers/two_packs.h"
#include "core/numbers/vec3.h"
#include "core/step/compute_chunk.h"
#include "core/step/contact_chunk.h"
#include "core/step/particles.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace cfpm {

/// Two bodies that touch and turn against each other. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicTurningPair {
  BasicVec3<R> normal;
  BasicVec3<R> spin;  ///< of the first against the second [1/s]
  PairSizes<R> sizes; ///< the reduced mass where the overlap counts only
  R reduced_radius;   ///< [m]
  R overlap;          ///< in the middle of the step, if it goes on as it does now [m]
  R per_inertia;      ///< 1/Ii + 1/Ij [1/(kg m^2)]
  R push;             ///< the mean normal force without its sign [N]
};

/// What contacts keep of it.
template <class R> struct BasicKeptTurn {
  BasicVec3<R> rolled;
  R twist;
};

/// Of the contacts of a pair style, by the types of their bodies, or of those with a wall, which are all alike.
class TurnResistances {
public:
  using Resistance = BasicTurnResistance<double>;

  /// rows: of by_types, one for each type, from 0 on, or a single one for all types alike.
  TurnResistances(int rows, std::vector<Resistance> by_types) : rows_(rows), by_types_(std::move(by_types)) {
    for (const Resistance &r : by_types_) {
      by_area_ = by_area_ || r.twisting_of_area > 0.0;
      presses_ = presses_ || r.adhesion.presses > 0.0;
      twists_ = twists_ || r.twisting_of_area > 0.0 || r.twisting_friction > 0.0;
      rolls_ = rolls_ || r.rolling_friction > 0.0;
    }
  }

  /// dimension: 2 for discs
  void set_dimension(int dimension) { inertia_factor_ = inertia_factor(dimension); }

  /// The couples of a chunk whose forces are computed; moves on what contacts keep.
  [[gnu::noinline]] void add_couples([[maybe_unused]] int lanes, const Particles &particles, ContactColumns &chunk,
                                     double dt) const {
#ifdef CFPM_WITH_AVX2
    if (lanes == 4) return add_with_avx2(particles, chunk, dt);
#endif
    add_in_packs<TwoPacks<Pack<2>>>(particles, chunk, dt);
  }

  /// The couple on i of one contact, to the last bit as of a chunk's; c: the contact, whose spring is kept in the
  /// middle between evaluations of steps dt, or of another one before; force: its mean one [N].
  [[gnu::noinline]] Vec3 couple(const Particles &particles, int i, int j, const Contact &c, const Vec3 &force,
                                double dt) const {
    const ContactBody body_i = particles.body(i);
    const ContactBody body_j = particles.body(j);
    const double per_inertia = per_inertia_of(inertia(body_i.mass, body_i.radius), inertia(body_j.mass, body_j.radius),
                                              body_i.frozen != 0, body_j.frozen != 0);
    return couple(partners(body_i, body_j), reduced_radius(body_i.radius, body_j.radius),
                  vec3(particles.omega[i]) - vec3(particles.omega[j]), per_inertia, c, force, dt);
  }
  /// The same with a wall.
  [[gnu::noinline]] Vec3 couple_at_wall(const Particles &particles, int i, const ContactPartners &p, const Contact &c,
                                        const Vec3 &force, double dt) const {
    const ContactBody body = particles.body(i);
    const double per_inertia = body.frozen ? 0.0 : 1.0 / inertia(body.mass, body.radius);
    const double radius = 1.0 / (1.0 / p.radius_i + 1.0 / p.radius_j); // that of a plane is infinite
    return couple(p, radius, vec3(particles.omega[i]), per_inertia, c, force, dt);
  }

private:
  struct Resistances {
    template <class R> using Step = BasicTurnResistance<R>;
  };

  int row_of(int type) const { return rows_ == 1 ? 0 : type; }
  int place_of(int type_i, int type_j) const { return row_of(type_i) * rows_ + row_of(type_j); }

  template <class R> [[gnu::always_inline]] R inertia(const R &mass, const R &radius) const {
    return inertia_factor_ * mass * (radius * radius);
  }
  /// 1/Ii + 1/Ij, of a frozen body 0, by one quotient.
  template <class R, class Condition> [[gnu::always_inline]] static R
  per_inertia_of(const R &i, const R &j, const Condition &frozen_i, const Condition &frozen_j) {
    return (select(frozen_j, R(0.0), i) + select(frozen_i, R(0.0), j)) / (i * j);
  }
  template <class R> [[gnu::always_inline]] static R reduced_radius(const R &radius_i, const R &radius_j) {
    return radius_i * radius_j / (radius_i + radius_j);
  }

  template <class R> struct Holds { BasicTurnHold<R> rolling, twisting; };
  template <class R>
  [[gnu::always_inline]] Holds<R> holds(const BasicTurnResistance<R> &resistance, const BasicTurningPair<R> &p) const {
    R push = p.push;
    if (presses_) push = resistance.pushed(p.sizes, p.overlap, push);
    Holds<R> holds{resistance.rolling(p.reduced_radius, push), resistance.twisting(push)};
    if (by_area_) {
      const auto by_area = R(0.0) < resistance.twisting_of_area;
      const BasicTurnHold<R> area = resistance.twisting_by_area(p.sizes, p.reduced_radius, p.overlap, push);
      holds.twisting = {select(by_area, area.stiffness, holds.twisting.stiffness),
                        select(by_area, area.damping, holds.twisting.damping),
                        select(by_area, area.limit, holds.twisting.limit)};
    }
    return holds;
  }

  template <class R> struct Rates {
    R twisting;
    BasicVec3<R> rolling;
    [[gnu::always_inline]] explicit Rates(const BasicTurningPair<R> &p)
        : twisting(dot(p.spin, p.normal)), rolling(p.spin - twisting * p.normal) {}
  };

  template <class R> [[gnu::always_inline]] BasicVec3<R> couple_of(const Holds<R> &holds, const BasicTurnStep<R> &step,
                                                                   const BasicTurningPair<R> &p,
                                                                   const BasicKeptTurn<R> &turn,
                                                                   const Rates<R> &rates) const {
    BasicVec3<R> couple{};
    if (rolls_) couple = mean_couple(holds.rolling, step, turn.rolled, rates.rolling);
    if (twists_) couple = couple + mean_couple(holds.twisting, step, turn.twist, rates.twisting) * p.normal;
    return couple;
  }

  /// Moves what is kept on; returns what it is now. dt: of the step that it leads by half [s]
  template <class R>
  [[gnu::always_inline]] BasicKeptTurn<R> turn_on(const Holds<R> &hold, const R &dt, const BasicTurningPair<R> &p,
                                                  const Rates<R> &rates, BasicKeptTurn<R> &kept) const {
    BasicKeptTurn<R> now{};
    if (rolls_) now.rolled = move_on_turn(hold.rolling, dt, p.normal, kept.rolled, rates.rolling);
    if (twists_) now.twist = move_on_turn(hold.twisting, dt, p.normal, kept.twist, rates.twisting);
    return now;
  }

  /// Of contacts that act over the whole step, as long as the one before.
  template <class R> [[gnu::always_inline]] BasicVec3<R> move_on(const BasicTurnResistance<R> &resistance,
                                                                 const BasicTurningPair<R> &p, const R &dt,
                                                                 BasicKeptTurn<R> &kept) const {
    const Holds<R> hold = holds(resistance, p);
    const Rates<R> rates(p);
    const BasicKeptTurn<R> now = turn_on(hold, dt, p, rates, kept);
    return couple_of(hold, BasicTurnStep<R>{dt, 1.0, p.per_inertia}, p, now, rates);
  }

  Vec3 couple(const ContactPartners &sizes, double radius, const Vec3 &spin, double per_inertia, const Contact &c,
              const Vec3 &force, double dt) const {
    const ContactGeometry &g = c.geometry;
    const BasicTurningPair<double> p{g.normal,
                                     spin,
                                     sizes_of(sizes),
                                     radius,
                                     g.overlap + 0.5 * dt * g.closing_speed,
                                     per_inertia,
                                     std::fabs(dot(force, g.normal))};
    const Resistance &resistance = by_types_[static_cast<std::size_t>(place_of(sizes.type_i, sizes.type_j))];
    double *const values = c.spring.values;
    BasicKeptTurn<double> kept{vec3(values + WiderHistory::rolled), values[WiderHistory::twist]};
    Vec3 on_i;
    if (c.spring.advance && c.spring.dt == dt && c.span == dt)
      on_i = move_on(resistance, p, dt, kept);
    else
      on_i = couple_now(resistance, p, c, dt, kept);
    set(kept.rolled, values + WiderHistory::rolled);
    values[WiderHistory::twist] = kept.twist;
    return on_i;
  }

  /// Where a contact begins inside the step, the step has another length, or a state is evaluated again.
  Vec3 couple_now(const Resistance &resistance, const BasicTurningPair<double> &p, const Contact &c, double dt,
                  BasicKeptTurn<double> &kept) const {
    const Holds<double> hold = holds(resistance, p);
    const Rates<double> rates(p);
    const double before = c.spring.dt;
    BasicKeptTurn<double> now{};
    if (c.span == dt && c.spring.advance) {
      now = turn_on(hold, before, p, rates, kept);
    } else if (c.span == dt) {
      if (!(kept.rolled == Vec3{})) now.rolled = kept.rolled - 0.5 * before * rates.rolling;
      if (kept.twist != 0.0) now.twist = kept.twist - 0.5 * before * rates.twisting;
    }
    if (c.spring.advance ? c.span != dt || before != dt : before != dt)
      kept = {now.rolled + (c.span - 0.5 * dt) * rates.rolling, now.twist + (c.span - 0.5 * dt) * rates.twisting};
    return couple_of<double>(hold, {c.span, c.span / dt, p.per_inertia}, p, now, rates);
  }

#ifdef CFPM_WITH_AVX2
  CFPM_WITH_AVX2 [[gnu::noinline]] void add_with_avx2(const Particles &particles, ContactColumns &chunk,
                                                      double dt) const {
    add_in_packs<TwoPacks<Pack<4>>>(particles, chunk, dt);
  }
#endif

  template <class P>
  [[gnu::always_inline]] void add_in_packs(const Particles &original, ContactColumns &chunk, double dt) const {
    const Particles particles = original; // a copy: what is stored could else be its members
    const int count = chunk.count;
    int places[ContactColumns::size] = {};
    if (rows_ > 1)
      for (int k = 0; k < count + ContactColumns::most_lanes - 1; ++k)
        places[k] = place_of(particles.type[chunk.i[k]], particles.type[chunk.j[k]]);
    const Resistance *const resistances = by_types_.data();
    auto resistance = gather_step<Resistances, P>(resistances, places);
    for (int k = 0; k < count; k += P::width) {
      if (rows_ > 1) resistance = gather_step<Resistances, P>(resistances, places + k);
      const BasicTurningPair<P> pair = turning_pair<P>(particles, chunk, k, dt);
      const StoredSprings<P> rolled{chunk.spring + k, WiderHistory::rolled};
      double *const *const values = chunk.spring + k;
      BasicKeptTurn<P> kept{rolled.load(),
                            Lanes<P>::fill([&](int lane) CFPM_INLINED { return values[lane][WiderHistory::twist]; })};
      const BasicVec3<P> couple = move_on<P>(resistance, pair, dt, kept);
      store(couple, chunk.couple, k);
      rolled.store(kept.rolled);
      double twists[P::width];
      kept.twist.store(twists);
      for (int lane = 0; lane < P::width; ++lane) values[lane][WiderHistory::twist] = twists[lane];
    }
  }

  template <class P> [[gnu::always_inline]] BasicTurningPair<P>
  turning_pair(const Particles &particles, const ContactColumns &chunk, int k, double dt) const {
    const int *const i = chunk.i + k;
    const int *const j = chunk.j + k;
    const P radius_i = P::load(chunk.radius_i + k);
    const P radius_j = P::load(chunk.radius_j + k);
    const P mass_i = gather<P>(particles.mass, i);
    const P mass_j = gather<P>(particles.mass, j);
    const auto frozen = [&](const int *body) CFPM_INLINED {
      return P(0.0) < Lanes<P>::fill([&](int lane) CFPM_INLINED {
               return particles.group[body[lane]] & particles.frozen ? 1.0 : 0.0;
             });
    };
    auto frozen_i = P(1.0) < P(0.0);
    auto frozen_j = frozen_i;
    if (particles.frozen) {
      frozen_i = frozen(i);
      frozen_j = frozen(j);
    }
    const P distance = sqrt(P::load(chunk.squared + k));
    const BasicVec3<P> normal = (1.0 / distance) * load<P>(chunk.separation, k);
    P overlap = 0.0;
    P reduced_mass = 0.0;
    if (by_area_ || presses_) {
      const P leaving = dot(gather<P>(particles.v, i) - gather<P>(particles.v, j), normal);
      overlap = radius_i + radius_j - distance + 0.5 * dt * -leaving;
      reduced_mass = select(frozen_j, mass_i, select(frozen_i, mass_j, mass_i * mass_j / (mass_i + mass_j)));
    }
    return {normal,
            gather<P>(particles.omega, i) - gather<P>(particles.omega, j),
            {radius_i, radius_j, reduced_mass},
            reduced_radius(radius_i, radius_j),
            overlap,
            per_inertia_of(inertia(mass_i, radius_i), inertia(mass_j, radius_j), frozen_i, frozen_j),
            fabs(dot(load<P>(chunk.force, k), normal))};
  }

  int rows_;
  std::vector<Resistance> by_types_;
  bool rolls_ = false;
  bool twists_ = false;
  bool by_area_ = false; ///< some twist so
  bool presses_ = false; ///< some adhere
  double inertia_factor_ = inertia_factor(3);
};

} // namespace cfpm
