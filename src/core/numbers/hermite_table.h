// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace cfpm {

/// Where a table of numbers begins. R: double, or a Pack of which each lane may look into a table of its own.
template <class R> struct TableNumbers {
  const double *first = nullptr;

  double operator[](int index) const { return first[index]; }
};
template <int lanes> struct TableNumbers<Pack<lanes>> {
  const double *first[lanes];

  TableNumbers() = default;
  /// Pointers are as large as numbers, and are gathered as such.
  [[gnu::always_inline]] TableNumbers(const Pack<lanes> &stored) {
    static_assert(sizeof first == sizeof stored.values);
    std::memcpy(first, &stored.values, sizeof first);
  }
  [[gnu::always_inline]] Pack<lanes> operator[](const typename Pack<lanes>::Integers &index) const {
    typename Pack<lanes>::Values numbers;
    for (int lane = 0; lane < lanes; ++lane) numbers[lane] = first[lane][index[lane]];
    return numbers;
  }
};

/// The equidistant nodes of some functions among the numbers of a table. R: see TableNumbers.
template <class R> struct HermiteNodes {
  R first;       ///< argument at the first one
  R per_spacing; ///< between them
  R cells;       ///< between them, how many
  R behind;      ///< how many nodes of others stand before

  /// By cubic Hermite interpolation. Beyond the first or last node by rounding: as at that node, nearly. A node: the
  /// values of all functions, then their derivatives times the spacing.
  template <std::size_t functions>
  [[gnu::always_inline]] std::array<R, functions> interpolate(const TableNumbers<R> &numbers, const R &x) const {
    constexpr int node = 2 * static_cast<int>(functions);
    const R at = larger(R(0.0), (x - first) * per_spacing);
    const R cell = number<R>(integer(smaller(cells - 1.0, at)));
    const R t = at - cell;
    const auto start = integer(static_cast<double>(node) * (cell + behind));
    std::array<R, functions> found;
    for (int k = 0; k < static_cast<int>(functions); ++k) {
      const R value = numbers[start + k];
      const R slope = numbers[start + (static_cast<int>(functions) + k)];
      const R rise = numbers[start + (node + k)] - value;
      const R end_slope = numbers[start + (node + static_cast<int>(functions) + k)];
      found[static_cast<std::size_t>(k)] =
          value + t * (slope + t * (3.0 * rise - 2.0 * slope - end_slope + t * (slope + end_slope - 2.0 * rise)));
    }
    return found;
  }
};

/// Some functions of one variable by cubic Hermite interpolation between equidistant nodes; off by
/// spacing^4/384 times their fourth derivative.
template <std::size_t functions> class HermiteTable {
public:
  struct Node {
    std::array<double, functions> value;
    std::array<double, functions> slope; ///< derivative
  };

  HermiteTable() = default;
  /// node(x): the functions and their derivatives at x, asked for cells + 1 times.
  template <class MakeNode> HermiteTable(double first, double last, std::size_t cells, const MakeNode &node)
      : nodes_{first, static_cast<double>(cells) / (last - first), static_cast<double>(cells), 0.0} {
    const double spacing = (last - first) / static_cast<double>(cells);
    for (std::size_t k = 0; k <= cells; ++k) {
      const Node n = node(k == cells ? last : first + static_cast<double>(k) * spacing);
      numbers_.insert(numbers_.end(), n.value.begin(), n.value.end());
      for (const double slope : n.slope) numbers_.push_back(slope * spacing);
    }
  }

  std::array<double, functions> operator()(double x) const {
    return nodes_.template interpolate<functions>({numbers_.data()}, x);
  }

  /// Moves its numbers behind those of other tables. Returns where its nodes are there.
  HermiteNodes<double> join(std::vector<double> &numbers) const {
    HermiteNodes<double> nodes = nodes_;
    nodes.behind = static_cast<double>(numbers.size() / (2 * functions));
    numbers.insert(numbers.end(), numbers_.begin(), numbers_.end());
    return nodes;
  }

private:
  HermiteNodes<double> nodes_{};
  std::vector<double> numbers_;
};

} // namespace cfpm
