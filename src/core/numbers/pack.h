// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

/// Of a lambda in a loop over packs, behind its parameters: among many of them the compiler runs out of budget.
#define CFPM_INLINED __attribute__((always_inline))

namespace cfpm {

/// Some numbers side by side in one register, with which arithmetic is done at once: what is a template over a number R
/// (geometry, laws, predictions, friction) is compiled for double and, with the same bits in every lane, for packs. In
/// place of a branch there is select(), which takes of either side what a lane asks for.
///
/// A function that takes packs is inlined by order: how they would pass a call depends on the registers that its caller
/// may use, see compute(). Where lanes are taken one by one, a copy of the values is: of a part of an aggregate the
/// compiler would do it in memory.
template <int lanes> struct Pack {
  // GCC gives an alias made with "using" no size that depends on a template argument
  // NOLINTBEGIN(modernize-use-using)
  typedef double Values __attribute__((vector_size(8 * lanes)));
  typedef long long Mask __attribute__((vector_size(8 * lanes))); ///< of a comparison; all bits of a lane, or none
  typedef std::uint64_t Bits __attribute__((vector_size(8 * lanes)));
  typedef int Integers __attribute__((vector_size(4 * lanes)));
  // NOLINTEND(modernize-use-using)
  static constexpr int width = lanes;

  Values values;

  Pack() = default;
  [[gnu::always_inline]] Pack(const Values &v) : values(v) {}
  [[gnu::always_inline]] Pack(double in_all_lanes) : values(in_all_lanes - Values{}) {}
  /// Numbers one behind the other.
  [[gnu::always_inline]] static Pack load(const double *numbers) {
    Values values;
    std::memcpy(&values, numbers, sizeof values);
    return values;
  }
  [[gnu::always_inline]] void store(double *numbers) const { std::memcpy(numbers, &values, sizeof values); }

  // NOLINTBEGIN(bugprone-macro-parentheses)
#define CFPM_OPERATOR(result, op)                                                                                      \
  [[gnu::always_inline]] friend result operator op(const Pack &a, const Pack &b) { return a.values op b.values; }
  CFPM_OPERATOR(Pack, +)
  CFPM_OPERATOR(Pack, -)
  CFPM_OPERATOR(Pack, *)
  CFPM_OPERATOR(Pack, /)
  CFPM_OPERATOR(Mask, <)
  CFPM_OPERATOR(Mask, >=)
  CFPM_OPERATOR(Mask, !=)
#undef CFPM_OPERATOR
  // NOLINTEND(bugprone-macro-parentheses)
  [[gnu::always_inline]] friend Pack operator-(const Pack &a) { return -a.values; }
  [[gnu::always_inline]] friend Pack select(const Mask &mask, const Pack &a, const Pack &b) {
    return mask ? a.values : b.values;
  }
};

/// What a Pack is made of; apart from it, as inside of itself the compiler takes its vectors for numbers.
template <class P> struct Lanes {
  /// number_of(lane): of each.
  template <class NumberOf> [[gnu::always_inline]] static P fill(const NumberOf &number_of) {
    return fill(number_of, std::make_integer_sequence<int, P::width>{});
  }
  [[gnu::always_inline]] static P of(const typename P::Integers &a) {
    return __builtin_convertvector(a, typename P::Values);
  }

private:
  template <class NumberOf, int... lane>
  [[gnu::always_inline]] static P fill(const NumberOf &number_of, std::integer_sequence<int, lane...>) {
    return typename P::Values{number_of(lane)...};
  }
};

/// The compiler makes one instruction of it.
template <int lanes> [[gnu::always_inline]] inline Pack<lanes> sqrt(const Pack<lanes> &a) {
  auto roots = a.values;
  for (int k = 0; k < lanes; ++k) roots[k] = std::sqrt(roots[k]);
  return roots;
}
/// Likewise.
template <int lanes> [[gnu::always_inline]] inline Pack<lanes> fabs(const Pack<lanes> &a) {
  auto sizes = a.values;
  for (int k = 0; k < lanes; ++k) sizes[k] = std::fabs(sizes[k]);
  return sizes;
}

/// In which lanes a condition holds, a bit for each.
template <class Mask> [[gnu::always_inline]] inline unsigned lanes_of(const Mask &mask) {
  constexpr std::size_t lanes = sizeof mask / sizeof mask[0];
#ifdef __x86_64__ // one instruction for two, which the compiler does not find
  const auto of_two = [](const Pack<2>::Mask &two) {
    return static_cast<unsigned>(__builtin_ia32_movmskpd(reinterpret_cast<const Pack<2>::Values &>(two)));
  };
  if constexpr (lanes == 2)
    return of_two(mask);
  else if constexpr (lanes == 4)
    return of_two(__builtin_shufflevector(mask, mask, 0, 1)) | of_two(__builtin_shufflevector(mask, mask, 2, 3)) << 2U;
  else
#endif
  {
    unsigned bits = mask[0] != 0 ? 1U : 0U;
    for (std::size_t k = 1; k < lanes; ++k) bits |= (mask[k] != 0 ? 1U : 0U) << k;
    return bits;
  }
}

/// Whether a condition holds in any lane.
inline bool any(bool condition) { return condition; }
inline bool any(int conditions) { return conditions != 0; } // of two numbers, joined by "&"
template <class Mask> [[gnu::always_inline]] inline bool any(const Mask &mask) { return lanes_of(mask) != 0; }

/// Whether it holds in every lane.
inline bool all(bool condition) { return condition; }
template <class Mask> [[gnu::always_inline]] inline bool all(const Mask &mask) {
  return lanes_of(mask) + 1 == 1U << (sizeof mask / sizeof mask[0]);
}

/// The largest of all lanes.
template <int lanes> [[gnu::always_inline]] inline double largest(const Pack<lanes> &a) {
  const auto values = a.values;
  double most = values[0];
  for (int k = 1; k < lanes; ++k) most = most < values[k] ? values[k] : most;
  return most;
}

/// Rounded towards zero; of a size that an int holds.
inline int integer(double a) { return static_cast<int>(a); }
template <int lanes> [[gnu::always_inline]] inline typename Pack<lanes>::Integers integer(const Pack<lanes> &a) {
  return __builtin_convertvector(a.values, typename Pack<lanes>::Integers);
}
template <class R> [[gnu::always_inline]] inline R number(int a) { return a; }
template <class P> [[gnu::always_inline]] inline P number(const typename P::Integers &a) { return Lanes<P>::of(a); }

/// How numbers are stored, as integers that are not negative; and the numbers that are stored so.
[[gnu::always_inline]] inline std::uint64_t bits(double a) {
  std::uint64_t stored = 0;
  std::memcpy(&stored, &a, sizeof stored);
  return stored;
}
template <int lanes> [[gnu::always_inline]] inline typename Pack<lanes>::Bits bits(const Pack<lanes> &a) {
  typename Pack<lanes>::Bits stored;
  std::memcpy(&stored, &a.values, sizeof stored);
  return stored;
}
template <class R, class Bits> [[gnu::always_inline]] inline R number_of(const Bits &stored) {
  R a;
  static_assert(sizeof a == sizeof stored);
  std::memcpy(&a, &stored, sizeof a);
  return a;
}

/// a where the condition holds, b elsewhere.
constexpr double select(bool condition, double a, double b) { return condition ? a : b; }

/// As std::max() and std::min(), also where one of the two is no number.
template <class R> [[gnu::always_inline]] constexpr R larger(const R &a, const R &b) { return select(a < b, b, a); }
template <class R> [[gnu::always_inline]] constexpr R smaller(const R &a, const R &b) { return select(b < a, b, a); }

} // namespace cfpm
