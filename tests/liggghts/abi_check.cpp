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
#include <dlfcn.h>
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

std::vector<std::size_t> allocated_by(const std::string &function, std::size_t length) {
  static void *const library = dlopen("libliggghts.so.3", RTLD_LAZY);
  const void *code = library ? dlsym(library, function.c_str()) : nullptr;
  if (!code) return {};
  return cfpm::liggghts::allocation_sizes(static_cast<const unsigned char *>(code), length);
}

TEST(HostClasses, EveryStyleHasTheHostsSize) {
  std::size_t checked = 0;
  for (const Style &style : styles) {
    const std::vector<std::size_t> found = allocated_by(style.creator, 0x40);
    if (found.empty()) {
      std::printf("not in the library: %s\n", style.name.c_str());
      continue;
    }
    EXPECT_EQ(style.size, found.front()) << style.name;
    ++checked;
  }
  std::printf("%zu of %zu styles checked\n", checked, styles.size());
  EXPECT_GT(checked, 100U);
}

TEST(HostClasses, CoreClassesHaveTheHostsSize) {
  const std::vector<std::size_t> found = allocated_by("_ZN9LAMMPS_NS6LAMMPS6createEv", 0x280);
  const auto allocated = [&found](std::size_t size) {
    return std::find(found.begin(), found.end(), size) != found.end();
  };
  EXPECT_TRUE(allocated(sizeof(Atom))) << sizeof(Atom);
  EXPECT_TRUE(allocated(sizeof(Comm))) << sizeof(Comm);
  EXPECT_TRUE(allocated(sizeof(Domain))) << sizeof(Domain);
  EXPECT_TRUE(allocated(sizeof(Force))) << sizeof(Force);
  EXPECT_TRUE(allocated(sizeof(Group))) << sizeof(Group);
  EXPECT_TRUE(allocated(sizeof(Modify))) << sizeof(Modify);
  EXPECT_TRUE(allocated(sizeof(Neighbor))) << sizeof(Neighbor);
  EXPECT_TRUE(allocated(sizeof(Output))) << sizeof(Output);
  EXPECT_TRUE(allocated(sizeof(Update))) << sizeof(Update);
}

} // namespace
