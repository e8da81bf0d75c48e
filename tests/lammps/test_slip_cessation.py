# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere that is set down sliding ends rolling: case DEM-04 of MFiX and of LAMMPS's own tests of its granular models.

It slides for 2 u/(7 mu g) and goes on at 5/7 of its speed u, whatever the friction. That is of a point contact at the
radius r. With friction at the lever l from the centre to the middle of the overlap m (u - v) l = I w, and v = l w, so
v = u a/(1 + a) with a = m l^2/I, w = v/l.
"""

from math import pi, sqrt

import pytest
from harness.lammps import run
from harness.output import read_dump

RADIUS, DENSITY, SPEED, MU, G = 0.5, 1.0, 1.0, 0.5, 1.0
MASS = 4 / 3 * pi * RADIUS**3 * DENSITY
KN, KT = 1e4, 2857.0
OVERLAP = MASS * G / KN
DAMPING = 0.2 * sqrt(MASS * KN)
# over that: a tangential dashpot with which the spring of the mass m/(1 + a) comes to rest soonest
TANGENTIAL = 2 * sqrt(KT * MASS / 3.5) / DAMPING
STEPS_PER_CONTACT = 10
DT = pi * sqrt(MASS / KN) / STEPS_PER_CONTACT


@pytest.mark.parametrize("predict", ["verlet", "exact", "rk4", "impulse"])
def test_ends_rolling(tmp_path, predict):
    models = f"hooke {KN} {DAMPING!r} tangential linear_history {KT} {TANGENTIAL!r} {MU} damping velocity"
    slides = 2 * SPEED / (7 * MU * G)
    integrator = "nve/sphere" if predict == "verlet" else "nve/cfpm"
    text = f"""
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -5 5 -1 1 -0.5 3 units box
create_box 1 box
create_atoms 1 single 0 0 {RADIUS - OVERLAP!r} units box
set group all diameter {2 * RADIUS} density {DENSITY}
velocity all set {SPEED} 0 0 units box
timestep {DT!r}
pair_style granular/cfpm predict {predict}
pair_coeff * * {models}
fix wall all wall/gran/cfpm granular {models} zplane 0 NULL
fix gravity all gravity {G} vector 0 0 -1
fix integrate all {integrator}
run {round(0.5 * slides / DT)}
write_dump all custom half.dump id z vx omegay modify format float %.17g
run {round(slides / DT)}
write_dump all custom end.dump id z vx omegay modify format float %.17g
"""
    run(text, tmp_path)
    half, end = (read_dump(tmp_path / f"{name}.dump")[0][1] for name in ("half", "end"))
    time = DT * round(0.5 * slides / DT)
    assert half["vx"][0] == pytest.approx(SPEED - MU * G * time, abs=MU * G * DT)
    overlap = RADIUS - end["z"][0]  # at rest, which changes with the method and the step
    assert OVERLAP < 1.2 * overlap < 1.5 * OVERLAP
    lever = RADIUS if predict == "verlet" else RADIUS - overlap / 2  # of the host, at walls
    a = 2.5 * (lever / RADIUS) ** 2
    # dv/v = 2/(1 + a) dl/l for a lever that was another one until the overlap had come to rest
    assert end["vx"][0] == pytest.approx(SPEED * a / (1 + a), rel=abs(overlap - OVERLAP) / RADIUS + 1e-7)
    assert end["omegay"][0] == pytest.approx(end["vx"][0] / lever, rel=1e-7)
