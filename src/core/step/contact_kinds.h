// SPDX-License-Identifier: GPL-2.0-or-later
// Which contacts of a chunk have the same parameters.
#pragma once

#include "core/step/particles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cfpm {

/// The classes of particles whose contacts have the same parameters. Made anew for each evaluation of what the host's
/// arrays hold then: whoever changes radius, mass, type or group need not tell, and nothing can be out of date.
class BodyClasses {
public:
  static constexpr int most = 16;
  static constexpr int too_many = 0; ///< what count() is where there are more

  BodyClasses() = default;
  /// body_of(i): the ContactBody of particle i, of count particles.
  template <class BodyOf> BodyClasses(int count, const BodyOf &body_of) {
    if (count == 0) return;
    bodies_[known_++] = body_of(0);
    const ContactBody first = bodies_[0];
    std::uint64_t difference = 0;
    for (int i = 0; i < count; ++i) difference |= first.difference(body_of(i));
    if (difference == 0) return; // most beds
    numbers_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count && known_ > 0; ++i) numbers_.push_back(number_of(body_of(i)));
  }

  int count() const { return known_; }
  bool are_too_many() const { return known_ == too_many; }
  int of(int i) const { return numbers_.empty() ? 0 : numbers_[static_cast<std::size_t>(i)]; }
  const ContactBody &body(int number) const { return bodies_[static_cast<std::size_t>(number)]; }

private:
  /// Looks at all: in a mixture a branch on each would be mispredicted.
  unsigned char number_of(const ContactBody &body) {
    int number = known_;
    for (int k = 0; k < known_; ++k) number = this->body(k).difference(body) == 0 ? k : number;
    if (number == most)
      known_ = too_many;
    else if (number == known_)
      bodies_[static_cast<std::size_t>(known_++)] = body;
    return static_cast<unsigned char>(number);
  }

  std::array<ContactBody, most> bodies_{};
  int known_ = 0;
  std::vector<unsigned char> numbers_; ///< of each particle; empty: all are of the first class
};

/// The kinds of contacts, by the classes of their bodies. Step: what the parameters of a contact consist of.
template <class Step> class ContactKinds {
public:
  /// See BodyClasses.
  template <class BodyOf> ContactKinds(int count, const BodyOf &body_of) : classes_(count, body_of) {
    const auto classes = static_cast<std::size_t>(classes_.count());
    const std::size_t pairs = classes * classes;
    kinds_.assign(pairs, unmet);
    steps_.reserve(pairs); // those of a chunk stay where they are
  }

  bool are_too_many() const { return classes_.are_too_many(); }

  /// Says of each contact of a chunk which steps it has. step_of(body i, body j): of two bodies.
  template <class Chunk, class BodyOf, class StepOf>
  void set(Chunk &chunk, const BodyOf &body_of, const StepOf &step_of) {
    if (are_too_many()) return set_one_by_one(chunk, body_of, step_of);
    const int count = classes_.count();
    int different = 0;
    if (count == 1) {
      kind_of(0, 0, step_of); // each contact of a chunk has 0 from the beginning
    } else {
      for (int k = 0; k < chunk.count; ++k) {
        chunk.kind[k] = kind_of(classes_.of(chunk.i[k]), classes_.of(chunk.j[k]), step_of);
        different |= chunk.kind[k] ^ chunk.kind[0];
      }
    }
    chunk.one_kind = different == 0;
    chunk.steps = steps_.data();
  }

private:
  static constexpr int unmet = -1;

  template <class StepOf> int kind_of(int class_i, int class_j, const StepOf &step_of) {
    const int place = class_i * classes_.count() + class_j;
    int &kind = kinds_[static_cast<std::size_t>(place)];
    if (__builtin_expect(kind == unmet, 0)) {
      kind = static_cast<int>(steps_.size());
      steps_.push_back(step_of(classes_.body(class_i), classes_.body(class_j)));
    }
    return kind;
  }

  /// Where there are too many classes of a law that is not known for any sizes. The next contact often has the
  /// parameters of this one.
  template <class Chunk, class BodyOf, class StepOf>
  void set_one_by_one(Chunk &chunk, const BodyOf &body_of, const StepOf &step_of) {
    ContactBody last_i{};
    ContactBody last_j{};
    steps_.clear();
    steps_.reserve(Chunk::capacity);
    for (int k = 0; k < chunk.count; ++k) {
      const ContactBody body_i = body_of(chunk.i[k]);
      const ContactBody body_j = body_of(chunk.j[k]);
      if (steps_.empty() || !(body_i == last_i) || !(body_j == last_j)) {
        last_i = body_i;
        last_j = body_j;
        steps_.push_back(step_of(body_i, body_j));
      }
      chunk.kind[k] = static_cast<int>(steps_.size()) - 1;
    }
    chunk.one_kind = steps_.size() == 1;
    chunk.steps = steps_.data();
  }

  BodyClasses classes_;
  std::vector<int> kinds_;  ///< by the classes of i and j
  std::vector<Step> steps_; ///< by kind; copies: a cache keeps what it gives until it is asked again
};

} // namespace cfpm
