# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse with Hertz' law and with sub-models of granular: what has come to rest stays, whatever the step."""

import re
from math import pi

import numpy as np
import pytest
from harness.impacts import RADIUS, TC
from harness.lammps import run
from harness.output import read_dump, vectors
from harness.spheres import Sphere, read_motion, write_data
from kicked_bed import bed
from normal_impacts import WALLS, head, motion
from test_impulse_of_models import MODELS, PAIR, WALL, of_area

GRAVITY = 9.81


@pytest.mark.parametrize("name", ["gran", "viscoelastic", "hertz, tsuji", "velocity"])
@pytest.mark.parametrize("nt", [1, 30])
def test_column(tmp_path, nt, name):
    """A sphere on another one, on a plate, and one on the floor: see test_impulse.test_rest. A Hertz contact at rest
    under a load is softer than in a collision: its oscillation decays by half of hn/m* at its overlap, slower than
    that of the linear ones."""
    dt = TC / nt
    heights = (RADIUS, WALLS[1] + RADIUS, WALLS[1] + 3.0 * RADIUS)
    places = zip((-0.1, 0.1, 0.1), heights)
    write_data(tmp_path / "spheres.data", [Sphere((x, 0.0, z), radius=RADIUS) for x, z in places], -0.3, 0.3, types=1)
    if name == "gran":
        pair, coefficients, wall = f"gran/cfpm {of_area(0.5, *PAIR, '')}", "", of_area(0.5, *WALL, "")
    else:
        models = MODELS[name][0]
        pair, coefficients, wall = "granular/cfpm", models(*PAIR), f"granular {models(*WALL)}"
    steps = 60_000
    run(
        head(dt)
        + f"""
pair_style {pair} predict impulse
pair_coeff * * {coefficients}
region plate plane 0 0 {WALLS[1]} 0 0 1 units box
group on_plate id 2 3
group on_floor id 1
fix plate on_plate wall/gran/cfpm {wall} region plate
fix floor on_floor wall/gran/cfpm {wall} zplane 0 NULL
fix gravity all gravity {GRAVITY} vector 0 0 -1
fix integrate all nve/cfpm
{motion(steps)}run {steps}
""",
        tmp_path,
    )
    end = read_motion(tmp_path / "motion.dump")[1][-1]
    print(f"nt = {nt}, {name}: speeds over g tc", np.abs(end[:, 3:6]).max(axis=1) / (GRAVITY * TC))
    assert (end[:, 2] < heights).all()
    rounding = 4.0 * pi**2 * np.spacing(max(heights)) / TC
    assert np.abs(end[:, 3:]).max() <= 1e-9 * GRAVITY * TC + rounding < 1e-6 * GRAVITY * TC


# of the smaller spheres at 1 m/s
DT = 5e-4


def test_bed(tmp_path):
    """At nt = 1 it loses what it fell with, but for speeds below that of a fall over one step."""
    text = bed("gran/cfpm hertz 1e7 NULL 2e6 NULL 0.5 1 predict impulse", "off", after="run 2500\n")
    text = text.replace("nve/sphere", "nve/cfpm").replace("timestep 2e-5", f"timestep {DT}")
    text = text.replace("neighbor 0.0005", "neighbor 0.003").replace("0.0989 0.008 0.1", "0.0989 0.008 0.04")
    text = re.sub(r"wall/gran hooke/history .* zplane", "wall/gran/cfpm hertz 1e7 NULL 2e6 NULL 0.5 1 zplane", text)
    text = re.sub(r"^dump.*\n", "", text, flags=re.MULTILINE)
    text += "write_dump all custom last.dump id z vx vy vz modify sort id\n"
    run(text, tmp_path)
    end = read_dump(tmp_path / "last.dump")[0][1]
    speed = np.linalg.norm(vectors(end, "vx", "vy", "vz"), axis=1) / (GRAVITY * DT)
    print(f"speeds over g dt: median {np.median(speed):.1e}, largest {speed.max():.1e} of {len(speed)}")
    assert np.median(speed) < 0.5 and end["z"].min() > 0.002
