// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded into a stock host. Stands in front of the function HOST_FUNCTION, which the host calls when
// it has created its styles, at its start and again for the command "clear", lets the host do its work and
// then loads the plugin PLUGIN that lies beside this object. Knows no type of the host and exports nothing
// else, so it is harmless in any other process that inherits the preload.

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <string>

namespace {

constexpr const char *plugin_name = PLUGIN;

[[noreturn]] void fail(const std::string &what) {
  std::fprintf(stderr, "ERROR: cfpm loader: %s\n", what.c_str());
  std::exit(1);
}

std::string own_directory(const void *own_symbol) {
  Dl_info info{};
  if (dladdr(own_symbol, &info) == 0) fail("cannot find its own file");
  const std::string file = info.dli_fname;
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "." : file.substr(0, slash);
}

/// The host aborts on an error of one rank without flushing: written to a pipe, its message would be lost.
__attribute__((constructor)) void flush_every_line() { std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ); }

} // namespace

/// A member function of the host, mangled: it takes its object as first argument.
extern "C" void host_function(void *lammps) __asm__(HOST_FUNCTION);

extern "C" void host_function(void *lammps) {
  using Function = void (*)(void *);
  const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, HOST_FUNCTION));
  if (!next) fail("this process has no library of the host");
  next(lammps);

  const std::string file = own_directory(reinterpret_cast<const void *>(&host_function)) + "/" + plugin_name;
  void *plugin = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!plugin) fail(std::string("cannot load the plugin: ") + dlerror());
  const auto add_styles = reinterpret_cast<Function>(dlsym(plugin, "cfpm_register"));
  if (!add_styles) fail(file + " is not a cfpm plugin: it lacks the function cfpm_register");
  add_styles(lammps);
}
