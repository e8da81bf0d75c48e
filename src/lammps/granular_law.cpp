// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_law.h"

#include "core/deck/finite_number.h"

namespace cfpm::lammps {

MethodArguments take_granular_method(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                     std::vector<std::string> &words) {
  KeywordOptions options(words, 0, [&](const std::string &what) { lmp.error->all(FLERR, command + ": " + what); });
  // any name is known here, to be refused below; "-suffix cfpm" makes the same name of granular
  MethodArguments taken = take_method_arguments(options, owner, LawKind::linear, "", Command::suffixed);
  if (taken.automatic) taken.method = &AutoMethod::at_few_steps(LawKind::any);
  if (taken.method->predicted && (taken.method_given || owner == ContactOwner::pairs))
    options.fail(std::string("predictor '") + taken.method->name +
                 "' has no form for sub-models of granular; expected 'predict verlet'" +
                 (owner == ContactOwner::pairs ? " or 'predict auto'" : ""));
  if (taken.options.onset || taken.options.split != 0.0)
    options.fail("'onset' and 'split' go with predicted contacts, not with 'predict verlet'");
  return taken;
}

MethodArguments GranularLaw::read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command) {
  cutoff_ = words;
  const MethodArguments taken = take_granular_method(lmp, command(), ContactOwner::pairs, cutoff_);
  if (cutoff_.size() > 1 || (cutoff_.size() == 1 && !finite_number(cutoff_[0])))
    lmp.error->all(FLERR, std::string(command()) + ": unknown argument '" + cutoff_.back() +
                              "'; expected [cutoff] [predict verlet|auto], and sub-models in pair_coeff");
  return taken;
}

} // namespace cfpm::lammps
