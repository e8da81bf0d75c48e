// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"
#include "core/numbers/two_packs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace cfpm {

/// Where a table of numbers begins, or a row of it. R: double, or a Pack of which each lane may look into a table of
/// its own.
template <class R> struct TableNumbers {
  const double *first = nullptr;

  TableNumbers from(int index) const { return {first + index}; }
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
  [[gnu::always_inline]] TableNumbers from(const typename Pack<lanes>::Integers &index) const {
    TableNumbers row;
    for (int lane = 0; lane < lanes; ++lane) row.first[lane] = first[lane] + index[lane];
    return row;
  }
  [[gnu::always_inline]] Pack<lanes> operator[](int index) const {
    return Lanes<Pack<lanes>>::fill([&](int lane) CFPM_INLINED { return first[lane][index]; });
  }
};

template <class P> struct TableNumbers<TwoPacks<P>> {
  TableNumbers<P> first, second;

  TableNumbers() = default;
  [[gnu::always_inline]] TableNumbers(const TableNumbers<P> &a, const TableNumbers<P> &b) : first(a), second(b) {}
  [[gnu::always_inline]] TableNumbers(const TwoPacks<P> &stored) : first(stored.first), second(stored.second) {}
  [[gnu::always_inline]] TableNumbers from(const typename TwoPacks<P>::Integers &index) const {
    return {first.from(index.first), second.from(index.second)};
  }
  [[gnu::always_inline]] TwoPacks<P> operator[](int index) const { return {first[index], second[index]}; }
};

/// Where some functions are among the numbers of a table: in each of equal cells they are cubic. R: see TableNumbers.
template <class R> struct HermiteCells {
  R first;       ///< argument at the beginning of the first one
  R per_spacing; ///< over their width
  R count;
  R behind; ///< how many cells of others stand before

  /// Beyond the first or last cell by rounding: as at its end, nearly.
  template <std::size_t functions>
  [[gnu::always_inline]] std::array<R, functions> interpolate(const TableNumbers<R> &numbers, const R &x) const {
    const R at = larger(R(0.0), (x - first) * per_spacing);
    const R cell = number<R>(integer(smaller(count - 1.0, at)));
    const R t = at - cell;
    const TableNumbers<R> row = numbers.from(integer(static_cast<double>(4 * functions) * (cell + behind)));
    std::array<R, functions> found;
    for (int k = 0; k < static_cast<int>(functions); ++k)
      found[static_cast<std::size_t>(k)] =
          row[4 * k] + t * (row[4 * k + 1] + t * (row[4 * k + 2] + t * row[4 * k + 3]));
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
      : cells_{first, static_cast<double>(cells) / (last - first), static_cast<double>(cells), 0.0} {
    const double spacing = (last - first) / static_cast<double>(cells);
    Node a = node(first);
    for (std::size_t k = 1; k <= cells; ++k) {
      const Node b = node(k == cells ? last : first + static_cast<double>(k) * spacing);
      for (std::size_t f = 0; f < functions; ++f) {
        const double rise = b.value[f] - a.value[f];
        const double slope = a.slope[f] * spacing;
        const double end_slope = b.slope[f] * spacing;
        for (const double factor :
             {a.value[f], slope, 3.0 * rise - 2.0 * slope - end_slope, slope + end_slope - 2.0 * rise})
          numbers_.push_back(factor);
      }
      a = b;
    }
  }

  std::array<double, functions> operator()(double x) const {
    return cells_.template interpolate<functions>({numbers_.data()}, x);
  }

  /// Puts its numbers behind those of other tables. Returns where its cells are there.
  HermiteCells<double> join(std::vector<double> &numbers) const {
    HermiteCells<double> cells = cells_;
    const std::size_t before = numbers.size() / (4 * functions);
    cells.behind = static_cast<double>(before);
    numbers.insert(numbers.end(), numbers_.begin(), numbers_.end());
    return cells;
  }

private:
  HermiteCells<double> cells_{};
  std::vector<double> numbers_; ///< of each cell, of each function: the factors of a cubic from 0 to 1
};

} // namespace cfpm
