// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_arguments.h"

#include "host.h"

#include "core/deck/finite_number.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace cfpm::lammps {

namespace {

class Reader {
public:
  Reader(LAMMPS_NS::LAMMPS &lmp, const std::string &command, std::vector<std::string> arguments)
      : lmp_(lmp), command_(command), arguments_(std::move(arguments)),
        words_(arguments_, 0, [this](const std::string &what) { fail(what); }) {}

  [[noreturn]] void fail(const std::string &what) const {
    lmp_.error->all(FLERR, command_ + ": " + what);
    std::abort(); // not reached
  }

  MethodArguments take_method(ContactOwner owner, LawKind law, Command made) {
    return take_method_arguments(words_, owner, law, law == LawKind::linear ? "hooke" : "hertz", made);
  }

  /// The k-th argument as a number that is not negative; NULL where a default is allowed.
  double number(std::size_t k, const char *name, const double *if_null = nullptr) const {
    const std::string &text = arguments_[k];
    if (if_null && text == "NULL") return *if_null;
    const std::optional<double> value = finite_number(text);
    if (!value || *value < 0.0)
      fail(std::string(name) + " is '" + text + "'; expected a number that is not negative" +
           (if_null ? " or NULL" : ""));
    return *value;
  }

  const std::vector<std::string> &arguments() const { return arguments_; }

private:
  LAMMPS_NS::LAMMPS &lmp_;
  const std::string &command_;
  std::vector<std::string> arguments_;
  KeywordOptions words_; ///< of these
};

} // namespace

ContactArguments read_contact_arguments(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                        const std::vector<std::string> &words, Command made) {
  Reader reader(lmp, command, words);
  const std::string expected =
      "; expected hooke|hooke/nohistory|hertz Kn Kt gamma_n gamma_t xmu dampflag [limit_damping] [predict "
      "exact|trapezoid|rk2|rk4|impulse|verlet|auto]";
  const std::string model = words.empty() ? "" : words[0];
  if (model != "hooke" && model != "hooke/nohistory" && model != "hertz")
    reader.fail((words.empty() ? "no contact model" : "unknown contact model '" + model + "'") + expected);
  ContactArguments contact;
  contact.hertz = model == "hertz";
  contact.history = model != "hooke/nohistory";
  static_cast<MethodArguments &>(contact) = reader.take_method(owner, contact.law(), made);

  const std::vector<std::string> &left = reader.arguments();
  if (left.size() < 7) reader.fail("found " + std::to_string(left.size()) + " arguments of 7" + expected);
  contact.kn = reader.number(1, "Kn");
  const double kt = contact.kn * 2.0 / 7.0;
  contact.kt = reader.number(2, "Kt", &kt);
  contact.gamma_n = reader.number(3, "gamma_n");
  const double gamma_t = 0.5 * contact.gamma_n;
  contact.gamma_t = reader.number(4, "gamma_t", &gamma_t);
  contact.xmu = reader.number(5, "xmu");
  if (left[6] != "0" && left[6] != "1") reader.fail("dampflag is '" + left[6] + "'; expected 0 or 1");
  if (left[6] == "0") contact.gamma_t = 0.0;
  contact.limit_damping = left.size() > 7 && left[7] == "limit_damping";
  const auto end = left.begin() + (contact.limit_damping ? 8 : 7);
  contact.for_host_style.assign(left.begin() + 1, end);
  if (!contact.history) {
    contact.kt = 0.0;
    contact.for_host_style[1] = "0"; // of a spring that only predicted contacts have, so that they have a history
  }
  contact.rest.assign(end, left.end());
  return contact;
}

} // namespace cfpm::lammps
