// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_check_timestep_gran_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"
#include "time_step_report.h"

#include "core/deck/finite_number.h"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

namespace cfpm::liggghts {

namespace {

enum Output { fraction_of_rayleigh_time, fraction_of_hertz_time, fraction_of_skin };

[[noreturn]] void fail(LAMMPS_NS::LAMMPS &lmp, char **arg, const std::string &what) {
  lmp.error->all(FLERR, (std::string("fix ") + arg[2] + " (id " + arg[0] + "): " + what).c_str());
  std::abort(); // not reached: error->all ends the process
}

TimestepCheck read(LAMMPS_NS::LAMMPS &lmp, int narg, char **arg) {
  int k = 3;
  if (narg > k && std::string(arg[k]) == "check_every_time") ++k;
  if (narg < k + 3) fail(lmp, arg, "expected [check_every_time] N fraction_rayleigh fraction_hertz");
  const auto fraction = [&](int of, const char *name) {
    const std::optional<double> value = finite_number(arg[of]);
    if (!value) fail(lmp, arg, std::string(name) + " is '" + arg[of] + "'; expected a number");
    return *value;
  };
  TimestepCheck check;
  check.of_rayleigh_time = fraction(k + 1, "fraction_rayleigh");
  check.of_hertz_time = fraction(k + 2, "fraction_hertz");
  for (k += 3; k < narg; k += 2) {
    const std::string keyword = arg[k];
    if (keyword != "warn" && keyword != "error" && keyword != "vmax")
      fail(lmp, arg, std::string("unknown keyword '") + arg[k] + "'; expected warn, error or vmax");
    if (k + 1 == narg) fail(lmp, arg, std::string("missing value after '") + arg[k] + "'");
    if (keyword == "vmax") continue; // the host's
    const std::string value = arg[k + 1];
    if (value != "yes" && value != "no")
      fail(lmp, arg, std::string(arg[k]) + " is '" + arg[k + 1] + "'; expected yes or no");
    (keyword == "warn" ? check.warns : check.stops) = value == "yes";
  }
  return check;
}

/// The same arguments for a fix of the host that says nothing.
class Quiet {
public:
  Quiet(int narg, char **arg) : all_(arg, arg + narg) {
    static char words[][6] = {"warn", "no", "error", "no"};
    for (char *word : words) all_.push_back(word);
  }
  int count() const { return static_cast<int>(all_.size()); }
  char **values() { return all_.data(); }

private:
  std::vector<char *> all_;
};

/// "time step is 12.3 % of the Rayleigh time; expected at most 10 % of it".
std::string too_large(double fraction, const char *whole, double limit, const std::string &of) {
  char text[200];
  std::snprintf(text, sizeof text, "time step is %.4g %% of the %s; expected at most %.4g %%", 100.0 * fraction, whole,
                100.0 * limit);
  return text + of;
}

} // namespace

FixCheckTimestepGranCfpm::FixCheckTimestepGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : FixCheckTimestepGranCfpm(lmp, narg, arg, read(*lmp, narg, arg)) {}

FixCheckTimestepGranCfpm::FixCheckTimestepGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg,
                                                   const TimestepCheck &check)
    : FixCheckTimestepGran(lmp, Quiet(narg, arg).count(), Quiet(narg, arg).values()), check_(check) {}

void FixCheckTimestepGranCfpm::init() {
  require_cfpm_pair(*lmp, (std::string("fix ") + style).c_str());
  FixCheckTimestepGran::init();
  told_ = false;
}

void FixCheckTimestepGranCfpm::end_of_step() {
  FixCheckTimestepGran::end_of_step();
  const auto &pair = static_cast<const PairGranCfpm &>(*force->pair);
  std::string wrong = pair.method().predicted ? exceeded_limits(pair) : exceeded_fractions();
  if (wrong.empty() && compute_vector(fraction_of_skin) > 1.0)
    wrong = "particles come together by more than the skin in a step; expected a smaller timestep or a larger skin in "
            "'neighbor'";
  if (wrong.empty()) return;
  const std::string what = std::string("fix ") + style + " (id " + id + "): " + wrong;
  if (check_.stops) error->all(FLERR, what.c_str());
  if (check_.warns && !told_ && comm->me == 0) error->warning(FLERR, what.c_str());
  told_ = true;
}

/// Of a conventional step, which the deck's fractions are meant for.
std::string FixCheckTimestepGranCfpm::exceeded_fractions() {
  const double rayleigh = compute_vector(fraction_of_rayleigh_time);
  const double hertz = compute_vector(fraction_of_hertz_time);
  if (rayleigh > check_.of_rayleigh_time) return too_large(rayleigh, "Rayleigh time", check_.of_rayleigh_time, "");
  if (hertz > check_.of_hertz_time) return too_large(hertz, "Hertz time", check_.of_hertz_time, "");
  return "";
}

/// Linear contacts last as long at any speed, and the report of the time step has them all, at the particles that there
/// are now. A Hertz contact is the shorter the faster it is: the host times it at the largest speeds there are.
std::string FixCheckTimestepGranCfpm::exceeded_limits(const PairGranCfpm &pair) {
  const LawKind law = pair.contact_model().law();
  const Method &method = pair.method();
  const double hertz = compute_vector(fraction_of_hertz_time);
  const double limit = limit_on_one_contact(method, law);
  if (law != LawKind::linear && hertz >= limit)
    return too_large(hertz, "Hertz time at the largest speeds", limit, std::string(" for predict ") + method.name);
  if (report_time_step(*lmp).too_large())
    return "time step too large for the predictor; see the nt and their limits above";
  return "";
}

} // namespace cfpm::liggghts
