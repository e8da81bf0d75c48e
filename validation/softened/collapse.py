# SPDX-License-Identifier: GPL-2.0-or-later
"""Collapse of a column of spheres in LAMMPS: how far it runs out, how high it stays."""

from pathlib import Path

import ensemble
import numpy as np
from case import BLEW_UP, Case, resting
from harness.output import read_dump
from packing import WEIGHT

DECK = Path(__file__).resolve().parent / "in.collapse"
SPACING = 0.051  # of the lattice that the column is made of [m]
COLUMNS, DEPTH = 10, 6  # of it
WITHIN = 0.95  # of the spheres lie within the run-out: the last few roll on by themselves
NEAR = 4 * 0.05  # the height is that of the spheres within this of the wall [m]


class Collapse(Case):
    name = "collapse"
    title = "Column collapse, LAMMPS"
    host = "lammps"
    figures = {"run-out": 3.0, "height": 3.0}

    def __init__(self, quick):
        super().__init__(quick)
        self.size = {"layers": 4, "columns": COLUMNS, "length": 30} if quick else {"layers": 20, "columns": COLUMNS}
        self.durations = (0.1, 0.1) if quick else (0.6, 1.6)  # [s]
        self.spheres = COLUMNS * DEPTH * self.size["layers"]
        self.text = f"""{self.spheres} spheres, {COLUMNS} wide and {self.size["layers"]} high, fall over a
            rough base of frozen ones when their gate is taken away; the same beds for all, of stock with small steps.
            After {self.durations[1]:g} s: run-out, the way beyond the gate within which {100 * WITHIN:g} % of the
            spheres lie, and height, twice the mean height of those within 4 diameters of the wall. Linear contacts,
            gamma = 1, mu = 0.3, no tangential dashpot."""

    def bed(self, seed):
        variables = {"phase": "settle", "style": "stock", "nt": 30, "seed": seed, "duration": self.durations[0]}
        return ensemble.Run(self.host, DECK, {**variables, **self.size}, keep=("*.csv", "bed.data"))

    def settled(self, result):
        return resting(self.energy(result)[-1], self.spheres, WEIGHT / 9.81, 0.05)

    def energy(self, result):
        """Kinetic, over time [J]."""
        return np.genfromtxt(result.folder / "collapse.csv", delimiter=",", skip_header=1).T[1]

    def run(self, setting, seed, bed):
        variables = {"phase": "fall", **setting.variables(), "bed": bed, "duration": self.durations[1], **self.size}
        return ensemble.Run(self.host, DECK, variables, setting.cost(self.exponent), keep=("*.csv", "end.dump"))

    def read(self, result):
        # of the whole column, if it fell to the base
        if not np.all(self.energy(result) <= self.spheres * WEIGHT * self.size["layers"] * SPACING / 2):
            return BLEW_UP
        ((_, end),) = read_dump(result.folder / "end.dump")
        x, z = end["x"], end["z"] - SPACING  # over the cells of the base
        return {"run-out": np.quantile(x, WITHIN) - COLUMNS * SPACING, "height": 2 * z[x < NEAR].mean()}


CASES = [Collapse]
