// SPDX-License-Identifier: GPL-2.0-or-later
// What a run tells to a program instead of a reader: the numbers of its contacts, a line of JSON for each setup.
#pragma once

#include "core/law/law_kind.h"
#include "core/method/method.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace cfpm {

/// The file that such lines are added to, in a deck whose runs are then cut to their setup; null in any other run.
inline const char *facts_file() {
  const char *const name = std::getenv("CFPM_FACTS");
  return name && *name ? name : nullptr;
}

/// A collision that was timed, of bodies i and j; at a wall j has no mass and no radius (0).
struct TimedCollision {
  double contact_time; ///< undamped [s]
  bool hertz;          ///< its spring; else linear
  double radius_i, radius_j, mass_i, mass_j;
};

namespace json {

/// null for what is no number.
inline std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline std::string string(const std::string &text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

inline std::string list(const std::vector<std::string> &items) {
  std::string text;
  for (const std::string &item : items) text += (text.empty() ? "" : ", ") + item;
  return "[" + text + "]";
}

inline std::string numbers(const Vec3 &v) { return list({number(v.x), number(v.y), number(v.z)}); }

} // namespace json

/// The methods that a law has, with onset as by default, and the nt = tc/dt from which each was measured to be right
/// for a use; null: it was not.
inline std::string facts_of_methods(LawKind law, bool damped_friction, double largest_restitution) {
  std::vector<std::string> items;
  const auto measured = [](double nt) { return nt == RightFrom::unmeasured ? "null" : json::number(nt); };
  for (const Method *m : Methods::table) {
    if (m->predicted && !m->predicts(law)) continue;
    const RightFrom &from = right_from(*m, damped_friction, begins_inside(*m, {}));
    double agitated = from.agitated;
    if (m == &PredictedImpulse::method)
      agitated = std::max(agitated, PredictedImpulse::keeps_energy_from(largest_restitution));
    items.push_back("{\"name\": " + json::string(m->name) + ", \"beds\": " + measured(from.beds) +
                    ", \"flows\": " + measured(from.flows) + ", \"agitated\": " + measured(agitated) + "}");
  }
  return json::list(items);
}

/// Of one kind of contact.
inline std::string facts_of_contact(const std::string &who, LawKind law, bool damped_friction,
                                    double largest_restitution, const std::vector<TimedCollision> &collisions) {
  std::vector<std::string> items;
  items.reserve(collisions.size());
  for (const TimedCollision &c : collisions)
    items.push_back("{\"tc\": " + json::number(c.contact_time) + ", \"hertz\": " + (c.hertz ? "true" : "false") +
                    ", \"radii\": " + json::list({json::number(c.radius_i), json::number(c.radius_j)}) +
                    ", \"masses\": " + json::list({json::number(c.mass_i), json::number(c.mass_j)}) + "}");
  return "{\"who\": " + json::string(who) + ", \"restitution\": " + json::number(largest_restitution) +
         ", \"collisions\": " + json::list(items) +
         ", \"methods\": " + facts_of_methods(law, damped_friction, largest_restitution) + "}";
}

/// What only the host knows of a setup, in the deck's units.
struct SetupFacts {
  std::string host, units;
  double particles = 0.0;
  double largest_speed = 0.0; ///< of the particles that are there
  Vec3 box;                   ///< its edges
  bool gravity_known = true;  ///< false: there may be some, with no particle to see it by
  Vec3 gravity;               ///< of all fixes gravity together
};

/// contacts: of TimeStepReport::facts(). Called by one rank; false where the file cannot be written.
inline bool add_facts(const char *file, const SetupFacts &setup, const std::string &contacts) {
  std::FILE *out = std::fopen(file, "a");
  if (!out) return false;
  const std::string line =
      "{\"host\": " + json::string(setup.host) + ", \"units\": " + json::string(setup.units) +
      ", \"particles\": " + json::number(setup.particles) +
      ", \"largest_speed\": " + json::number(setup.largest_speed) + ", \"box\": " + json::numbers(setup.box) +
      ", \"gravity\": " + (setup.gravity_known ? json::numbers(setup.gravity) : "null") + ", " + contacts + "}\n";
  const bool written = std::fputs(line.c_str(), out) >= 0;
  return std::fclose(out) == 0 && written;
}

} // namespace cfpm
