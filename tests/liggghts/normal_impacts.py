# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs head-on and spheres on a plane and on a mesh, each with random phases of detection, all in one run of the host.
"""

from math import atan, exp, log, pi, sqrt

import numpy as np
from harness.impacts import (
    LENGTH,
    PAIR_MASS,
    PHASES,
    RADIUS,
    RATE,
    SPEED,
    STIFFNESS,
    TC,
    linear_restitution,
    viscoelastic_restitution,
)
from harness.liggghts import run
from harness.spheres import Law, Sphere, box, digits, dump, read_motion, stiffness_material, write_data, write_stl

POISSON = 0.32
YOUNG = 1.0e9


def hertz_restitution(coefficient):
    """The host takes that of a contact with tension, which gives Tsuji's alpha."""
    beta = -log(coefficient) / sqrt(log(coefficient) ** 2 + pi**2)
    alpha = sqrt(5.0) * beta
    if alpha == 0.0:
        return 1.0
    root = sqrt(5.0 - alpha**2)
    return exp(-alpha / root * (pi / 2.0 - atan((2.0 * alpha - 5.0 / alpha) / (2.0 * root))))


def limit_force(tension):
    return "limitForce " + ("off" if tension else "on")


def hooke(zeta, tension=False):
    """The damping ratio is that of pairs; at a wall, with twice the mass, the type of the wall has another damping."""
    pair, wall = (2.0 * zeta * sqrt(m * STIFFNESS) for m in (PAIR_MASS, 2.0 * PAIR_MASS))
    law = {(1, 1): Law(STIFFNESS, pair, 8e5, 0.0, 0.3), (1, 2): Law(STIFFNESS, wall, 8e5, 0.0, 0.3)}
    law[2, 2] = law[1, 2]
    settings = f"absolute_damping on {limit_force(tension)}"
    return stiffness_material(law), "hooke/stiffness", settings, linear_restitution(zeta, tension)


def hertz(coefficient, tension=False):
    material = (
        f"fix Y all property/global youngsModulus peratomtype {digits([YOUNG] * 2)}\n"
        f"fix nu all property/global poissonsRatio peratomtype {digits([POISSON] * 2)}\n"
        f"fix e all property/global coefficientRestitution peratomtypepair 2 {digits([coefficient] * 4)}\n"
        f"fix mu all property/global coefficientFriction peratomtypepair 2 {digits([0.3] * 4)}\n"
    )
    expected = coefficient if tension else hertz_restitution(coefficient)
    return material, "hertz", f"tangential_damping on {limit_force(tension)}", expected


def viscoelastic(alpha, tension=False):
    """Kn and gamma_n go with (R*)^(1/2), which at a wall is that of another radius."""
    law = {}
    for types, mass, radius in (((1, 1), PAIR_MASS, RADIUS / 2), ((1, 2), 2.0 * PAIR_MASS, RADIUS)):
        kn = RATE**2 * mass / sqrt(radius)
        law[types] = Law(kn, alpha * RATE / LENGTH / sqrt(radius), kn / 3, 0.0, 0.3)
    law[2, 2] = law[1, 2]
    material, settings = stiffness_material(law).replace("_abs", ""), f"tangential_damping on {limit_force(tension)}"
    return material, "hertz/stiffness", settings, viscoelastic_restitution(alpha, tension)


def contact_time(model):
    """Of an undamped head-on pair."""
    if model.endswith("/stiffness"):
        return TC
    k = 4.0 / 3.0 * YOUNG / (2.0 * (1.0 - POISSON**2)) * sqrt(RADIUS / 2.0)
    return 3.2181 * (PAIR_MASS / k) ** 0.4 * SPEED**-0.2


def gaps():
    """From which these meet, in ways of one step."""
    return np.random.default_rng(4).uniform(0.0, 3.0, (3, PHASES))


def restitutions(
    folder, material, model, settings, dt, ranks=1, gravity=0.0, predict="impulse", walls="impulse", skin=0.002
):
    """Of pairs, spheres on the plane and spheres on the mesh: (3, PHASES). With gravity speeds are those at the height
    of the touch, from the energy."""
    ahead = SPEED * dt * gaps()
    spheres = []
    for k in range(PHASES):
        x, y = 0.05 * (k % 9) - 0.2, 0.05 * (k // 9) - 0.2
        for side in (-1, 1):
            place = (x + side * (RADIUS + 0.5 * ahead[0, k]), y, 0.2)
            spheres.append(Sphere(place, v=(-0.5 * side * SPEED, 0.0, 0.0), radius=RADIUS))
        for body, z in ((1, 0.0), (2, 0.1)):
            spheres.append(Sphere((x, y, z + RADIUS + ahead[body, k]), v=(0.0, 0.0, -SPEED), radius=RADIUS))
    write_data(folder / "spheres.data", spheres, low=-0.3, high=0.3, types=2)
    write_stl(folder / "plate.stl", [(-0.29, -0.29, 0.1), (0.29, -0.28, 0.1), (0.29, 0.29, 0.1), (-0.28, 0.29, 0.1)])
    steps = int(np.ceil(3.0 * contact_time(model) / dt)) + 5
    words = f"model {model} tangential history predict"
    deck = box(dt, skin=skin) + material
    deck += f"""
pair_style gran/cfpm {words} {predict} {settings}
pair_coeff * *
fix plate all mesh/surface file plate.stl type 2
fix floor all wall/gran/cfpm {words} {walls} primitive type 2 zplane 0.0 {settings}
fix mesh all wall/gran/cfpm {words} {walls} mesh n_meshes 1 meshes plate {settings}
fix integrate all nve/cfpm
"""
    if gravity:
        deck += f"fix gravity all gravity {gravity!r} vector 0 0 -1\n"
    run(deck + dump(steps) + f"run {steps}\n", folder, np=ranks)
    motion = read_motion(folder / "motion.dump")[1][[0, -1]].reshape(2, PHASES, 4, 9)
    speeds = [motion[:, :, 1, 3] - motion[:, :, 0, 3]]
    for body, z in ((2, 0.0), (3, 0.1)):
        height, v = motion[:, :, body, 2] - z - RADIUS, motion[:, :, body, 5]
        speeds.append(np.sqrt(v**2 + 2.0 * gravity * height))
    return np.array([after / np.abs(before) for before, after in speeds])
