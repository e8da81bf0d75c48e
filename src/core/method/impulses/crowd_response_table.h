// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/impulses/crowd_response.h"
#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"
#include "core/numbers/hermite_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// The CrowdResponse of all contacts with one damping ratio, from a table over the time in units of their own.
class CrowdResponseTable {
public:
  /// h/(2 sqrt(k m)), infinite without a spring.
  static double damping_ratio(const Oscillator &o) {
    return o.stiffness > 0.0 ? o.damping / (2.0 * std::sqrt(o.stiffness * o.mass))
                             : std::numeric_limits<double>::infinity();
  }
  /// The time of a contact in units of its own, over that in seconds [1/s].
  static double rate(const Oscillator &o) {
    return o.stiffness > 0.0 ? std::sqrt(o.stiffness / o.mass) : o.damping / (2.0 * o.mass);
  }

  explicit CrowdResponseTable(double damping_ratio) {
    const Oscillator unit =
        std::isinf(damping_ratio) ? Oscillator{0.0, 2.0, 1.0} : Oscillator{1.0, 2.0 * damping_ratio, 1.0};
    longest_ = time_of_largest_impulse(unit);
    table_ = Table(0.0, longest_, cells, [&](double time) {
      const Propagator map = exact_flow(unit, time);
      return Table::Node{{map.rate_from_displacement, map.rate_from_rate},
                         {unit.acceleration(map.displacement_from_displacement, map.rate_from_displacement),
                          unit.acceleration(map.displacement_from_rate, map.rate_from_rate)}};
    });
  }

  /// Over a span, at most dt, and at most the time of the largest impulse [s]. rate: see above.
  CrowdResponse at(double rate, double span, double dt) const {
    const auto [from_displacement, from_rate] = table_(std::min(rate * span, longest_));
    return {rate * from_displacement, from_rate, dt};
  }

private:
  using Table = HermiteTable<2>;
  static constexpr std::size_t cells = 32;

  double longest_;
  Table table_;
};

} // namespace cfpm
