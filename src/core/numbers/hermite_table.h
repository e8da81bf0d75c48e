// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace cfpm {

/// Some functions of one variable by cubic Hermite interpolation between equidistant nodes; off by
/// spacing^4/384 times their fourth derivative.
template <std::size_t Functions> class HermiteTable {
public:
  struct Node {
    std::array<double, Functions> value;
    std::array<double, Functions> slope; ///< derivative
  };

  HermiteTable() = default;
  /// node(x): the functions and their derivatives at x, asked for cells + 1 times.
  template <class MakeNode> HermiteTable(double first, double last, std::size_t cells, const MakeNode &node)
      : first_(first), per_spacing_(static_cast<double>(cells) / (last - first)), nodes_(cells + 1) {
    const double spacing = (last - first) / static_cast<double>(cells);
    for (std::size_t k = 0; k <= cells; ++k) {
      nodes_[k] = node(k == cells ? last : first + static_cast<double>(k) * spacing);
      for (double &slope : nodes_[k].slope) slope *= spacing;
    }
  }

  /// Beyond the first or last node by rounding: as at that node, nearly.
  std::array<double, Functions> operator()(double x) const {
    const double at = std::max(0.0, (x - first_) * per_spacing_);
    const std::size_t cell = std::min(static_cast<std::size_t>(at), nodes_.size() - 2);
    const double t = at - static_cast<double>(cell);
    const Node &a = nodes_[cell];
    const Node &b = nodes_[cell + 1];
    std::array<double, Functions> found;
    for (std::size_t k = 0; k < Functions; ++k) {
      const double rise = b.value[k] - a.value[k];
      found[k] = a.value[k] + t * (a.slope[k] + t * (3.0 * rise - 2.0 * a.slope[k] - b.slope[k] +
                                                     t * (a.slope[k] + b.slope[k] - 2.0 * rise)));
    }
    return found;
  }

private:
  double first_ = 0.0;
  double per_spacing_ = 0.0;
  std::vector<Node> nodes_;
};

} // namespace cfpm
