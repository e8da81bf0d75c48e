# SPDX-License-Identifier: GPL-2.0-or-later
"""A contact that ends takes its spring with it, also when it is back before the next neighbour list is built.

Two spheres are pushed together (fix addforce) while they slide past each other: they collide, part and collide again.
The state at a step without contact, some steps before the second impact, is the start of another run; from there both
must move alike. A third run with the stock host shows that the set-up can tell: stock keeps the old spring.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from harness.liggghts import LAUNCHER, STOCK, run
from harness.output import rebuilds
from harness.spheres import FORCES, MOTION, Law, Sphere, box, dump, read_motion, stiffness_material, write_data

RADIUS = 0.025
MODEL = "model hooke/stiffness tangential history"
STYLES = {
    "cfpm": (LAUNCHER, "pair_style gran/cfpm", "nve/cfpm"),
    "stock": (STOCK, "pair_style gran", "nve/sphere"),
}


@dataclass
class Setup:
    """dt, steps; contact law; force that pushes each sphere [N]; distance of the surfaces at the start [m]."""

    dt: float
    steps: int
    law: Law
    push: float
    gap: float


FINE = Setup(dt=5.0e-5, steps=300, law=Law(kn=1.2e5, hn=3.0, ks=4.0e4, hs=5.0, mu=0.3), push=20.0, gap=1.0e-4)
# three steps a contact, 4 % overlap: a step takes the spheres further apart than 1 % of their distance
COARSE = Setup(dt=1.3e-3, steps=60, law=Law(kn=2.0e4, hn=1.0, ks=7.0e3, hs=2.0, mu=0.3), push=3.0, gap=6.8e-4)


def start(setup):
    distance = 2 * RADIUS + setup.gap
    a = Sphere((-distance / 2, 0.0, 0.0), v=(0.35, 0.06, 0.0), omega=(0.0, 0.0, 9.0), radius=RADIUS)
    b = Sphere((distance / 2, 0.0, 0.0), v=(-0.35, -0.04, 0.03), omega=(0.0, 4.0, 9.0), radius=RADIUS)
    return [a, b]


def motion_of(folder, style, setup, spheres, steps, output=""):
    program, pair, integrator = STYLES[style]
    folder.mkdir()
    write_data(folder / "spheres.data", spheres, types=1)
    deck = box(setup.dt, skin=0.04) + stiffness_material({(1, 1): setup.law})
    deck += f"""
{pair} {MODEL} absolute_damping on
pair_coeff * *
group left id 1
group right id 2
fix push_left left addforce {setup.push} 0 0
fix push_right right addforce {-setup.push} 0 0
fix integrate all {integrator}
"""
    process = run(deck + output + dump() + f"run {steps}\n", folder, program=program)
    assert rebuilds(process.stdout) == [0]
    return read_motion(folder / "motion.dump", MOTION + FORCES)[1]


def gaps(motion):
    return np.linalg.norm(motion[:, 0, :3] - motion[:, 1, :3], axis=1) - 2 * RADIUS


def flight(motion):
    """Steps of the free flight between the first two contacts: from its first to its last."""
    gap = gaps(motion)
    first = np.flatnonzero(gap < 0)[0]
    parted = first + np.flatnonzero(gap[first:] > 0)[0]
    again = parted + np.flatnonzero(gap[parted:] < 0)[0]
    return parted, again - 1


def second_impacts(folder, style, setup, output=""):
    """The motion from the last step of the flight, as it went on and as a run of its own."""
    motion = motion_of(folder / "on", style, setup, start(setup), setup.steps, output)
    last = flight(motion)[1]
    state = [Sphere(tuple(row[:3]), tuple(row[3:6]), tuple(row[6:9]), radius=RADIUS) for row in motion[last]]
    alone = motion_of(folder / "alone", style, setup, state, setup.steps - last, output)
    assert np.abs(alone[:, 0, 10:12]).max() > 1.0  # fy, fz: there is a second impact, with friction
    return motion[last:], alone


def test_second_impact_starts_fresh(tmp_path):
    """Bit by bit: both runs start from the same numbers and do the same with them."""
    on, alone = second_impacts(tmp_path, "cfpm", FINE)
    assert np.abs(on - alone).max() == 0.0


def test_stock_keeps_the_old_spring(tmp_path):
    on, alone = second_impacts(tmp_path, "stock", FINE)
    assert np.abs(on - alone)[:, :, 9:12].max() > 0.1  # N


PRESSURE = "compute motion all temp\ncompute p all pressure motion\nthermo_style custom step c_p\nthermo 1\n"
LOOPS = {"own": "", "host": PRESSURE}


@pytest.mark.parametrize("loop", LOOPS)
def test_second_impact_after_fast_separation(tmp_path, loop):
    """The pressure of every step is asked for to make the pair style take the host's loop."""
    on, alone = second_impacts(tmp_path, "cfpm", COARSE, LOOPS[loop])
    assert np.abs(on - alone).max() == 0.0


def test_fast_separation_jumps_the_near_zone(tmp_path):
    """A flight that a shell of 1 % around the spheres, the width the host uses for such ends, would not see."""
    motion = motion_of(tmp_path / "on", "cfpm", COARSE, start(COARSE), COARSE.steps)
    parted, last = flight(motion)
    assert last - parted > 3
    assert gaps(motion)[parted : last + 1].min() > 0.01 * 2 * RADIUS
