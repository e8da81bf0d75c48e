# SPDX-License-Identifier: GPL-2.0-or-later
"""What inputs/liggghts/in.bed does in its phase "time", in YADE: copies of a settled bed side by side are continued.

yade -n -x -j1 yade_bed.py BED NX NY NT STEPS

BED: the data file that LIGGGHTS left; NX by NY copies; NT: steps per contact time. Prints a line of JSON in the end.
"""

import json
import math
import sys

import numpy as np
from yade import utils
from yade.wrapper import (
    Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider, InteractionLoop, Ip2_ViscElMat_ViscElMat_ViscElPhys, Law2_ScGeom_ViscElPhys_Basic,
    NewtonIntegrator, Omega, ViscElMat
)

# as in in.bed
RADIUS, DENSITY, CONTACT_TIME, FRICTION, SKIN = 0.025, 800.0, 2.0e-4, 0.3, 0.005
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
STIFFNESS = MASS / 2 * (math.pi / CONTACT_TIME) ** 2
TANGENTIAL = STIFFNESS / (2 * (1 + 0.32))
DAMPING = math.sqrt(MASS * STIFFNESS)
TANGENTIAL_DAMPING = DAMPING * math.sqrt(TANGENTIAL / STIFFNESS)
HUGE = 1e300  # YADE takes no infinity


def read(path):
    """Of a data file: the sides of the box, and a row of x, y, z, vx, vy, vz, wx, wy, wz for each sphere."""
    with open(path) as file:
        lines = file.read().splitlines()
    count = next(int(line.split()[0]) for line in lines if line.endswith(" atoms"))
    ends = np.array([line.split()[:2] for line in lines if line.endswith(("xhi", "yhi", "zhi"))], dtype=float)

    def section(name):
        begin = lines.index(name) + 2
        table = np.array([line.split() for line in lines[begin:begin + count]], dtype=float)
        return table[np.argsort(table[:, 0])]

    return ends[:, 1] - ends[:, 0], np.hstack([section("Atoms")[:, 4:7], section("Velocities")[:, 1:7]])


def material(damping, tangential_damping):
    """A contact has a b/(a + b) of the numbers a and b of its two materials."""
    return ViscElMat(
        density=DENSITY, frictionAngle=math.atan(FRICTION), kn=2 * STIFFNESS, ks=2 * TANGENTIAL, cn=damping,
        cs=tangential_damping
    )


def main():
    bed, (nx, ny, nt, steps) = sys.argv[1], map(int, sys.argv[2:6])
    sides, spheres = read(bed)
    omega = Omega()
    omega.periodic = True
    omega.cell.setBox(*(sides * (nx, ny, 1)))  # which lets nothing pass above, as the highest sphere is far below
    ice = omega.materials.append(material(2 * DAMPING, 2 * TANGENTIAL_DAMPING))
    # damping goes with the mass of the pair: at the floor it is twice that of two spheres
    floor = omega.materials.append(material(HUGE, HUGE))
    for copy in np.ndindex(nx, ny):
        for row in spheres:
            sphere = utils.sphere(row[:3] + sides * (*copy, 0), RADIUS, material=ice)
            sphere.state.vel, sphere.state.angVel = row[3:6], row[6:]
            omega.bodies.append(sphere)
    count = len(omega.bodies)
    omega.bodies.append(utils.wall(0, axis=2, sense=1, material=floor))

    omega.dt = CONTACT_TIME / nt
    omega.engines = [
        ForceResetter(),
        InsertionSortCollider(
            [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=SKIN / 2, allowBiggerThanPeriod=True  # the floor is
        ),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
            [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
            [Law2_ScGeom_ViscElPhys_Basic()],
        ),
        NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
    ]
    omega.run(steps, True)

    pairs = sum(contact.isReal and count not in (contact.id1, contact.id2) for contact in omega.interactions)
    energy = sum(body.state.mass * body.state.vel.squaredNorm() / 2 for body in omega.bodies if body.id < count)
    print(json.dumps({"spheres": count, "touches": 2 * pairs / count, "energy": energy / count}))


main()
