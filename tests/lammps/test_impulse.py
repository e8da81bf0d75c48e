# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse: collisions that are exact whatever the step, in the host.

Pairs head-on and spheres on a plane, on a plane region at rest and on one that moves, each with random phases of
detection, all in one run. The restitution has a closed form, see tests/liggghts/test_impulse.py.
"""

import importlib.util
import re
from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from lammps import read_dump, run, vectors
from spheres import Sphere, digits, dump, read_motion, write_data

_file = Path(__file__).resolve().parents[1] / "liggghts" / "test_impulse.py"
_spec = importlib.util.spec_from_file_location("liggghts_impulse", _file)
scene = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(scene)

PHASES, SPEED, RADIUS, STIFFNESS = scene.PHASES, scene.SPEED, scene.RADIUS, scene.STIFFNESS
TC = scene.contact_time("hooke/stiffness")
WALLS = (0.0, 0.1, 0.2)  # floor, plate, moving plate
MOVES = 0.5 * SPEED
# positions of 0.3 m are rounded some 60 times, by 2e-15 m in all, where overlaps are 1e-5 m
ROUNDING = 1.0e-9


def contact(zeta, mass, friction=0.3):
    """The damping of this host goes with the reduced mass."""
    return f"hooke {STIFFNESS!r} 8e5 {digits(2.0 * zeta * sqrt(STIFFNESS / mass))} NULL {friction} 0"


def head(dt, skin=0.002, newton="off", boundary="f f f"):
    return f"""
units si
atom_style sphere
boundary {boundary}
newton {newton}
comm_modify vel yes
processors * 1 1
read_data spheres.data
neighbor {skin} bin
neigh_modify delay 0
timestep {dt!r}
"""


def restitutions(folder, zeta, dt, ranks=1, newton="off", predict="impulse"):
    """Of pairs and of spheres on the floor and on the plates: (4, PHASES)."""
    random = np.random.default_rng(4)
    ahead = SPEED * dt * random.uniform(0.0, 3.0, (4, PHASES))
    ahead[3] += SPEED * dt  # in the first step the host does not know yet that the plate moves
    spheres = []
    for k in range(PHASES):
        x, y = 0.05 * (k % 9) - 0.2, 0.05 * (k // 9) - 0.2
        for side in (-1, 1):
            place = (x + side * (RADIUS + 0.5 * ahead[0, k]), y, 0.25)
            spheres.append(Sphere(place, v=(-0.5 * side * SPEED, 0.0, 0.0), radius=RADIUS))
        for body, z in enumerate(WALLS, 1):
            speed = SPEED - MOVES if body == 3 else SPEED
            spheres.append(Sphere((x, y, z + RADIUS + ahead[body, k]), v=(0.0, 0.0, -speed), radius=RADIUS))
    write_data(folder / "spheres.data", spheres, low=-0.3, high=0.3, types=1)
    steps = int(np.ceil(3.0 * TC / dt)) + 6
    wall = contact(zeta, 2.0 * scene.PAIR_MASS)
    deck = head(dt, newton=newton)
    deck += f"""
pair_style gran/cfpm {contact(zeta, scene.PAIR_MASS)} predict {predict}
pair_coeff * *
variable nothing equal 0.0
variable up equal {MOVES!r}*step*{dt!r}
region plate plane 0 0 {WALLS[1]} 0 0 1 units box
region moving plane 0 0 {WALLS[2]} 0 0 1 units box move v_nothing v_nothing v_up
"""
    for body, (name, shape) in enumerate((("floor", "zplane 0 NULL"), ("plate", "region plate"), ("moving", "region moving")), 3):
        ids = " ".join(str(5 * k + body) for k in range(PHASES))
        deck += f"group {name}s id {ids}\nfix {name} {name}s wall/gran/cfpm {wall} {shape}\n"
    deck += "fix integrate all nve/cfpm\n"
    run(deck + dump(steps).replace('format "%d', 'format line "%d') + f"run {steps}\n", folder, np=ranks)
    v = read_motion(folder / "motion.dump")[1][-1, :, 3:6].reshape(PHASES, 5, 3)
    return np.array([v[:, 1, 0] - v[:, 0, 0], v[:, 2, 2], v[:, 3, 2], v[:, 4, 2] - MOVES]) / SPEED


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("zeta", [0.0, 0.1, 0.7, 1.2])
def test_restitution_is_exact_at_any_step(tmp_path, zeta, newton, ranks):
    expected = scene.linear_restitution(zeta)
    for nt in scene.STEPS_PER_CONTACT:
        found = restitutions(tmp_path, zeta, TC / nt, ranks, newton)
        error = np.abs(found - expected).max(axis=1)
        print(f"nt = {nt:.2f}: e = {found.mean():.7f} +- {found.std():.1e}, exact {expected:.7f}, off {error}")
        assert error.max() <= ROUNDING
