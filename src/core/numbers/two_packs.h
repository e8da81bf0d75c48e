// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <cstdint>

namespace cfpm {

/// What two packs give together: of a comparison, of bits, of integers.
template <class Part> struct Two {
  Part first, second;

  [[gnu::always_inline]] friend Two operator>>(const Two &a, int bits) { return {a.first >> bits, a.second >> bits}; }
  [[gnu::always_inline]] friend Two operator<<(const Two &a, int bits) { return {a.first << bits, a.second << bits}; }
  [[gnu::always_inline]] friend Two operator|(const Two &a, std::uint64_t b) { return {a.first | b, a.second | b}; }
  [[gnu::always_inline]] friend Two operator|(const Two &a, const Two &b) {
    return {a.first | b.first, a.second | b.second};
  }
  [[gnu::always_inline]] friend Two operator&(const Two &a, const Two &b) {
    return {a.first & b.first, a.second & b.second};
  }
  [[gnu::always_inline]] friend bool any(const Two &masks) { return cfpm::any(masks.first) || cfpm::any(masks.second); }
  [[gnu::always_inline]] friend bool all(const Two &masks) { return cfpm::all(masks.first & masks.second); }
  [[gnu::always_inline]] friend unsigned lanes_of(const Two &masks) {
    return cfpm::lanes_of(masks.first) | cfpm::lanes_of(masks.second) << sizeof(Part) / sizeof(double);
  }
};

/// Two packs of contacts at once. A contact is a chain of roots and quotients, each of which waits for the one before
/// it; the processor looks ahead over fewer instructions than a pack has. Of two chains one goes on while the other
/// waits, though the registers do not hold both. P: a Pack, of as many lanes as the instructions take.
template <class P> struct TwoPacks {
  using Part = P;
  using Mask = Two<typename P::Mask>;
  using Bits = Two<typename P::Bits>;
  using Integers = Two<typename P::Integers>;
  static constexpr int width = 2 * P::width;

  P first, second;

  TwoPacks() = default;
  [[gnu::always_inline]] TwoPacks(const P &a, const P &b) : first(a), second(b) {}
  [[gnu::always_inline]] TwoPacks(double in_all_lanes) : first(in_all_lanes), second(in_all_lanes) {}
  /// See Pack.
  [[gnu::always_inline]] static TwoPacks load(const double *numbers) {
    return {P::load(numbers), P::load(numbers + P::width)};
  }
  [[gnu::always_inline]] void store(double *numbers) const {
    first.store(numbers);
    second.store(numbers + P::width);
  }

  // NOLINTBEGIN(bugprone-macro-parentheses)
#define CFPM_OPERATOR(result, op)                                                                                      \
  [[gnu::always_inline]] friend result operator op(const TwoPacks &a, const TwoPacks &b) {                             \
    return {a.first op b.first, a.second op b.second};                                                                 \
  }
  CFPM_OPERATOR(TwoPacks, +)
  CFPM_OPERATOR(TwoPacks, -)
  CFPM_OPERATOR(TwoPacks, *)
  CFPM_OPERATOR(TwoPacks, /)
  CFPM_OPERATOR(Mask, <)
  CFPM_OPERATOR(Mask, >=)
  CFPM_OPERATOR(Mask, !=)
#undef CFPM_OPERATOR
  // NOLINTEND(bugprone-macro-parentheses)
  [[gnu::always_inline]] friend TwoPacks operator-(const TwoPacks &a) { return {-a.first, -a.second}; }
  [[gnu::always_inline]] friend TwoPacks select(const Mask &mask, const TwoPacks &a, const TwoPacks &b) {
    return {select(mask.first, a.first, b.first), select(mask.second, a.second, b.second)};
  }
  [[gnu::always_inline]] friend TwoPacks sqrt(const TwoPacks &a) { return {sqrt(a.first), sqrt(a.second)}; }
  [[gnu::always_inline]] friend TwoPacks fabs(const TwoPacks &a) { return {fabs(a.first), fabs(a.second)}; }
  [[gnu::always_inline]] friend double largest(const TwoPacks &a) {
    return larger(largest(a.first), largest(a.second));
  }
  [[gnu::always_inline]] friend Integers integer(const TwoPacks &a) { return {integer(a.first), integer(a.second)}; }
  [[gnu::always_inline]] friend Bits bits(const TwoPacks &a) { return {bits(a.first), bits(a.second)}; }
};

template <class P> struct Lanes<TwoPacks<P>> {
  template <class NumberOf> [[gnu::always_inline]] static TwoPacks<P> fill(const NumberOf &number_of) {
    return {Lanes<P>::fill(number_of),
            Lanes<P>::fill([&](int lane) CFPM_INLINED { return number_of(lane + P::width); })};
  }
  [[gnu::always_inline]] static TwoPacks<P> of(const typename TwoPacks<P>::Integers &a) {
    return {Lanes<P>::of(a.first), Lanes<P>::of(a.second)};
  }
};

template <class R, class Bits> [[gnu::always_inline]] inline R number_of(const Two<Bits> &stored) {
  using Part = typename R::Part;
  return {number_of<Part>(stored.first), number_of<Part>(stored.second)};
}

} // namespace cfpm
