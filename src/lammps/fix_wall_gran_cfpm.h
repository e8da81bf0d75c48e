// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"
#include "predicted_contacts.h"
#include "wall_history.h"
#include "wall_law.h"
#include "wall_surface.h"

#include "core/step/clear_places.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::lammps {

class PairGranCfpm;

/// fix wall/gran/cfpm: predicted contacts of particles with planes, a cylinder or a region of the host. Where the pair
/// style may come to leave forces of one instant by its own choice, and where it is the host that reads the law, the
/// wall has the host's wall within and hands over to it while pairs are not predicted; there it still tells a region
/// of the host's which particles cannot touch it.
class FixWallGranCfpm : public LAMMPS_NS::Fix {
public:
  /// host_wall: of the same arguments, or null.
  FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, WallArguments wall,
                  std::unique_ptr<LAMMPS_NS::Fix> host_wall);
  FixWallGranCfpm(const FixWallGranCfpm &) = delete;
  FixWallGranCfpm &operator=(const FixWallGranCfpm &) = delete;
  ~FixWallGranCfpm() override;

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  void post_run() override;

  const WallLaw &law() const { return *arguments_.law; }
  /// In force beside that pair style, see method_at_wall().
  const Method &method_beside(const PairGranCfpm &pair) const;
  bool is_predicted_beside(const PairGranCfpm &pair) const { return !host_wall_ || method_beside(pair).predicted; }

  /// Why it has no budget of energy beside that pair style, as text up to what is expected, or "".
  std::string reason_against_energy(const PairGranCfpm &pair) const;

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
  void write_restart(FILE *file) override;
  void restart(char *state) override;
  void reset_dt() override;

private:
  void follow(const PairGranCfpm *pair);
  void let_host_act(int vflag);
  void move_surface();
  void make_history(const Method &method);
  int own_exchange() const { return static_cast<int>(history_->values_per_particle()); }
  template <class Add> void add_forces(const Add &add);
  void add_predicted_forces();
  void tell_contacts(const StepState &step);
  void add_energies(const StepState &step);
  void add_energies_of_host(const Particles &particles, const StepState &step, const std::vector<Vec3> &before);
  bool find_contacts(int i, double within, const Particles &particles, const StepState &step);

  std::string command_;
  WallArguments arguments_;
  std::unique_ptr<LAMMPS_NS::Fix> host_wall_; ///< null where it is not needed
  bool host_acts_ = false;                    ///< in place of what follows
  bool spares_host_;                          ///< from asking its region for particles that cannot touch it
  std::unique_ptr<WallSurface> surface_;
  std::unique_ptr<WallHistory> history_;
  ClearPlaces clear_places_; ///< of particles without contacts, as seen from surface_, whichever of the two acts
  std::unique_ptr<PredictedContacts> contacts_;
  std::unique_ptr<PredictedContacts> of_host_; ///< tells energies of the host's, null before it does
  int law_history_;                            ///< values of a contact before those of its spring
  bool onset_ = false;                         ///< contacts begin inside a step
  std::vector<WallContact> touching_;          ///< of one step, kept for its memory
  std::vector<Vec3> velocities_;               ///< of the wall there, where energies are told
  std::vector<Vec3> places_;                   ///< of the wall there, where contacts are told
  std::vector<int> surfaces_;                  ///< that one particle touches, likewise
  LAMMPS_NS::bigint start_;                    ///< step at which the wall begins to move
};

/// For the host's table of styles: of wall/gran/cfpm, and of what "-suffix cfpm" makes of fix wall/gran and fix
/// wall/gran/region, whose contact is written hooke, hooke/history, hertz/history or granular. With a "predict
/// none" of its own a plane or a cylinder is the host's own fix wall/gran, also by name.
LAMMPS_NS::Fix *create_wall(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

} // namespace cfpm::lammps
