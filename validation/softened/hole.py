# SPDX-License-Identifier: GPL-2.0-or-later
"""Discharge from a hole in LIGGGHTS: how many spheres come out."""

import sys
from pathlib import Path

import ensemble
import numpy as np
from case import BLEW_UP, Case, resting
from harness.decks import MESH
from packing import WEIGHT

sys.path.insert(0, str(MESH.parent))
import floor_with_hole  # noqa: E402

DECK = Path(__file__).resolve().parent / "in.outflow"
SPACING = 0.051  # of the lattice that the bed is made of [m]
HOLE = 0.15  # radius [m]
BEGIN = 0.2  # from when on those are counted that come out [s]


class Hole(Case):
    name = "hole"
    title = "Discharge from a hole, LIGGGHTS"
    host = "liggghts"
    figures = {"flow": 3.0}

    def __init__(self, quick):
        super().__init__(quick)
        self.size = {"columns": 8, "layers": 4} if quick else {"columns": 10, "layers": 16}
        self.durations = (0.2, 0.5) if quick else (0.8, 1.2)  # [s]
        self.spheres = self.size["columns"] ** 2 * self.size["layers"]
        self.text = f"""{self.spheres} spheres over a floor, a mesh, with a hole of {2 * HOLE:g} m, 6 diameters; the
            same beds for all, of stock with small steps. Flow: the number that comes out between {BEGIN:g} and
            {self.durations[1]:g} s. Linear contacts, gamma = 1, mu = 0.3, no tangential dashpot."""

    def floor(self):
        """The file of the mesh, made anew."""
        file = self.folder / f"floor-{self.size['columns']}.stl"
        file.write_text(floor_with_hole.stl(self.size["columns"] * SPACING, HOLE))
        return file

    def bed(self, seed):
        variables = {"phase": "settle", "style": "stock", "nt": 30, "seed": seed, "duration": self.durations[0]}
        return ensemble.Run(self.host, DECK, {**variables, **self.size}, keep=("*.csv", "bed.data"))

    def settled(self, result):
        energy = np.genfromtxt(result.folder / "outflow.csv", delimiter=",", skip_header=1).T[1]
        return resting(energy[-1], self.spheres, WEIGHT / 9.81, 0.05)

    def run(self, setting, seed, bed):
        variables = {"phase": "open", **setting.variables(), "bed": bed, "mesh": self.floor()}
        return ensemble.Run(self.host, DECK, {**variables, "duration": self.durations[1]}, setting.cost(self.exponent))

    def read(self, result):
        time, energy, out = np.genfromtxt(result.folder / "outflow.csv", delimiter=",", skip_header=1).T
        # who falls freely from the start has at most this; a joule for what the bed may have had
        if not np.all(energy <= self.spheres * WEIGHT * 9.81 / 2 * time**2 + 1.0):
            return BLEW_UP
        return {"flow": np.diff(np.interp([BEGIN, self.durations[1]], time, out))[0]}


CASES = [Hole]
