// SPDX-License-Identifier: GPL-2.0-or-later
// What a host says of the time step at the start of a run.
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/method/method.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <string>

namespace cfpm {

struct ParticleSize {
  double radius; ///< [m]
  double mass;   ///< [kg]
};

struct SizeRange {
  ParticleSize smallest;
  ParticleSize largest;
  bool present() const { return largest.radius > 0.0; }
};

struct ContactTimes {
  double shortest = std::numeric_limits<double>::infinity(); ///< [s]
  double longest = 0.0;                                      ///< [s]

  void add(double tc) {
    shortest = std::min(shortest, tc);
    longest = std::max(longest, tc);
  }
};

/// What a surface wave takes around a sphere, by which the time step of a Hertz contact is commonly chosen [s].
/// young [Pa], poisson: of the material.
inline double rayleigh_time(const ParticleSize &size, double young, double poisson) {
  const double density = size.mass / (4.0 / 3.0 * pi * size.radius * size.radius * size.radius);
  const double shear_modulus = 0.5 * young / (1.0 + poisson);
  return pi * size.radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson + 0.8766);
}

/// The method's limit on dt/tc for one undamped contact of that law.
inline double limit_on_one_contact(const Method &method, LawKind law) {
  return law == LawKind::linear ? method.stable_below : method.stable_below * stiffest_hertz_contact_time();
}

/// The durations tc of the contacts of a run and the steps per contact nt = tc/dt, with the method's limit.
class TimeStepReport {
public:
  /// method, law: of the pair style; impact_speed: at which contacts of another law are timed.
  TimeStepReport(const Method &method, LawKind law, double dt, double impact_speed)
      : method_(&method), limit_(limit_on_one_contact(method, law)), dt_(dt), impact_speed_(impact_speed) {}

  void add(const std::string &who, const ContactTimes &times, const Method &method, LawKind law) {
    const double limit = limit_on_one_contact(method, law);
    nonlinear_ = nonlinear_ || law != LawKind::linear;
    rows_ += format("  %-18s tc = %.4g to %.4g, nt = tc/dt = %.4g to %.4g", who.c_str(), times.shortest, times.longest,
                    times.shortest / dt_, times.longest / dt_);
    if (times.shortest / method.bed_nt < advised_) {
      advised_ = times.shortest / method.bed_nt;
      advised_nt_ = method.bed_nt;
    }
    if (&method != method_ || limit != limit_) rows_ += format("; predict %s, ", method.name) + about(limit);
    rows_ += "\n";
    too_large_ = too_large_ || times.shortest / dt_ * limit <= 1.0;
  }

  /// Of the particles for which it is least, see rayleigh_time(); without it nothing is said.
  void set_rayleigh_time(double time) { rayleigh_time_ = time; }

  bool has_particles() const { return !rows_.empty(); }
  /// Whether one undamped contact is unstable with its method.
  bool too_large() const { return too_large_; }

  std::string text() const {
    std::string head = format("gran/cfpm: predict %s, dt = %.4g; ", method_->name, dt_) + about(limit_);
    if (nonlinear_) head += format("; Hertz: tc of an impact at speed %.4g, tc ~ speed^(-1/5)", impact_speed_);
    if (!has_particles()) return head + "\n  no particles yet\n";
    std::string advice = format("  packings come out right up to dt = %.4g, nt = %g", advised_, advised_nt_);
    if (nonlinear_) advice += " as measured with linear contacts";
    if (std::isfinite(rayleigh_time_))
      advice += format("; Rayleigh time of the smallest particle %.4g", rayleigh_time_);
    return head + "\n" + rows_ + advice + "\n";
  }

private:
  [[gnu::format(printf, 1, 2)]] static std::string format(const char *pattern, ...) {
    char line[256];
    va_list values;
    va_start(values, pattern);
    std::vsnprintf(line, sizeof line, pattern, values);
    va_end(values);
    return line;
  }
  static std::string about(double limit) {
    return std::isinf(limit) ? "no stability limit on one contact"
                             : format("one contact is stable for nt > %.4g", 1.0 / limit);
  }

  const Method *method_;
  double limit_;
  double dt_;
  double impact_speed_;
  double advised_ = std::numeric_limits<double>::infinity(); ///< [s]
  double advised_nt_ = 0.0;
  double rayleigh_time_ = std::numeric_limits<double>::infinity(); ///< [s]
  bool nonlinear_ = false;
  bool too_large_ = false;
  std::string rows_;
};

} // namespace cfpm
