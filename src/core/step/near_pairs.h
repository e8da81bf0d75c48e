// SPDX-License-Identifier: GPL-2.0-or-later
// Which of the pairs that a host lists may touch in the steps to come. A host lists pairs that come within its skin,
// for the many steps until it lists them anew; in a bed nearly half of them are apart, and a look at each is a third of
// a step's price.
#pragma once

#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cfpm {

/// The near ones of a PairList, one behind the other in its order, in groups that are looked at together.
///
/// They are those that were apart by less than a margin when they were chosen. It is asked of places and radii whether
/// they are still all, so that whoever moves particles, or changes what they are, need not tell: two spheres have come
/// together by at most 2 (sqrt(3) c + g), where no coordinate has changed by more than c and no radius by more than g.
class NearPairs {
public:
  static constexpr int group = 4;

  /// To be called where the host has listed its pairs anew, or contacts have been evaluated by others: then flags in
  /// the history may differ from what is known here.
  void forget() { chosen_ = false; }

  /// Chooses them anew, if it must be. Law: says where spheres touch; ahead: as in StepState [m].
  template <class P, class Law>
  [[gnu::always_inline]] void follow(const Particles &particles, const PairList &pairs, double ahead) {
    if (chosen_ && particles.count == particles_ && pairs.count == lists_) {
      ++age_;
      const double come_together = 2.0 * (std::sqrt(3.0) * (farthest<P>(particles.x[0], places_) + rounding_) +
                                          farthest<P>(particles.radius, radii_) + rounding_);
      speed_ = come_together / age_;
      if (come_together + ahead < margin_) return;
    }
    choose<Law>(particles, pairs, ahead);
  }

  int count() const { return count_; }
  const int *i() const { return i_.data(); } ///< filled up to whole groups
  const int *j() const { return j_.data(); }
  /// Where a pair stands among the neighbors of its i.
  const int *slot() const { return slot_.data(); }
  int age() const { return age_; } ///< evaluations since they were chosen
  /// Which pairs of the group that begins with pair k touched when they were looked at last, a bit for each.
  unsigned touching(int k) const { return touching_[static_cast<std::size_t>(k) / group]; }

  /// Notes which of them touch now, here and in the history.
  [[gnu::noinline]] void note(int k, unsigned touching, const PairList &pairs) {
    touching_[static_cast<std::size_t>(k) / group] = static_cast<unsigned char>(touching);
    if (!pairs.flags) return;
    const int *const i = i_.data() + k;
    const int *const slot = slot_.data() + k;
    for (int lane = 0; lane < std::min(group, count_ - k); ++lane)
      pairs.mark((touching >> lane & 1U) != 0, pairs.flags[i[lane]][slot[lane]], i[lane], slot[lane]);
  }

private:
  static constexpr double least_margin = 0.001; ///< in radii
  static constexpr int evaluations = 24;        ///< that a choice is to last

  /// The largest change of any number.
  template <class P>
  [[gnu::always_inline]] static double farthest(const double *now, const std::vector<float> &before) {
    const int count = static_cast<int>(before.size());
    const float *const then = before.data();
    P changes = 0.0;
    int k = 0;
    for (; k + P::width <= count; k += P::width)
      changes = larger(changes, fabs(P::load(now + k) -
                                     Lanes<P>::fill([&](int lane) CFPM_INLINED { return double{then[k + lane]}; })));
    double change = largest(changes);
    for (; k < count; ++k) change = larger(change, std::fabs(now[k] - double{then[k]}));
    return change;
  }

  template <class Law> [[gnu::noinline]] void choose(const Particles &particles, const PairList &pairs, double ahead) {
    remember(particles);
    const double lasting = least_margin * (particles.count ? particles.radius[0] : 0.0) + 4.0 * rounding_;
    margin_ = 2.0 * ahead + std::max(lasting, evaluations * speed_);
    const double margin = margin_;
    count_ = 0;
    for (int ii = 0; ii < pairs.count; ++ii) {
      const int i = pairs.first[ii];
      const int neighbor_count = pairs.neighbor_count[i];
      make_room(neighbor_count);
      int *const near_i = i_.data();
      for (int jj = 0; jj < neighbor_count; ++jj) {
        const int j = pairs.neighbors[i][jj] & pairs.index_mask;
        const Vec3 separation = vec3(particles.x[i]) - vec3(particles.x[j]);
        const double squared = dot(separation, separation);
        const double reach = Law::touch_distance(particles.radius[i], particles.radius[j]);
        const bool touch = squared < reach * reach;
        if (pairs.flags) pairs.mark(touch, pairs.flags[i][jj], i, jj);
        const auto k = static_cast<std::size_t>(count_);
        near_i[k] = i;
        j_[k] = j;
        slot_[k] = jj;
        unsigned char &bits = touching_[k / group];
        const int bit = count_ % group;
        if (bit == 0) bits = 0;
        bits = static_cast<unsigned char>(bits | (touch << bit));
        count_ += squared < (reach + margin) * (reach + margin);
      }
    }
    make_room(0);
    for (int k = count_; k % group != 0; ++k) i_[static_cast<std::size_t>(k)] = j_[static_cast<std::size_t>(k)] = 0;
    chosen_ = true;
    age_ = 0;
    lists_ = pairs.count;
  }

  /// Places and radii, rounded to save memory.
  void remember(const Particles &particles) {
    particles_ = particles.count;
    const auto count = static_cast<std::size_t>(particles_);
    const auto round = [this](const double *numbers, std::size_t size, std::vector<float> &rounded) {
      rounded.resize(size);
      for (std::size_t k = 0; k < size; ++k) {
        rounded[k] = static_cast<float>(numbers[k]);
        rounding_ = std::max(rounding_, 0.5 * FLT_EPSILON * std::fabs(numbers[k]));
      }
    };
    rounding_ = 0.0;
    round(particles.x[0], 3 * count, places_);
    round(particles.radius, count, radii_);
  }

  /// For as many more pairs, and to fill the last group up.
  void make_room(int more) {
    const auto size = static_cast<std::size_t>(count_) + static_cast<std::size_t>(more + group);
    if (size <= i_.size()) return;
    const std::size_t larger = size + size / 8;
    i_.resize(larger);
    j_.resize(larger);
    slot_.resize(larger);
    touching_.resize(larger / group + 1);
  }

  bool chosen_ = false;
  int particles_ = 0;
  int lists_ = 0;
  int age_ = 0;
  double margin_ = 0.0;   ///< [m]
  double speed_ = 0.0;    ///< at which two particles have come together at most since then [m per evaluation]
  double rounding_ = 0.0; ///< of what is remembered, at most [m]
  std::vector<float> places_, radii_;
  int count_ = 0;
  std::vector<int> i_, j_;
  std::vector<int> slot_;
  std::vector<unsigned char> touching_;
};

} // namespace cfpm
