// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include <vector>

namespace cfpm::lammps {

/// An internal fix of pair_style gran/cfpm with "split c": what of a particle goes with it from rank to rank and into
/// restart files where its mass is divided among its contacts.
class MassParts : public LAMMPS_NS::Fix {
public:
  static constexpr const char *name = "CFPM_MASS_PARTS"; ///< of the style, and its only ID

  MassParts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);
  MassParts(const MassParts &) = delete;
  MassParts &operator=(const MassParts &) = delete;
  ~MassParts() override;

  /// The fix, or nullptr.
  static MassParts *find(LAMMPS_NS::Modify &modify);

  double *parts() { return parts_.data(); }       ///< that a mass is divided into; at least 1
  double *contacts() { return contacts_.data(); } ///< counted in the last step

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
  std::vector<double> parts_;
  std::vector<double> contacts_;
};

} // namespace cfpm::lammps
