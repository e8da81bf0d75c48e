// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_touch.h"

#include "host_contact_models.h"

#include "core/step/touch.h"

#include "tri_mesh.h"

namespace cfpm::liggghts {

bool passes_by(LAMMPS_NS::TriMesh &mesh, int triangle, const Vec3 &centre, double radius) {
  double place[3] = {centre.x, centre.y, centre.z};
  double delta[3];
  double bary[3];
  int side = 0;
  const double gap = mesh.resolveTriSphereContactBary(0, triangle, radius, place, delta, bary, side, true);
  // beside an edge that another triangle shares, the host leaves the surface to that one and gives a distance
  // that no mesh has
  return gap > gap_of_flat_walls * radius && gap < 0.5 * LARGE_TRIMESH;
}

} // namespace cfpm::liggghts
