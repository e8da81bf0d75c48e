// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_surface.h"

#include "host_versions.h"
#include "region_clearance.h"

#include "core/contact/parameter_cache.h"
#include "core/deck/finite_number.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

namespace cfpm::lammps {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double two_pi = 6.28318530717958647693;

/// A component of a vector by its number.
double &component(Vec3 &a, int dim) { return dim == 0 ? a.x : dim == 1 ? a.y : a.z; }
double component(const Vec3 &a, int dim) { return dim == 0 ? a.x : dim == 1 ? a.y : a.z; }

/// Of a plane or cylinder: along dim, swinging or at constant speed; for a cylinder also round the axis.
struct WallMotion {
  int dim = 2;
  double amplitude = 0.0;
  double period = 0.0; ///< 0 without wiggle
  double shear = 0.0;

  double displacement(double time) const {
    return period > 0.0 ? amplitude * (1.0 - std::cos(two_pi / period * time)) : 0.0;
  }
  double speed(double time) const {
    return period > 0.0 ? amplitude * two_pi / period * std::sin(two_pi / period * time) : shear;
  }
};

/// One or two planes with the particles between them.
class Planes : public WallSurface {
public:
  Planes(int dim, double low, double high, const WallMotion &motion)
      : dim_(dim), low_(low), high_(high), motion_(motion) {}

  int most_touches() const override { return 1; }
  void move_to(double time) override {
    shift_ = motion_.dim == dim_ ? motion_.displacement(time) : 0.0;
    velocity_ = {};
    component(velocity_, motion_.dim) = motion_.speed(time);
    if (shift_ == 0.0) {
      placement_ = {};
    } else {
      Vec3 shift{};
      component(shift, dim_) = shift_;
      placement_ = WallPlacement(shift);
    }
  }
  double clearance(const Vec3 &seen, double) override {
    const double x = component(seen, dim_);
    return std::min(std::fabs(x - low_), std::fabs(high_ - x));
  }
  double reach(double dt, double) const override { return dt * bound_of_norm(velocity_); }
  const std::vector<WallTouch> &touches(const double *x, double within) override {
    touches_.clear();
    const double above = x[dim_] - (low_ + shift_);
    const double below = high_ + shift_ - x[dim_];
    const bool at_low = above < below;
    const double distance = std::fabs(at_low ? above : below);
    if (distance > within) return touches_;
    Vec3 normal{};
    component(normal, dim_) = (at_low ? above : -below) < 0.0 ? -1.0 : 1.0;
    touches_.push_back({normal, distance, flat_wall, velocity_, at_low ? 0 : 1});
    return touches_;
  }

private:
  int dim_;
  double low_, high_;
  WallMotion motion_;
  double shift_ = 0.0;
  Vec3 velocity_{};
  std::vector<WallTouch> touches_;
};

/// A cylinder around the z axis with the particles inside.
class Cylinder : public WallSurface {
public:
  Cylinder(double radius, const WallMotion &motion) : radius_(radius), motion_(motion) {}

  int most_touches() const override { return 1; }
  void move_to(double time) override { speed_ = motion_.speed(time); }
  double clearance(const Vec3 &seen, double) override {
    return std::fabs(radius_ - std::sqrt(seen.x * seen.x + seen.y * seen.y));
  }
  double reach(double, double) const override { return 0.0; } // it moves along itself
  const std::vector<WallTouch> &touches(const double *x, double within) override {
    touches_.clear();
    const double from_axis = std::sqrt(x[0] * x[0] + x[1] * x[1]);
    const double gap = radius_ - from_axis;
    if (std::fabs(gap) > within || from_axis == 0.0) return touches_;
    const Vec3 outwards = (1.0 / from_axis) * Vec3{x[0], x[1], 0.0};
    const Vec3 velocity = motion_.dim == 2 ? Vec3{0.0, 0.0, speed_} : speed_ * Vec3{outwards.y, -outwards.x, 0.0};
    // of its two curvatures 1/R and 0 the mean counts
    const bool inside = gap > 0.0;
    touches_.push_back(
        {inside ? -outwards : outwards, std::fabs(gap), inside ? -2.0 * radius_ : 2.0 * radius_, velocity, 0});
    return touches_;
  }

private:
  double radius_;
  WallMotion motion_;
  double speed_ = 0.0;
  std::vector<WallTouch> touches_;
};

/// The surface of a region of the host, at rest or moving as it prescribes.
class RegionSurface final : public WallSurface {
public:
  RegionSurface(LAMMPS_NS::LAMMPS &lmp, std::string command, std::string id)
      : lmp_(lmp), command_(std::move(command)), id_(std::move(id)), region_(find()) {}

  int most_touches() const override { return region_->tmax; }
  void init() override { region_ = find(); }
  void move_to(double) override {
    region_ = find(); // the deck may have deleted it before a "run" without setup
    moves_ = region_->dynamic_check() != 0;
    if (moves_) {
      region_->prematch();
      region_->set_velocity();
    }
    clearance_.look_at(*region_, *lmp_.domain);
    placement_ = clearance_.placement();
  }
  bool knows_clearance() const override { return clearance_.is_known(); }
  double clearance(const Vec3 &seen, double radius) override { return clearance_.at(seen, radius); }
  /// Its velocity is known where it has been found only: a radius is far more than it moves in a step.
  double reach(double, double radius) const override { return moves_ ? radius : 0.0; }
  const std::vector<WallTouch> &touches(const double *x, double within) override {
    touches_.clear();
    if (!region_->match(x[0], x[1], x[2])) return touches_;
    const int count = region_->surface(x[0], x[1], x[2], within);
    for (int k = 0; k < count; ++k) {
      const auto &c = region_->contact[k];
      double velocity[3] = {};
      double centre[3] = {x[0], x[1], x[2]};
      if (moves_) region_->velocity_contact(velocity, centre, k);
      const Vec3 normal = (1.0 / c.r) * Vec3{c.delx, c.dely, c.delz};
      double radius = c.radius;
      if (radius == 0.0) radius = flat_wall;
      touches_.push_back({normal, c.r, radius, vec3(velocity), c.iwall});
    }
    return touches_;
  }
  bool is_near(const Vec3 &x, double within) override {
    return region_->match(x.x, x.y, x.z) && region_->surface(x.x, x.y, x.z, within) > 0;
  }

private:
  LAMMPS_NS::Region *find() const {
    LAMMPS_NS::Region *found = find_region(*lmp_.domain, id_);
    if (!found) lmp_.error->all(FLERR, command_ + ": region '" + id_ + "' does not exist");
    return found;
  }

  LAMMPS_NS::LAMMPS &lmp_;
  std::string command_;
  std::string id_;
  LAMMPS_NS::Region *region_;
  bool moves_ = false;
  RegionClearance clearance_;
  std::vector<WallTouch> touches_;
};

/// Words read one after the other.
class Words {
public:
  Words(LAMMPS_NS::LAMMPS &lmp, const std::string &command, const std::vector<std::string> &words)
      : lmp_(lmp), command_(command), words_(words) {}

  [[noreturn]] void fail(const std::string &what) const {
    lmp_.error->all(FLERR, command_ + ": " + what);
    std::abort(); // not reached
  }
  bool done() const { return at_ == words_.size(); }
  std::string next(const std::string &expected) {
    if (done()) fail("missing value; expected " + expected);
    return words_[at_++];
  }
  double number(const std::string &expected) {
    const std::string word = next(expected);
    const std::optional<double> value = finite_number(word);
    if (!value) fail("found '" + word + "'; expected " + expected);
    return *value;
  }
  double positive_number(const std::string &expected) {
    const double value = number(expected);
    if (!(value > 0.0)) fail("found '" + words_[at_ - 1] + "'; expected " + expected);
    return value;
  }
  double number_or(double if_null, const std::string &expected) {
    if (!done() && words_[at_] == "NULL") return ++at_, if_null;
    return number(expected + " or NULL");
  }
  int dimension(const std::string &expected) {
    const std::string word = next(expected);
    if (word != "x" && word != "y" && word != "z") fail("found '" + word + "'; expected " + expected);
    return word[0] - 'x';
  }

private:
  LAMMPS_NS::LAMMPS &lmp_;
  const std::string &command_;
  const std::vector<std::string> &words_;
  std::size_t at_ = 0;
};

} // namespace

std::unique_ptr<WallSurface> make_wall_surface(LAMMPS_NS::LAMMPS &lmp, const std::string &command,
                                               const std::vector<std::string> &words) {
  Words in(lmp, command, words);
  const std::string walls = "xplane lo hi, yplane lo hi, zplane lo hi, zcylinder radius or region ID";
  const std::string shape = in.next(walls);
  if (shape == "region") {
    auto surface = std::make_unique<RegionSurface>(lmp, command, in.next("the ID of a region"));
    if (!in.done()) in.fail("unknown argument '" + in.next("") + "' behind a region, whose motion is its own");
    return surface;
  }
  const bool cylinder = shape == "zcylinder";
  const bool plane = shape == "xplane" || shape == "yplane" || shape == "zplane";
  if (!cylinder && !plane) in.fail("unknown wall '" + shape + "'; expected " + walls);
  const int dim = plane ? shape[0] - 'x' : 2;
  const double first =
      cylinder ? in.positive_number("a positive radius of the cylinder") : in.number_or(-never, "a lower position");
  const double second = cylinder ? 0.0 : in.number_or(never, "an upper position");
  if (plane && first > second && lmp.comm->me == 0)
    lmp.error->warning(FLERR, command + ": the lower position " + words[1] + " is above the upper one " + words[2] +
                                  "; as in fix wall/gran, particles then meet the farther of the two planes only");

  const int *const periodic = lmp.domain->periodicity;
  if (cylinder ? periodic[0] || periodic[1] : periodic[dim] != 0)
    in.fail("wall '" + shape + "' in a periodic dimension; expected a boundary that is not periodic");
  WallMotion motion;
  motion.dim = -1;
  while (!in.done()) {
    const std::string keyword = in.next("");
    if (keyword != "wiggle" && keyword != "shear")
      in.fail("unknown argument '" + keyword + "'; expected 'wiggle dim amplitude period' or 'shear dim v'");
    if (motion.dim >= 0) in.fail("a second motion '" + keyword + "'; expected wiggle or shear once");
    motion.dim = in.dimension("x, y or z after " + keyword);
    if (keyword == "wiggle") {
      motion.amplitude = in.number("an amplitude");
      motion.period = in.positive_number("a positive period");
      if (cylinder && motion.dim != 2) in.fail("wiggle of a zcylinder; expected dimension z");
    } else {
      motion.shear = in.number("a speed");
      if (plane && motion.dim == dim) in.fail("shear along the normal of the wall; expected another dimension");
    }
  }
  if (motion.dim < 0) motion.dim = 2;
  if (cylinder) return std::make_unique<Cylinder>(first, motion);
  return std::make_unique<Planes>(dim, first, second, motion);
}

} // namespace cfpm::lammps
