// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/vec3.h"

namespace LAMMPS_NS {
class TriMesh;
}

namespace cfpm::liggghts {

/// Whether a sphere that moves on to the plane through the nearest point of a triangle passes the triangle by: it is
/// then somewhere beside it. centre: there, as seen by a mesh that rests [m].
bool passes_by(LAMMPS_NS::TriMesh &mesh, int triangle, const Vec3 &centre, double radius);

} // namespace cfpm::liggghts
