// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_check.h"

#include "host_contact_models.h"
#include "host_heat.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>
#include <link.h>

namespace cfpm::liggghts {

namespace {

constexpr const char *built_for = "LIGGGHTS-PUBLIC 3.8.0,"; // in the host's version line, before the build date

/// A host function that creates objects, and the sizes of their classes as compiled here.
struct LayoutProbe {
  const char *creator; // mangled
  std::vector<std::size_t> sizes;
};

constexpr const char *wall_creator = "_ZN9LAMMPS_NS6Modify11fix_creatorINS_11FixWallGranEEEPNS_3FixEPNS_6LAMMPSEiPPc";

std::vector<LayoutProbe> layout_probes() {
  using namespace LAMMPS_NS;
  return {
      {"_ZN9LAMMPS_NS6LAMMPS6createEv", {sizeof(Atom), sizeof(Force), sizeof(Modify), sizeof(Update)}},
      {"_ZN9LAMMPS_NS5Force12pair_creatorINS_13PairGranProxyEEEPNS_4PairEPNS_6LAMMPSE", {sizeof(PairGranProxy)}},
      {wall_creator, {sizeof(FixWallGran)}},
      {"_ZN9LAMMPS_NS6Modify11fix_creatorINS_14FixMeshSurfaceEEEPNS_3FixEPNS_6LAMMPSEiPPc", {sizeof(FixMeshSurface)}},
      {"_ZN9LAMMPS_NS6Modify11fix_creatorINS_15FixHeatGranCondEEEPNS_3FixEPNS_6LAMMPSEiPPc",
       {sizeof(FixHeatGranCond)}}};
}

/// The file is found by a function that nobody stands in front of, as the loader does before LAMMPS::create; its name
/// is the packager's choice.
void *open_host_file() {
  Dl_info info{};
  const void *known = dlsym(RTLD_DEFAULT, wall_creator);
  return known && dladdr(known, &info) != 0 ? dlopen(info.dli_fname, RTLD_NOW | RTLD_NOLOAD) : nullptr;
}

std::string listed(const std::vector<std::size_t> &numbers) {
  std::string list;
  for (const std::size_t number : numbers) list += (list.empty() ? "" : ", ") + std::to_string(number);
  return list.empty() ? "none" : list;
}

} // namespace

Code host_code(const char *function) {
  static void *const file = open_host_file(); // stays open, as the host does
  const void *const address = file ? dlsym(file, function) : nullptr;
  Dl_info info{};
  ElfW(Sym) *symbol = nullptr;
  if (!address || dladdr1(address, &info, reinterpret_cast<void **>(&symbol), RTLD_DL_SYMENT) == 0 || !symbol)
    return {};
  return {static_cast<const unsigned char *>(address), symbol->st_size};
}

std::vector<std::size_t> possible_allocations([[maybe_unused]] const Code &code) {
  std::vector<std::size_t> sizes;
#ifdef __x86_64__
  constexpr unsigned char move_to_edi = 0xbf;       // and four bytes, the number
  constexpr std::uint32_t largest_class = 1U << 20; // the host's have some hundred bytes, and pointers among them
  // No byte is skipped after a match: where one is inside another instruction, the true load may begin right behind it.
  for (std::size_t at = 0; at + 5 <= code.length; ++at) {
    if (code.bytes[at] != move_to_edi) continue;
    std::uint32_t loaded = 0;
    std::memcpy(&loaded, code.bytes + at + 1, sizeof loaded);
    if (loaded % alignof(void *) == 0 && loaded <= largest_class) sizes.push_back(loaded);
  }
#endif
  return sizes;
}

std::string reason_to_refuse(const LAMMPS_NS::LAMMPS &lmp) {
  const char *version = lmp.universe->version;
  if (!std::strstr(version, built_for)) return std::string("built for ") + built_for + " this host is " + version;
#ifdef __x86_64__
  for (const LayoutProbe &probe : layout_probes()) {
    const Code code = host_code(probe.creator);
    if (!code.bytes) return std::string("the host lacks the function ") + probe.creator;
    const std::vector<std::size_t> found = possible_allocations(code);
    for (const std::size_t size : probe.sizes)
      if (std::find(found.begin(), found.end(), size) == found.end())
        return "class sizes differ in " + std::string(probe.creator) + ": expected an object of " +
               std::to_string(size) + " bytes, found " + listed(found) +
               "; the host was built with other features, or the plugin with headers of another host";
  }
#endif
  return {};
}

} // namespace cfpm::liggghts
