# SPDX-License-Identifier: GPL-2.0-or-later
"""Nothing is gained from nothing: the kinetic and elastic energy of many impacts at once under impulses.

Rows of balls are tests/core/test_row_of_balls.cpp. SI units.
"""

from math import log, pi, sqrt

import numpy as np
import pytest
from harness.lammps import run
from harness.spheres import Sphere, dump, lammps_box, read_motion, write_data

RADIUS = 0.005
MASS = Sphere((0, 0, 0), radius=RADIUS).mass
TC = 1e-4  # of a contact without damping
KN = MASS / 2 * (pi / TC) ** 2
COLUMNS = ("xu", "yu", "zu", "vx", "vy", "vz", "omegax", "omegay", "omegaz")
ROUNDING = 1e-10  # relative; of positions, far larger than overlaps: 1e-16 of 6 cm in an overlap of 1e-5 m, and sums


def energies(motion, period=np.inf):
    """Kinetic, elastic (without springs of friction) and of rotation, of each snapshot [J]."""
    rows = []
    for snapshot in motion:
        x, v, omega = np.split(snapshot, 3, axis=1)
        i, j = np.triu_indices(len(x), 1)
        between = x[i] - x[j]
        if np.isfinite(period):
            between -= period * np.rint(between / period)
        overlap = np.maximum(0.0, 2 * RADIUS - np.linalg.norm(between, axis=1))
        elastic = 0.5 * KN * np.sum(overlap**2)
        rows.append((0.5 * MASS * np.sum(v**2), elastic, 0.2 * MASS * RADIUS**2 * np.sum(omega**2)))
    return np.array(rows)


def move(folder, spheres, nt, restitution, duration, period=None, predict="impulse"):
    """Snapshots, several of each contact time, over a duration [tc]; predict: empty for stock."""
    low, high = (0.0, period) if period else (-0.5, 0.5)
    write_data(folder / "spheres.data", spheres, low, high, types=1)
    loss = -log(restitution)
    damping = 2 * loss / sqrt(loss**2 + pi**2) * sqrt(MASS / 2 * KN) * 2 / MASS
    box = lammps_box(TC / nt, skin=0.002).replace("f f f", "p p p" if period else "f f f")
    style, integrator = ("gran/cfpm hooke", "nve/cfpm") if predict else ("gran/hooke/history", "nve/sphere")
    deck = f"""{box}
pair_style {style} {KN} NULL {damping} 0 0 0 {predict and "predict " + predict}
pair_coeff * *
fix integrate all {integrator}
thermo 100000
{dump(max(1, int(nt / 3)), columns=COLUMNS, host="lammps")}run {int(duration * nt)}
"""
    run(deck, folder)
    return read_motion(folder / "motion.dump", COLUMNS)[1]


def pressed_lattice(nudge):
    """In a periodic box by 1e-3 of a diameter; with random velocities [m/s]. Returns spheres and period."""
    side = 6
    period = side * 2 * RADIUS * (1 - 1e-3)
    sites = np.stack(np.meshgrid(*3 * [np.arange(side)]), -1).reshape(-1, 3) * period / side + 1e-4
    velocity = nudge * np.random.default_rng(1).normal(size=sites.shape)
    return [Sphere(tuple(x), tuple(v), radius=RADIUS) for x, v in zip(sites, velocity)], period


@pytest.mark.parametrize("nt", [1, 1.5, 3])
@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_pressed_lattice_rests(tmp_path, restitution, nt):
    spheres, period = pressed_lattice(0.0)
    energy = energies(move(tmp_path, spheres, nt, restitution, 60, period), period)
    assert energy[0, 1] > 0.0
    assert energy[:, 0].max() < ROUNDING**2 * energy[0, 1]


@pytest.mark.parametrize("restitution", [0.5, 0.9])
def test_pressed_lattice_buckles_without_gain(tmp_path, restitution):
    spheres, period = pressed_lattice(1e-3)
    energy = energies(move(tmp_path, spheres, 3, restitution, 120, period), period)
    total = energy.sum(axis=1)
    assert energy[:, 0].max() > 0.1 * total[0], "it did not buckle"
    assert total.max() < total[0] * (1 + ROUNDING)


@pytest.mark.parametrize("restitution", [0.5, 0.7, 0.9, 0.95])
def test_crowds_that_meet(tmp_path, restitution):
    """Two blocks of 64 spheres that touch each other, in order, meet face to face at some part of a step. The overlaps
    of a crowd are those of softer contacts, so the elastic energy of the law counts more than there is; below the step
    of which the report warns it shows."""
    random = np.random.default_rng(3)
    block = np.stack(np.meshgrid(*3 * [np.arange(4) - 1.5]), -1).reshape(-1, 3) * 2 * RADIUS * (1 + 1e-9)
    spheres = []
    for side in (-1, 1):
        away = np.array([side * (4 * RADIUS + 0.4 * TC * random.uniform()), 0.0, 0.0])
        spheres += [Sphere(tuple(x + away), (-0.2 * side, 0.0, 0.0), radius=RADIUS) for x in block]
    keeps_from = max(4.0, sqrt(2 / (1 - restitution)))  # as the report has it
    energy = {nt: energies(move(tmp_path, spheres, nt, restitution, 60)) for nt in (2, 3, keeps_from)}
    right = energies(move(tmp_path, spheres, 50, restitution, 60, predict=""))[-1, 0]
    assert right < 0.95 * energy[3][0, 0], "they did not meet"
    for found in energy.values():
        assert found[:, 0].max() < found[0, 0] * (1 + ROUNDING)
    assert abs(energy[3][-1].sum() / right - 1) < 0.05
    assert energy[keeps_from].sum(axis=1).max() < energy[keeps_from][0].sum() * (1 + ROUNDING)
