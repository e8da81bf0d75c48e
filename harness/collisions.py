# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene of single collisions far apart, for a host to be compared with the reference scheme step by step: pairs of
spheres head-on and oblique, with spin, of equal and unequal size; spheres on the floor, on a tilted and on a moving
wall. SI units.

Tolerance. The two differ by the rounding of coordinates up to 0.5 m, delta = 2^-54, in every overlap, some dozen
times a step with random signs. A force error k delta in each of the N = 20 steps of a contact changes the velocity by
N^(1/2) (k delta/m*) (tc/N), relative to the impact speed v = (pi/tc) d_max that is pi N^(-1/2) delta/d_max. With
d_max = 7e-4 m and 12^(1/2) roundings: 2e-13. A Hertz contact at its stiffest is 1.6 times as stiff as Eq. 17 makes
of its duration: 3e-13. 1e-12 is three times that.
"""

from math import sqrt

import numpy as np

from harness.spheres import Plane, Sphere, write_data

DT = 1.0e-4
STEPS = 100
GRAVITY = (0.0, 0.0, -9.81)
SPEED = 1.0  # of impact, about
TOLERANCE = 1.0e-12

# a tilted wall at rest, and one that moves; their rectangles reach 0.1 m to every side
TILTED = Plane((-0.3, 0.0, 0.1), (0.6, 0.0, 0.8))
MOVING = Plane((-0.3, 0.3, 0.1), (0.0, -0.6, 0.8), (0.05, 0.1, 0.3))
SEAM = (0.8 / 2**0.5, -1.0 / 2**0.5, -0.6 / 2**0.5)  # in the plane of the tilted wall, normal to its diagonal
FLOOR = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def along(a, b):
    return np.asarray(a) + np.asarray(b)


def pair(centre, axis, gap, first, second, offset=(0.0, 0.0, 0.0), va=(0.0, 0.0, 0.0), vb=(0.0, 0.0, 0.0), **spins):
    """Two spheres that approach along axis (unit) with the surfaces gap apart. first, second: keywords of Sphere."""
    a, b = Sphere(centre, **first), Sphere(centre, **second)
    distance = a.radius + b.radius + gap
    along_axis, offset = np.asarray(axis), np.asarray(offset)
    separation = along_axis * sqrt(distance**2 - offset @ offset) + offset  # offset is normal to axis
    a.x = tuple(along(centre, -0.5 * separation))
    b.x = tuple(along(centre, 0.5 * separation))
    a.v, b.v = tuple(along(va, 0.5 * SPEED * along_axis)), tuple(along(vb, -0.5 * SPEED * along_axis))
    a.omega, b.omega = spins.get("wa", a.omega), spins.get("wb", b.omega)
    return [a, b]


def on_wall(wall, gap, shift=(0.0, 0.0, 0.0), slip=(0.0, 0.0, 0.0), omega=(0.0, 0.0, 0.0), **kind):
    """A sphere that approaches a wall. shift, slip: in the plane of the wall."""
    sphere = Sphere((0.0, 0.0, 0.0), omega=omega, **kind)
    n = np.asarray(wall.normal)
    sphere.x = tuple(along(along(wall.x, shift), (sphere.radius + gap) * n))
    sphere.v = tuple(along(along(wall.v, slip), -SPEED * n))
    return [sphere, wall]


SMALL = {"radius": 0.015, "density": 2500.0, "type": 2}
CASES = {
    "head_on": pair((0.1, -0.3, 0.3), (1 / 3, 2 / 3, 2 / 3), 3e-4, {}, {}),
    "head_on_unequal": pair((0.1, -0.2, 0.3), (2 / 3, 1 / 3, -2 / 3), 3e-4, {}, SMALL),
    "touching_at_start": pair((0.1, -0.1, 0.3), (0.6, 0.8, 0.0), -2e-4, {}, SMALL, wa=(3.0, 5.0, -7.0)),
    # a small impact parameter sticks, spin beyond Coulomb's limit slides
    "oblique_sticking": pair((0.1, 0.0, 0.3), (1.0, 0.0, 0.0), 3e-4, {}, {}, offset=(0.0, 0.003, -0.002)),
    "oblique_sliding": pair(
        (0.1, 0.1, 0.3),
        (0.0, 1.0, 0.0),
        3e-4,
        {},
        {},
        offset=(0.02, 0.0, 0.015),
        wa=(60.0, 0.0, -90.0),
        wb=(40.0, 9.0, -80.0),
    ),
    "oblique_unequal": pair(
        (0.1, 0.2, 0.3),
        (0.0, 0.0, 1.0),
        3e-4,
        SMALL,
        {},
        offset=(0.01, -0.005, 0.0),
        wa=(10.0, -70.0, 30.0),
        vb=(0.3, 0.0, 0.1),
    ),
    "floor_head_on": on_wall(FLOOR, 3e-4, shift=(0.1, -0.3, 0.0)),
    "floor_sticking": on_wall(FLOOR, 3e-4, shift=(0.1, -0.2, 0.0), slip=(0.05, 0.02, 0.0), omega=(0.0, 1.0, 2.0)),
    "floor_sliding": on_wall(
        FLOOR, 3e-4, shift=(0.1, 0.0, 0.0), slip=(0.9, -0.6, 0.0), omega=(-50.0, 30.0, 9.0), **SMALL
    ),
    "floor_touching_at_start": on_wall(FLOOR, -2e-4, shift=(0.1, 0.2, 0.0), slip=(0.1, 0.2, 0.0)),
    "mesh_head_on": on_wall(TILTED, 3e-4, shift=(0.04, -0.06, -0.03)),
    "mesh_sticking": on_wall(TILTED, 3e-4, shift=(-0.04, 0.05, 0.03), slip=(0.04, 0.02, -0.03), omega=(5.0, 1.0, 2.0)),
    # rolls over the common edge of the two triangles in the middle of the contact: still one contact
    "mesh_over_seam": on_wall(
        TILTED, 3e-4, shift=1.1e-3 * np.array(SEAM), slip=-0.8 * np.array(SEAM), omega=(5.0, 1.0, 2.0)
    ),
    "moving_mesh": on_wall(
        MOVING, 3e-4, shift=(0.03, -0.04, -0.03), slip=(0.9, 0.16, 0.12), omega=(-50.0, 30.0, 9.0), **SMALL
    ),
}


def spheres_of(bodies):
    return [b for b in bodies if isinstance(b, Sphere)]


def write_spheres(folder):
    """All of them, to the file spheres.data."""
    every = [s for bodies in CASES.values() for s in spheres_of(bodies)]
    write_data(folder / "spheres.data", every, low=-0.5, high=0.5)


def by_case(motion):
    """The host's motion, (snapshots, particles, 9), by name of case."""
    result, first = {}, 0
    for name, bodies in CASES.items():
        count = len(spheres_of(bodies))
        result[name] = motion[:, first : first + count]
        first += count
    return result
