// SPDX-License-Identifier: GPL-2.0-or-later
// How many numbers a loop over packs takes at a time, which the machine decides while the program runs.
#pragma once

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>

#if defined(__x86_64__) && !defined(CFPM_WITHOUT_AVX2) // which leaves packs of two, for a test
/// Of a function that is called where the machine has the instructions only.
#define CFPM_WITH_AVX2 [[gnu::target("avx2")]]
#endif

namespace cfpm {

struct InstructionSet {
  const char *name;
  int lanes; ///< of double precision; 1: no packs
};

/// Narrow ones first.
inline constexpr std::array instruction_sets{
    InstructionSet{"scalar", 1},
#ifdef __x86_64__
    InstructionSet{"sse2", 2}, // every processor of this kind has it
#ifdef CFPM_WITH_AVX2
    InstructionSet{"avx2", 4},
#endif
#elif defined(__aarch64__)
    InstructionSet{"neon", 2},
#endif
};

/// The variable of the environment in which a user, or a test, asks for a narrower one.
inline constexpr const char *instruction_set_variable = "CFPM_SIMD";

inline bool machine_has(const InstructionSet &set) {
#ifdef CFPM_WITH_AVX2
  if (set.lanes > 2) return __builtin_cpu_supports("avx2");
#endif
  return set.lanes >= 1;
}

/// The widest that the machine has or, where asked is not null, the one of that name; null if the machine has it not.
inline const InstructionSet *find_instruction_set(const char *asked) {
  const InstructionSet *found = nullptr;
  for (const InstructionSet &set : instruction_sets)
    if (machine_has(set) && (!asked || std::strcmp(asked, set.name) == 0)) found = &set;
  return found;
}

/// What to tell a user who asks for one that the machine has not, else empty.
inline std::string reason_against_instruction_set(const char *asked) {
  if (find_instruction_set(asked)) return {};
  std::string known;
  for (const InstructionSet &set : instruction_sets)
    if (machine_has(set)) known += (known.empty() ? "" : ", ") + std::string(set.name);
  return std::string(instruction_set_variable) + " is '" + asked + "'; expected one of what this machine has: " + known;
}

/// The same of this process.
inline std::string reason_against_instruction_set() {
  return reason_against_instruction_set(std::getenv(instruction_set_variable));
}

/// That of this process; a plugin is not loaded where there is a reason against it.
inline const InstructionSet &instruction_set() {
  static const InstructionSet &chosen = *find_instruction_set(std::getenv(instruction_set_variable));
  return chosen;
}

} // namespace cfpm
