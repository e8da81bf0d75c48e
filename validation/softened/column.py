# SPDX-License-Identifier: GPL-2.0-or-later
"""A deep column in LAMMPS: what the floor bears, and how far the spheres overlap."""

from pathlib import Path

import ensemble
import numpy as np
from case import BLEW_UP, Case
from harness.output import read_dump, vectors
from packing import WEIGHT
from scipy.spatial import cKDTree

DECK = Path(__file__).resolve().parent / "in.column"
DIAMETER = 0.05  # [m]
SPACING = 0.051  # of the lattice that it is made of [m]
THIRDS = "lower", "middle", "upper"


def overlaps(places):
    """Mean overlap of the pairs that touch, in diameters, in each of the THIRDS. places: (spheres, 3) [m]."""
    i, j = cKDTree(places).query_pairs(DIAMETER, output_type="ndarray").T
    depth = 1 - np.linalg.norm(places[i] - places[j], axis=1) / DIAMETER
    height = (places[i, 2] + places[j, 2]) / 2
    edges = np.quantile(places[:, 2], (1 / 3, 2 / 3))
    return [depth[np.digitize(height, edges) == third].mean() for third in range(len(THIRDS))]


class Column(Case):
    host = "lammps"
    starts = {"full": 12, "quick": 2}

    def __init__(self, quick):
        super().__init__(quick)
        self.size = {"layers": 5, "settle": 0.2, "duration": 0.1} if quick else {"layers": 45}
        self.layers = self.size["layers"]
        self.text = f"""{self.layers} layers of spheres in a cylinder 8 diameters wide on a rough floor. Each
            setting makes its own bed of a loose lattice; then the wall creeps upwards by a quarter of a diameter, so
            that its friction bears what it can. Linear contacts, gamma = 1, mu = 0.3, no tangential dashpot."""

    def run(self, setting, seed, bed):
        variables = {**setting.variables(), "seed": seed, **self.size}
        return ensemble.Run(self.host, DECK, variables, setting.cost(self.exponent), keep=("*.csv", "end.dump"))

    def read(self, result):
        _, energy, load = np.genfromtxt(result.folder / "column.csv", delimiter=",", skip_header=1).T
        ((_, end),) = read_dump(result.folder / "end.dump")
        spheres = len(end["id"])
        if not np.all(energy <= spheres * (WEIGHT * self.layers * SPACING / 2 + 0.5 * WEIGHT / 9.81)):
            return BLEW_UP
        return self.look(load, vectors(end, "x", "y", "z"))

    def look(self, load, places):
        """{figure: value}. load: on the floor, over the weight, at all times."""
        raise NotImplementedError


class Stress(Column):
    name = "column-stress"
    title = "Deep column, bottom stress, LAMMPS"
    figures = {"bottom stress": 3.0}

    def look(self, load, places):
        return {"bottom stress": load[len(load) // 2 :].mean()}


class Overlaps(Column):
    name = "column-overlaps"
    title = "Deep column, overlaps, LAMMPS"
    figures = {f"overlap, {third} third": 3.0 for third in THIRDS}

    def look(self, load, places):
        return dict(zip(self.figures, overlaps(places)))


CASES = [Stress, Overlaps]
