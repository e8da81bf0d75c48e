# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the deck in.statics from the states that should stay as they are, and what they leave behind."""

import sys
from dataclasses import dataclass
from functools import cached_property
from math import pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "discharge")]
import outlet  # noqa: E402
from outlet import ensemble, packing  # noqa: E402

# which ensemble has put on the path
from harness.output import read_dump, vectors  # noqa: E402
from harness.spheres import Sphere, write_data  # noqa: E402

HOST = "liggghts"
DECK = HERE / "in.statics"
COLUMNS = ("xu", "yu", "zu", "vx", "vy", "vz")

# as in the deck
G = 9.81
TC = 2.0e-4  # of a pair [s]
RADIUS, DENSITY = 0.025, 800.0
DIAMETER = 2 * RADIUS
M = Sphere((0.0, 0.0, 0.0), radius=RADIUS, density=DENSITY).mass
KN = M / 2 * (pi / TC) ** 2
KT = KN / (2 * (1 + 0.32))
ETA = sqrt(M * KN)
ETAT = ETA * sqrt(KT / KN)
MU = 0.3

SINK = M * G / KN  # overlap of a sphere at rest on the floor [m]
GAINED = DIAMETER / 500  # a state at rest that rises by this much at once is none

TYPES = 2  # of the spheres and of the floor

COLUMN = 10  # spheres above each other
ROW = 4  # spheres that make the block
BOND = 0.1  # stiffness of the contacts between them over that of the floor
PRESSED = 5  # the force between them, in weights of a sphere


class Method(NamedTuple):
    """How a contact acts over a step. predict: empty for the stock style with velocity Verlet."""

    predict: str = ""

    def __str__(self):
        return f"cfpm {self.predict}" if self.predict else "stock"

    def variables(self):
        return {"style": "cfpm", "predict": self.predict} if self.predict else {"style": "stock"}


STOCK = Method()


class Case(NamedTuple):
    method: Method
    nt: float
    angle: float = 0.0  # of the tilt [degrees]

    @property
    def dt(self):
        return TC / self.nt

    def gravity(self):
        angle = np.radians(self.angle)
        return G * np.array([np.sin(angle), 0.0, -np.cos(angle)])

    def run(self, start, duration, **variables):
        """From the data file start. variables: further ones of the deck."""
        own = {**self.method.variables(), "nt": self.nt, "angle": self.angle}
        variables = {**own, "start": start, "duration": duration, **variables}
        return ensemble.Run(HOST, DECK, variables, cost=self.nt, keep=("*.dump",))


@dataclass
class Motion:
    """From the tilt on."""

    case: Case
    run: ensemble.Result

    @cached_property
    def snapshots(self):
        """Times [s] and an array (times, spheres, COLUMNS). A run that stopped may have cut its last line off."""
        found = read_dump(self.run.folder / "statics.dump")
        times = self.case.dt * np.array([step for step, _ in found])
        return times, np.array([vectors(snapshot, *COLUMNS) for _, snapshot in found])

    @property
    def time(self):
        return self.snapshots[0]

    @property
    def x(self):
        """Positions, not wrapped into the box."""
        return self.snapshots[1][:, :, :3]

    @property
    def v(self):
        return self.snapshots[1][:, :, 3:]

    def kinetic(self):
        """Without spin."""
        return M / 2 * (self.v**2).sum(axis=(1, 2))

    def work(self):
        """Of gravity."""
        return M * ((self.x - self.x[0]) @ self.case.gravity()).sum(axis=1)

    @cached_property
    def blown_up(self):
        """The host stopped, or the spheres move faster than gravity can have made them.

        At rest they have next to no energy but that of their height.
        """
        if self.run.blown_up:
            return True
        allowed = M * G * GAINED * self.x.shape[1]
        return not np.all(self.kinetic() <= self.work() + allowed)

    def downhill(self):
        """How far the spheres are downhill from where they were at the tilt, their mean [m]."""
        return (self.x[:, :, 0] - self.x[0, :, 0]).mean(axis=1)


def execute(jobs, folder, what):
    """{key: Motion}. jobs: {key: (case, run)}"""
    results = ensemble.run([run for _, run in jobs.values()], folder, what)
    return {key: Motion(case, result) for (key, (case, _)), result in zip(jobs.items(), results)}


def beds(count, exhibit):
    """Data files of beds that the stock style has settled, with a type for the floor."""
    runs = [outlet.settling(HOST, "on", seed) for seed in packing.primes(count)]
    found = []
    for k, result in enumerate(ensemble.run(runs, exhibit.runs, "statics, beds")):
        found.append(exhibit.out / f"bed{k}.data")
        found[-1].write_text(outlet.bed(result).read_text().replace("1 atom types", f"{TYPES} atom types"))
    return found


def write_columns(path):
    """A sphere on the floor and, at its side, a column of them, pressed together as for small steps."""
    overlaps = SINK * np.arange(COLUMN, 0, -1)
    heights = RADIUS - overlaps[0] + np.concatenate([[0.0], np.cumsum(DIAMETER - overlaps[1:])])
    places = [(0.15, 0.3, RADIUS - SINK), *((0.45, 0.3, z) for z in heights)]
    write_data(path, [Sphere(x, radius=RADIUS, density=DENSITY) for x in places], low=0.0, high=0.6, types=TYPES)
    return path


def overlaps(heights):
    """Of the spheres of write_columns: the single sphere with the floor, then the column from the floor up."""
    single, column = heights[..., :1], heights[..., 1:]
    floor = [RADIUS - single, RADIUS - column[..., :1]]
    return np.concatenate([*floor, DIAMETER - np.diff(column, axis=-1)], axis=-1)


def write_block(path):
    """Spheres on the floor in a row along x that the periodic sides close, pressed together."""
    spacing = DIAMETER - PRESSED * SINK / BOND
    places = [((k + 0.5) * spacing, 0.1, RADIUS) for k in range(ROW)]
    spheres = [Sphere(x, radius=RADIUS, density=DENSITY) for x in places]
    write_data(path, spheres, low=0.0, high=ROW * spacing, types=TYPES)
    return path


def box_side(bed):
    """Of a data file: its length along x and along y."""
    sides = [line.split() for line in bed.read_text().splitlines() if line.endswith(("xlo xhi", "ylo yhi"))]
    return np.array([float(high) - float(low) for low, high, *_ in sides])


def total_energy(motion, side):
    """Kinetic, of gravity and elastic, at every time. side: of the periodic box, along x and y."""
    above, below = np.triu_indices(motion.x.shape[1], 1)
    elastic = []
    for x in motion.x:
        apart = x[above] - x[below]
        apart[:, :2] -= side * np.round(apart[:, :2] / side)
        pairs = np.maximum(0.0, DIAMETER - np.linalg.norm(apart, axis=1))
        floor = np.maximum(0.0, RADIUS - x[:, 2])
        elastic.append(KN / 2 * ((pairs**2).sum() + (floor**2).sum()))
    return motion.kinetic() - motion.work() + np.array(elastic)
