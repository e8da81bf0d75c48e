// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_check.h"

#include "host_contact_models.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>

namespace cfpm::liggghts {

namespace {

constexpr const char *built_for = "LIGGGHTS-PUBLIC 3.8.0,"; // in the host's version line, before the build date
constexpr const char *host_library = "libliggghts.so.3";

/// A host function that creates objects, and the sizes of their classes as compiled here.
struct LayoutProbe {
  const char *creator; // mangled
  std::size_t length;  // of its code that is worth looking at
  std::vector<std::size_t> sizes;
};

std::vector<LayoutProbe> layout_probes() {
  using namespace LAMMPS_NS;
  return {
      {"_ZN9LAMMPS_NS6LAMMPS6createEv", 0x280, {sizeof(Atom), sizeof(Force), sizeof(Modify), sizeof(Update)}},
      {"_ZN9LAMMPS_NS5Force12pair_creatorINS_13PairGranProxyEEEPNS_4PairEPNS_6LAMMPSE", 0x20, {sizeof(PairGranProxy)}},
      {"_ZN9LAMMPS_NS6Modify11fix_creatorINS_11FixWallGranEEEPNS_3FixEPNS_6LAMMPSEiPPc", 0x20, {sizeof(FixWallGran)}},
      {"_ZN9LAMMPS_NS6Modify11fix_creatorINS_14FixMeshSurfaceEEEPNS_3FixEPNS_6LAMMPSEiPPc",
       0x20,
       {sizeof(FixMeshSurface)}}};
}

} // namespace

std::vector<std::size_t> allocation_sizes([[maybe_unused]] const unsigned char *code,
                                          [[maybe_unused]] std::size_t length) {
  std::vector<std::size_t> sizes;
#ifdef __x86_64__
  constexpr unsigned char move_to_edi = 0xbf;
  constexpr unsigned char call = 0xe8;
  std::uint32_t loaded = 0;
  for (std::size_t at = 0; at + 5 <= length; ++at) {
    if (code[at] == move_to_edi) {
      std::memcpy(&loaded, code + at + 1, sizeof loaded);
      at += sizeof loaded;
    } else if (code[at] == call && loaded != 0) {
      sizes.push_back(loaded);
      loaded = 0;
    }
  }
#endif
  return sizes;
}

std::string reason_to_refuse(const LAMMPS_NS::LAMMPS &lmp) {
  const char *version = lmp.universe->version;
  if (!std::strstr(version, built_for)) return std::string("built for ") + built_for + " this host is " + version;
#ifdef __x86_64__
  void *library = dlopen(host_library, RTLD_NOW | RTLD_NOLOAD);
  if (!library) return std::string("the host does not use ") + host_library;
  std::string reason;
  for (const LayoutProbe &probe : layout_probes()) {
    const void *code = dlsym(library, probe.creator);
    if (!code) {
      reason = std::string("the host lacks the function ") + probe.creator;
      break;
    }
    const std::vector<std::size_t> found = allocation_sizes(static_cast<const unsigned char *>(code), probe.length);
    for (const std::size_t size : probe.sizes)
      if (std::find(found.begin(), found.end(), size) == found.end())
        reason = "class sizes differ in " + std::string(probe.creator) + ": expected an object of " +
                 std::to_string(size) + " bytes; the host was built with other features";
  }
  dlclose(library);
  return reason;
#else
  return {};
#endif
}

} // namespace cfpm::liggghts
