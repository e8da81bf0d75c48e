// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded into a stock host. Stands in front of the function HOST_FUNCTION, which the host calls when
// it has created its styles, at its start and again for the command "clear", lets the host do its work and
// then loads the plugin PLUGIN that lies beside this object. Knows no type of the host and exports nothing
// else but MPI_Abort, so it is harmless in any other process that inherits the preload.
//
// A launcher names its own process in the environment as CFPM_LAUNCHED. That process is meant to be the host, so
// here, and in no other, it is an error if the plugin does not come in: the run would be a stock one.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <unistd.h>

/// A member function of the host, mangled: it takes its object as first argument.
extern "C" void host_function(void *lammps) __asm__(HOST_FUNCTION);

namespace {

constexpr const char *plugin_name = PLUGIN;

bool host_function_was_called = false;
pid_t launched_process = 0; // 0 unless this is the one that a launcher means

[[noreturn]] void fail(const std::string &what) {
  std::fprintf(stderr, "ERROR: cfpm loader: %s\n", what.c_str());
  std::exit(1);
}

/// The file that a path leads to, behind all symbolic links.
std::string real_path(const std::string &path) {
  char *found = realpath(path.c_str(), nullptr);
  if (!found) return path;
  std::string result = found;
  std::free(found);
  return result;
}

/// The path that this object was loaded by. A launcher whose folder has a name that LD_PRELOAD cannot take opens the
/// object and gives the path of the descriptor instead.
std::string own_path() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void *>(&host_function), &info) == 0) fail("cannot find its own file");
  return info.dli_fname;
}

/// Where the plugin lies too. Kept from the start: a descriptor is closed in time, a relative path may lead elsewhere.
std::string &own_folder() {
  static std::string folder;
  return folder;
}

/// An object loaded from a file in any folder: dlopen would replace $LIB and the like in a path, so such a file is
/// opened first and named by its descriptor, which then stays open.
void *load(const std::string &file) {
  if (file.find('$') == std::string::npos) return dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("cannot read the plugin " + file);
  return dlopen(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), RTLD_NOW | RTLD_LOCAL);
}

/// Takes back what the launcher did to the environment: programs that the host starts are not meant.
void clean_environment() {
  unsetenv("CFPM_LAUNCHED");
  const char *preloads = std::getenv("LD_PRELOAD");
  const std::string all = preloads ? preloads : "";
  const std::size_t colon = all.find(':'); // the launcher puts its own in front
  if (colon == std::string::npos)
    unsetenv("LD_PRELOAD");
  else
    setenv("LD_PRELOAD", all.substr(colon + 1).c_str(), 1);
}

/// At the end of the process that was to be the host. A failure has been told already, by the host.
void check_that_it_was_the_host(int status, void *) {
  if (status != 0 || host_function_was_called || getpid() != launched_process) return;
  std::fflush(nullptr);
  std::fprintf(stderr, "ERROR: cfpm loader: %s ended without a call of %s, so this was a run without the plugin\n",
               real_path("/proc/self/exe").c_str(), HOST_FUNCTION);
  std::_Exit(1);
}

/// LAMMPS prints its help before it calls the function.
bool asks_for_help(int count, char **arguments) {
  return std::any_of(arguments, arguments + count,
                     [](const std::string &word) { return word == "-h" || word == "-help"; });
}

/// glibc calls it with the arguments of main().
__attribute__((constructor)) void start(int argument_count, char **arguments) {
  // The host aborts on an error of one rank without flushing: written to a pipe, its message would be lost.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);

  const std::string path = own_path();
  const std::string file = real_path(path);
  const std::size_t slash = file.rfind('/');
  own_folder() = slash == std::string::npos ? "." : file.substr(0, slash);

  const char *launched = std::getenv("CFPM_LAUNCHED");
  if (!launched || launched != std::to_string(getpid())) return;
  launched_process = getpid();
  clean_environment();
  const std::string by_descriptor = "/proc/self/fd/";
  if (path.rfind(by_descriptor, 0) == 0) fcntl(std::atoi(path.c_str() + by_descriptor.size()), F_SETFD, FD_CLOEXEC);
  if (!dlsym(RTLD_NEXT, HOST_FUNCTION))
    fail("the plugin cannot come into " + real_path("/proc/self/exe") + ": no shared library of it has the function " +
         HOST_FUNCTION + " (expected the host itself, linked to its library; a script that starts it cannot be used)");
  if (!asks_for_help(argument_count, arguments)) on_exit(check_that_it_was_the_host, nullptr);
}

} // namespace

/// What Open MPI 5 gets from a rank that aborts at once is lost now and then, and with it the host's message of an
/// error on one rank. comm: of whatever type the MPI has, handed on as it came.
extern "C" int MPI_Abort(void *comm, int code) { // NOLINT(readability-identifier-naming)
  std::fflush(nullptr);
  constexpr useconds_t time_to_read_it = 200000;
  usleep(time_to_read_it);
  using Function = int (*)(void *, int);
  const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "MPI_Abort"));
  if (!next) std::_Exit(code);
  return next(comm, code);
}

extern "C" void host_function(void *lammps) {
  using Function = void (*)(void *);
  const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, HOST_FUNCTION));
  if (!next) fail("this process has no library of the host");
  next(lammps);
  host_function_was_called = true;

  static void *const plugin = load(own_folder() + "/" + plugin_name);
  if (!plugin) fail(std::string("cannot load the plugin: ") + dlerror());
  const auto add_styles = reinterpret_cast<Function>(dlsym(plugin, "cfpm_register"));
  if (!add_styles)
    fail(own_folder() + "/" + plugin_name + " is not a cfpm plugin: it lacks the function cfpm_register");
  add_styles(lammps);
}
