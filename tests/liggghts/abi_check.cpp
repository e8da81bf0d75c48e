// SPDX-License-Identifier: GPL-2.0-or-later
// The plugin is compiled without the host's build options, so a class could have another layout here
// than in the host's library. Its creator functions tell what size they allocate for every style.

#include "../../src/liggghts/host_check.h"
#include "../../src/liggghts/host_contact_models.h"

#include "host_compute_styles.h"
#include "host_fix_styles.h"
#include "host_pair_styles.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

struct Style {
  std::string name;
  std::string creator; // mangled
  std::size_t size;
};

std::string mangled(const std::string &name) { return std::to_string(name.size()) + name; }

std::string fix_creator(const std::string &name) {
  return "_ZN9LAMMPS_NS6Modify11fix_creatorINS_" + mangled(name) + "EEEPNS_3FixEPNS_6LAMMPSEiPPc";
}
std::string pair_creator(const std::string &name) {
  return "_ZN9LAMMPS_NS5Force12pair_creatorINS_" + mangled(name) + "EEEPNS_4PairEPNS_6LAMMPSE";
}
std::string compute_creator(const std::string &name) {
  return "_ZN9LAMMPS_NS6Modify15compute_creatorINS_" + mangled(name) + "EEEPNS_7ComputeEPNS_6LAMMPSEiiPPc";
}

using namespace LAMMPS_NS;
using namespace cfpm::liggghts;

// with these macros set the host's headers expand to their registration lines alone
const std::vector<Style> styles{
#define FIX_CLASS
#define FixStyle(key, Class) {#key, fix_creator(#Class), sizeof(Class)},
#include "host_fix_styles.h"
#undef FIX_CLASS
#define PAIR_CLASS
#define PairStyle(key, Class) {#key, pair_creator(#Class), sizeof(Class)},
#include "host_pair_styles.h"
#undef PAIR_CLASS
#define COMPUTE_CLASS
#define ComputeStyle(key, Class) {#key, compute_creator(#Class), sizeof(Class)},
#include "host_compute_styles.h"
#undef COMPUTE_CLASS
};

bool allocates(const Code &code, std::size_t size) {
  const std::vector<std::size_t> found = possible_allocations(code);
  return std::find(found.begin(), found.end(), size) != found.end();
}

TEST(HostClasses, EveryStyleHasTheHostsSize) {
  std::size_t checked = 0;
  for (const Style &style : styles) {
    const Code code = host_code(style.creator.c_str());
    if (!code.bytes) {
      std::printf("not in the library: %s\n", style.name.c_str());
      continue;
    }
    EXPECT_EQ(std::vector<std::size_t>{style.size}, possible_allocations(code)) << style.name;
    ++checked;
  }
  std::printf("%zu of %zu styles checked\n", checked, styles.size());
  EXPECT_GT(checked, 100U);
}

TEST(HostClasses, CoreClassesHaveTheHostsSize) {
  const Code create = host_code("_ZN9LAMMPS_NS6LAMMPS6createEv");
  EXPECT_TRUE(allocates(create, sizeof(Atom))) << sizeof(Atom);
  EXPECT_TRUE(allocates(create, sizeof(Comm))) << sizeof(Comm);
  EXPECT_TRUE(allocates(create, sizeof(Domain))) << sizeof(Domain);
  EXPECT_TRUE(allocates(create, sizeof(Force))) << sizeof(Force);
  EXPECT_TRUE(allocates(create, sizeof(Group))) << sizeof(Group);
  EXPECT_TRUE(allocates(create, sizeof(Modify))) << sizeof(Modify);
  EXPECT_TRUE(allocates(create, sizeof(Neighbor))) << sizeof(Neighbor);
  EXPECT_TRUE(allocates(create, sizeof(Output))) << sizeof(Output);
  EXPECT_TRUE(allocates(create, sizeof(Update))) << sizeof(Update);
}

TEST(HostClasses, AnAbsentFunctionHasNoCode) { EXPECT_EQ(nullptr, host_code("_ZN9LAMMPS_NS6LAMMPS7destroyXEv").bytes); }

template <std::size_t size> Code code_of(const unsigned char (&bytes)[size]) { return {bytes, size}; }

// The compiler of Debian 13 begins functions with endbr64 and pushes more before the call: it ends at byte 0x21.
TEST(PossibleAllocations, CallFarBehindTheBeginning) {
  const unsigned char creator[] = {
      0xf3, 0x0f, 0x1e, 0xfa,             // endbr64
      0x41, 0x55, 0x49, 0x89, 0xd5,       // push, mov
      0x41, 0x54, 0x41, 0x89, 0xf4,       // push, mov
      0x55, 0x48, 0x89, 0xfd,             // push, mov
      0x48, 0x83, 0xec, 0x08,             // sub: room on the stack
      0x66, 0x0f, 0x1f, 0x44, 0x00, 0x00, // padding
      0xbf, 0xa0, 0x03, 0x00, 0x00,       // mov $0x3a0,%edi
      0xe8, 0x75, 0x9c, 0xbb, 0xff,       // call operator new
      0xc3                                // ret
  };
  EXPECT_EQ(std::vector<std::size_t>{0x3a0}, possible_allocations(code_of(creator)));
}

// Debian forky's LAMMPS::create has cmpq $0,0xb0(%rdi) before the first load: 0xbf inside of it is no load.
TEST(PossibleAllocations, ALoadIsNotHiddenByBytesThatLookLikeOne) {
  const unsigned char far[] = {0x48, 0x83, 0xbf, 0xb0, 0x00, 0x00, 0x00, 0x00, // cmpq $0x0,0xb0(%rdi)
                               0xbf, 0x78, 0x03, 0x00, 0x00,                   // mov $0x378,%edi
                               0xe8, 0x1b, 0xc0, 0xe2, 0xff};
  EXPECT_TRUE(allocates(code_of(far), 0x378));
  const unsigned char near[] = {0x48, 0x8d, 0x47, 0xbf,       // lea -0x41(%rdi),%rax
                                0xbf, 0x78, 0x03, 0x00, 0x00, // mov $0x378,%edi
                                0xe8, 0x1b, 0xc0, 0xe2, 0xff};
  EXPECT_TRUE(allocates(code_of(near), 0x378));
}

TEST(PossibleAllocations, EndsWithTheFunction) {
  const unsigned char cut[] = {0x55, 0xbf, 0x78, 0x03, 0x00};
  EXPECT_TRUE(possible_allocations(code_of(cut)).empty());
}

} // namespace
