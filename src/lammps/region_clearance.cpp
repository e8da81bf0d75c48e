// SPDX-License-Identifier: GPL-2.0-or-later
#include "region_clearance.h"

#include "host_versions.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace cfpm::lammps {

namespace {

using LAMMPS_NS::Region;

/// Shapes of the host that give, of a place inside or outside, the distance of the nearest point of each of their
/// faces, as its sources show.
constexpr std::array<std::string_view, 5> known = {"block", "cone", "cylinder", "plane", "sphere"};

/// What the host shares with its regions alone: the point and the axis, of length 1, that they turn about.
struct Turning : Region {
  static Vec3 point_of(const Region &region) { return vec3(region.*(&Turning::point)); }
  static Vec3 axis_of(const Region &region) { return vec3(region.*(&Turning::runit)); }
};

/// Of a union or an intersection the shapes that it is made of, of a shape itself; false if one is not known. Surfaces
/// of a union are surfaces of its shapes, so that what is clear of these is clear of it.
bool add_shapes(Region &region, LAMMPS_NS::Domain &domain, std::vector<Region *> &shapes) {
  const std::string_view style = region.style;
  if (style == "union" || style == "intersect") {
    const std::vector<Region *> parts = parts_of(region, domain);
    return std::all_of(parts.begin(), parts.end(),
                       [&](Region *part) { return part->dynamic == 0 && add_shapes(*part, domain, shapes); });
  }
  shapes.push_back(&region);
  return region.varshape == 0 && std::find(known.begin(), known.end(), style) != known.end();
}

WallPlacement placement_of(const Region &shape) {
  const Vec3 shift{shape.dx, shape.dy, shape.dz};
  if (!shape.rotateflag) return shape.moveflag ? WallPlacement(shift) : WallPlacement();
  return {Turning::point_of(shape), Turning::axis_of(shape), shape.theta, shift};
}

double distance_to(Region &shape, const Vec3 &seen, double within) {
  double nearest = within;
  const auto look = [&](int count) {
    for (int k = 0; k < count; ++k) nearest = std::min(nearest, shape.contact[k].r);
  };
  double place[3] = {seen.x, seen.y, seen.z};
  look(shape.surface_interior(place, within)); // of a place outside none
  look(shape.surface_exterior(place, within)); // of one inside none
  return nearest;
}

} // namespace

void RegionClearance::look_at(Region &region, LAMMPS_NS::Domain &domain) {
  shapes_.clear();
  if (!add_shapes(region, domain, shapes_)) shapes_.clear();
  placement_ = shapes_.size() == 1 ? placement_of(*shapes_.front()) : WallPlacement();
}

double RegionClearance::at(const Vec3 &seen, double radius) const {
  if (shapes_.empty()) return 0.0;
  // From the axis of a cone or cylinder and the centre of a sphere the host finds no surface: of three places that are
  // not on one line, one is elsewhere.
  const double aside = 1e-5 * radius;
  const Vec3 places[] = {seen, seen + aside * Vec3{1.0, 1.0, 1.0}, seen + aside * Vec3{1.0, 0.0, -1.0}};
  double nearest = 100.0 * radius; // as far as it is looked
  for (Region *shape : shapes_)
    for (const Vec3 &place : places) nearest = std::min(nearest, distance_to(*shape, place, nearest));
  return std::max(0.0, nearest - 2.0 * aside); // sqrt(3) and less
}

} // namespace cfpm::lammps
