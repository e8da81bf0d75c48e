# SPDX-License-Identifier: GPL-2.0-or-later
"""Flow down a rough chute in LAMMPS: how fast."""

import ensemble
import numpy as np
from case import BLEW_UP, Case
from harness.decks import deck

SLOPE = np.radians(26.0)
LAYER = 722  # spheres


class Chute(Case):
    name = "chute"
    title = "Chute flow, LAMMPS"
    host = "lammps"
    figures = {"mean velocity": 3.0}

    def __init__(self, quick):
        super().__init__(quick)
        self.layers, self.duration = (2, 1.0) if quick else (8, 8.0)
        self.text = f"""{self.layers * LAYER} spheres in {self.layers} layers start from rest on a base of frozen ones,
            26 degrees steep (inputs/lammps/in.chute): mean velocity over the second half of {self.duration:g}
            sqrt(d/g). Linear contacts, mu = 0.5, no tangential dashpot of its own."""

    def run(self, setting, seed, bed):
        variables = {**setting.variables(), "seed": seed, "layers": self.layers, "duration": self.duration}
        return ensemble.Run(self.host, deck("lammps", "chute"), variables, cost=setting.cost(self.exponent))

    def read(self, result):
        time, energy, along, _, height = np.genfromtxt(result.folder / "chute.csv", delimiter=",", skip_header=1).T
        mass = np.pi / 6 * self.layers * LAYER
        way = np.concatenate([[0], np.cumsum(np.diff(time) * (along[1:] + along[:-1]) / 2)])
        # what gravity has given them, along and across the chute; a twentieth more for the start and the sampling
        given = mass * (np.sin(SLOPE) * way + np.cos(SLOPE) * (self.layers / 2 + 1 - height))
        if not np.all(energy <= 1.05 * given + 0.05 * mass):
            return BLEW_UP
        return {"mean velocity": along[time > self.duration / 2].mean()}


CASES = [Chute]
