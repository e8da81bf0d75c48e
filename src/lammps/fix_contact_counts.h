// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include <vector>

namespace cfpm::lammps {

/// An internal fix of pair_style gran/cfpm where impulses are given: how many contacts a particle has, which goes with
/// it from rank to rank and into restart files.
class FixContactCounts : public LAMMPS_NS::Fix {
public:
  static constexpr const char *name = "CFPM_CONTACTS"; ///< of the style, and its only ID

  FixContactCounts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);
  FixContactCounts(const FixContactCounts &) = delete;
  FixContactCounts &operator=(const FixContactCounts &) = delete;
  ~FixContactCounts() override;

  /// The fix, or nullptr.
  static FixContactCounts *find(LAMMPS_NS::Modify &modify);

  double *before() { return before_.data(); } ///< in the step before
  double *now() { return now_.data(); }       ///< as they are counted

  int setmask() override { return 0; }
  double memory_usage() override;
  void grow_arrays(int particles) override;
  void copy_arrays(int from, int to, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;

private:
  // of the particles of this rank and of their neighbours on others
  std::vector<double> before_;
  std::vector<double> now_;
};

} // namespace cfpm::lammps
