// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/impulses/crowd_response.h"
#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"
#include "core/numbers/hermite_table.h"
#include "core/numbers/pack.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace cfpm {

/// A CrowdResponseTable as it is read. R: double, or a Pack of which each lane may have its own.
template <class R> struct BasicCrowdResponseTable {
  R longest; ///< the time of the largest impulse in units of the contact's own
  HermiteCells<R> cells;
  TableNumbers<R> numbers;

  /// Over a span, at most dt, and at most the time of the largest impulse [s]. rate: see CrowdResponseTable.
  [[gnu::always_inline]] BasicCrowdResponse<R> at(const R &rate, const R &span, const R &dt) const {
    const std::array<R, 2> found = cells.template interpolate<2>(numbers, smaller(rate * span, longest));
    return crowd_response<R>(rate * found[0], found[1], dt);
  }
};

/// The time of a contact in units of its own, over that in seconds [1/s]. R: double, or a Pack of several contacts'
/// numbers.
template <class R> [[gnu::always_inline]] inline R response_rate(const BasicOscillator<R> &o) {
  using std::sqrt;
  return select(R(0.0) < o.stiffness, sqrt(R(o.stiffness / o.mass)), o.damping / (2.0 * o.mass));
}

/// The CrowdResponse of all contacts with one damping ratio, from a table over the time in units of their own.
class CrowdResponseTable {
public:
  /// h/(2 sqrt(k m)), infinite without a spring.
  static double damping_ratio(const Oscillator &o) {
    return o.stiffness > 0.0 ? o.damping / (2.0 * std::sqrt(o.stiffness * o.mass))
                             : std::numeric_limits<double>::infinity();
  }
  static double rate(const Oscillator &o) { return response_rate(o); }

  explicit CrowdResponseTable(double damping_ratio) {
    const Oscillator unit =
        std::isinf(damping_ratio) ? Oscillator{0.0, 2.0, 1.0} : Oscillator{1.0, 2.0 * damping_ratio, 1.0};
    const double longest = time_of_largest_impulse(unit);
    const Table table(0.0, longest, cells, [&](double time) {
      const Propagator map = exact_flow(unit, time);
      return Table::Node{{map.rate_from_displacement, map.rate_from_rate},
                         {unit.acceleration(map.displacement_from_displacement, map.rate_from_displacement),
                          unit.acceleration(map.displacement_from_rate, map.rate_from_rate)}};
    });
    table_ = {longest, table.join(numbers_), {numbers_.data()}};
  }
  CrowdResponseTable(const CrowdResponseTable &) = delete; ///< what has been read points into it
  CrowdResponseTable &operator=(const CrowdResponseTable &) = delete;

  /// Valid as long as this is.
  const BasicCrowdResponseTable<double> &table() const { return table_; }
  CrowdResponse at(double rate, double span, double dt) const { return table_.at(rate, span, dt); }

private:
  using Table = HermiteTable<2>;
  static constexpr std::size_t cells = 32;

  BasicCrowdResponseTable<double> table_{};
  std::vector<double> numbers_;
};

} // namespace cfpm
