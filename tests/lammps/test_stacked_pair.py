# SPDX-License-Identifier: GPL-2.0-or-later
"""Two spheres of different density, one upon the other and pressed between two walls: case DEM-03 of MFiX and of
LAMMPS's own tests of its granular models.

All three contacts last, and each moves both spheres, which two bodies alone do not know. So methods tend to the motion
of the two with the step; it is solved here as an ordinary differential equation.
"""

from math import pi, sqrt

import numpy as np
import pytest
from granular_contacts import integrated
from harness.lammps import run
from harness.output import read_dump

RADIUS, G = 0.0005, 9.81
DENSITIES = 20000.0, 10000.0  # of the lower and of the upper one
MASSES = [4 / 3 * pi * RADIUS**3 * density for density in DENSITIES]
HEIGHT = 3.6 * RADIUS  # of the upper wall above the lower one
START = 0.25 * HEIGHT, 0.75 * HEIGHT  # of the centres
KN = 1e2
DAMPING = 0.05 * sqrt(min(MASSES) * KN)
E_STAR = KN / (4 / 3 * sqrt(RADIUS / 2 * 0.2 * RADIUS))  # about as stiff at such an overlap
MODELS = {
    "hooke": f"hooke {KN} {DAMPING!r} tangential linear_nohistory 0 0 damping velocity",
    "hertz": f"hertz {4 / 3 * E_STAR!r} 1e7 tangential mindlin 0 0 0 damping viscoelastic",
}
METHODS = [("hooke", method) for method in ("verlet", "exact", "rk4", "impulse")]
METHODS += [("hertz", method) for method in ("verlet", "rk4", "impulse")]
CONTACT = pi * sqrt(min(MASSES) / 2 / KN)  # about how long one lasts [s]
TIME = 2 * CONTACT
STEPS = 640, 1280


def force(model, overlap, closing, radius, mass):
    if model == "hooke":
        return KN * overlap + DAMPING * closing
    root = sqrt(radius * overlap)
    return root * (4 / 3 * E_STAR * overlap + 1e7 * mass * closing)


def motion(model):
    """Heights and speeds of the two after TIME, in steps so small that the error is one of rounding."""
    lower, upper = MASSES
    reduced = lower * upper / (lower + upper)

    def slope(state):
        a, b, u, v = state
        floor = force(model, RADIUS - a, -u, RADIUS, lower)
        between = force(model, 2 * RADIUS - (b - a), u - v, RADIUS / 2, reduced)
        lid = force(model, b + RADIUS - HEIGHT, v, RADIUS, upper)
        return np.array([u, v, (floor - between) / lower - G, (between - lid) / upper - G])

    return integrated(slope, np.array([*START, 0.0, 0.0]), TIME, 20000)


def simulated(folder, model, method, steps):
    integrator = "nve/sphere" if method == "verlet" else "nve/cfpm"
    folder.mkdir()
    text = f"""
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -0.01 0.01 -0.01 0.01 -0.01 0.01 units box
create_box 1 box
create_atoms 1 single 0 0 {START[0]!r} units box
create_atoms 1 single 0 0 {START[1]!r} units box
group upper id 2
set group all diameter {2 * RADIUS} density {DENSITIES[0]}
set group upper density {DENSITIES[1]}
timestep {TIME / steps!r}
pair_style granular/cfpm predict {method}
pair_coeff * * {MODELS[model]}
fix walls all wall/gran/cfpm granular {MODELS[model]} zplane 0 {HEIGHT!r}
fix gravity all gravity {G} vector 0 0 -1
fix integrate all {integrator}
run {steps}
write_dump all custom end.dump id z vz modify sort id format float %.17g
"""
    run(text, folder)
    end = read_dump(folder / "end.dump")[0][1]
    return np.array([*end["z"], *end["vz"]])


def errors(folder, model, method):
    """Over the steps: the largest one of a height or a speed, as part of the most that one of them changes by."""
    exact = motion(model)
    change = np.abs(exact - [*START, 0, 0])
    change = np.repeat([change[:2].max(), change[2:].max()], 2)
    return [np.abs((simulated(folder / str(n), model, method, n) - exact) / change).max() for n in STEPS]


@pytest.mark.parametrize("model, method", METHODS)
def test_tends_to_the_motion_of_the_two(tmp_path, model, method):
    """To first order, as the forces of others are known at the step's begin alone; predicted contacts from nearer."""
    found = errors(tmp_path, model, method)
    assert found[1] < 0.53 * found[0], "half, and what is left of higher orders"
    assert found[0] < (0.01 if method == "verlet" else 0.0015)
