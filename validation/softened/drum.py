# SPDX-License-Identifier: GPL-2.0-or-later
"""A drum with a mesh wall in LIGGGHTS: the power that it takes, and how fast the spheres move."""

from math import cos, pi, sin
from pathlib import Path

import ensemble
import numpy as np
import settings
from case import BLEW_UP, Case
from packing import WEIGHT

DECK = Path(__file__).resolve().parent / "in.drum"
RADIUS, DEPTH = 0.6, 6 * 0.051  # of the drum, along its axis [m]
FACETS = 60


def stl():
    """The shell, FACETS quadrangles of two triangles each that reach through the periodic cell."""
    rim = [(RADIUS * cos(2 * pi * k / FACETS), RADIUS * sin(2 * pi * k / FACETS)) for k in range(FACETS)]
    lines = ["solid drum"]
    for (x, z), (x_next, z_next) in zip(rim, [*rim[1:], rim[0]]):
        near, far, near_next, far_next = ((x, 0, z), (x, DEPTH, z), (x_next, 0, z_next), (x_next, DEPTH, z_next))
        for triangle in ((near, far, far_next), (near, far_next, near_next)):
            lines += [f"facet normal {-x / RADIUS:.6f} 0 {-z / RADIUS:.6f}", "outer loop"]
            lines += ["vertex {:.10f} {:.10f} {:.10f}".format(*corner) for corner in triangle]
            lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid drum"]) + "\n"


class Drum(Case):
    name = "drum"
    title = "Drum with a mesh wall, Hertz, LIGGGHTS"
    host = "liggghts"
    figures = {"power": 3.0, "kinetic energy": 3.0}
    methods = settings.HERTZ
    exponent = 0.4  # a Hertz contact lasts as k^(-2/5)

    def __init__(self, quick):
        super().__init__(quick)
        self.duration = 0.1 if quick else 2.0  # [s]
        self.text = f"""About 1000 spheres in a drum of {2 * RADIUS:g} m, a mesh of {2 * FACETS} triangles that turns in
            3 s, periodic along its axis: power, by how far aside the centre of mass is, and kinetic energy, means over
            the second half of {self.duration:g} s. Hertz contacts, E = 2 GPa before it is divided, e = 0.5, mu = 0.5,
            no tangential dashpot; nt of an impact at 1 m/s."""

    def run(self, setting, seed, bed):
        mesh = self.folder / "drum.stl"
        mesh.write_text(stl())
        variables = {**setting.variables(), "seed": seed, "mesh": mesh, "duration": self.duration}
        return ensemble.Run(self.host, DECK, variables, setting.cost(self.exponent))

    def read(self, result):
        time, energy, aside = np.genfromtxt(result.folder / "drum.csv", delimiter=",", skip_header=1).T
        # as if all fell from the axis to the shell
        if not np.all(energy <= 1500 * WEIGHT * RADIUS):
            return BLEW_UP
        later = time > self.duration / 2
        return {"power": aside[later].mean(), "kinetic energy": energy[later].mean()}


CASES = [Drum]
