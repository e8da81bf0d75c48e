# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs head-on and spheres on a plane, on a plane region at rest and on one that moves, each with random phases of
detection, all in one run of the host.
"""

from math import sqrt

import numpy as np
from harness.impacts import PAIR_MASS, PHASES, RADIUS, SPEED, STEPS_PER_CONTACT, STIFFNESS, TC
from harness.lammps import run
from harness.spheres import Sphere, digits, dump, lammps_box, read_motion, write_data

WALLS = (0.0, 0.1, 0.2)  # where these are
SHAPES = {"floor": "zplane 0 NULL", "plate": "region plate", "moving": "region moving"}
MOVES = 0.5 * SPEED
# positions of 0.3 m are rounded some 60 times, by 2e-15 m in all, where overlaps are 1e-5 m
ROUNDING = 1.0e-9


def contact(zeta, mass, limit="limit_damping"):
    """The damping of this host goes with the reduced mass."""
    return f"hooke {STIFFNESS!r} 8e5 {digits(2.0 * zeta * sqrt(STIFFNESS / mass))} NULL 0.3 0 {limit}"


def motion(every, name="motion.dump"):
    return dump(every, name, host="lammps")


def head(dt, data="spheres.data", skin=0.002, newton="off"):
    return lammps_box(dt, data, skin, newton, processors="* 1 1")


def gaps():
    """From which a pair and spheres over the floor and the plates meet, PHASES times, in ways of one step."""
    random = np.random.default_rng(4)
    ahead = random.uniform(0.0, 3.0, (4, PHASES))
    ahead[3] += 1.0  # in the first step the host does not know yet that the plate moves
    return ahead


def bodies(dt):
    ahead = SPEED * dt * gaps()
    spheres = []
    for k in range(PHASES):
        x, y = 0.05 * (k % 9) - 0.2, 0.05 * (k // 9) - 0.2
        for side in (-1, 1):
            place = (x + side * (RADIUS + 0.5 * ahead[0, k]), y, 0.25)
            spheres.append(Sphere(place, v=(-0.5 * side * SPEED, 0.0, 0.0), radius=RADIUS))
        for body, z in enumerate(WALLS, 1):
            speed = SPEED - MOVES if body == 3 else SPEED
            spheres.append(Sphere((x, y, z + RADIUS + ahead[body, k]), v=(0.0, 0.0, -speed), radius=RADIUS))
    return spheres


def impacts(pair, wall, dt, data, newton, output):
    deck = head(dt, data, newton=newton)
    deck += f"""
{pair}
variable nothing equal 0.0
variable up equal {MOVES!r}*step*{float(dt)!r}
region plate plane 0 0 {WALLS[1]} 0 0 1 units box
region moving plane 0 0 {WALLS[2]} 0 0 1 units box move v_nothing v_nothing v_up
"""
    for body, (name, shape) in enumerate(SHAPES.items(), 3):
        ids = " ".join(str(5 * k + body) for k in range(PHASES))
        deck += f"group {name}s id {ids}\nfix {name} {name}s wall/gran/cfpm {wall} {shape}\n"
    steps = int(np.ceil(3.0 * TC / dt)) + 6
    return f"{deck}fix integrate all nve/cfpm\n{motion(steps, output)}run {steps}\n"


def restitutions_of(folder, pair, wall, ranks=1, newton="off", nts=STEPS_PER_CONTACT):
    """{nt: those of pairs and of spheres on the floor and on the plates, (4, PHASES)}, all in one run of the host.

    pair: the lines of the pair style; wall: the contact of the walls.
    """
    decks = []
    for k, nt in enumerate(nts):
        write_data(folder / f"{k}.data", bodies(TC / nt), low=-0.3, high=0.3, types=1)
        decks.append(impacts(pair, wall, TC / nt, f"{k}.data", newton, f"{k}.dump"))
    run("clear\n".join(decks), folder, np=ranks)
    found = {}
    for k, nt in enumerate(nts):
        v = read_motion(folder / f"{k}.dump")[1][-1, :, 3:6].reshape(PHASES, 5, 3)
        found[nt] = np.array([v[:, 1, 0] - v[:, 0, 0], v[:, 2, 2], v[:, 3, 2], v[:, 4, 2] - MOVES]) / SPEED
    return found


def restitutions(folder, zeta, ranks, newton, limit, predict="impulse", nts=STEPS_PER_CONTACT):
    """Of the linear law."""
    pair = f"pair_style gran/cfpm {contact(zeta, PAIR_MASS, limit)} predict {predict}\npair_coeff * *"
    return restitutions_of(folder, pair, contact(zeta, 2.0 * PAIR_MASS, limit), ranks, newton, nts)
