// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "wall_placement.h"

#include "core/numbers/vec3.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

/// Where a sphere touches a wall, or is near it.
struct WallTouch {
  Vec3 normal;     ///< unit vector to the sphere
  double distance; ///< of its centre [m]
  double radius;   ///< of curvature that counts in Hertz' law, see ContactPartners [m]
  Vec3 velocity;   ///< of the wall there [m/s]
  int surface;     ///< which one of the wall's
};

/// The shape and motion of a wall, as the host's fix wall/gran describes them.
class WallSurface {
public:
  virtual ~WallSurface() = default;
  /// Surfaces that one sphere can touch at most.
  virtual int most_touches() const = 0;
  /// Before a run.
  virtual void init() {}
  /// Before the spheres of a step are asked for; time since the fix was defined [s].
  virtual void move_to(double time) = 0;
  /// A place at x as it is seen from the wall, which may have moved; after move_to() [m].
  Vec3 seen(const Vec3 &x) const { return placement_.seen(x); }
  /// Whether clearance() ever says more than 0 in this step.
  virtual bool knows_clearance() const { return true; }
  /// How far that place is from the nearest point of the wall, or less, down to 0; radius: of a sphere there [m].
  virtual double clearance(const Vec3 &seen, double radius) = 0;
  /// How far it may come in a time dt towards a sphere of this radius [m].
  virtual double reach(double dt, double radius) const = 0;
  /// Of a sphere at x, nearer than its radius or what else is asked for [m]; valid until the next call.
  virtual const std::vector<WallTouch> &touches(const double *x, double within) = 0;
  /// Whether it is that near a place to which a sphere has moved on that it touches one of its surfaces there if they
  /// are flat; leaves what touches() has given.
  virtual bool is_near(const Vec3 &, double /*within*/) { return true; }

protected:
  WallPlacement placement_;
};

/// words: "xplane lo hi", "yplane lo hi", "zplane lo hi", "zcylinder R" or "region ID", then "wiggle dim
/// amplitude period" or "shear dim v". Stops the run with a message on anything else.
std::unique_ptr<WallSurface> make_wall_surface(LAMMPS_NS::LAMMPS &lmp, const std::string &command,
                                               const std::vector<std::string> &words);

} // namespace cfpm::lammps
