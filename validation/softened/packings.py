# SPDX-License-Identifier: GPL-2.0-or-later
"""The packing of both hosts: spheres fall and come to rest, and the density of the bed is looked at."""

import packing
from case import BLEW_UP, SHAKES, Case, resting
from cases import DASHPOT, HOSTS
from settings import STOCK, Setting

SPHERES = {False: 800, True: 60}  # quick: True
SAMPLES = 24  # so few that the output costs nothing


class Packing(Case):
    figures = {"packing ratio": 0.5}
    starts = {"full": 16, "quick": 2}

    def __init__(self, host, quick):
        # with a dashpot in friction the steps of stock must be smaller (./cfpm validate packing)
        self.reference = Setting(STOCK, 1, {"off": 40, "on": 100}[DASHPOT[host]])
        super().__init__(quick)
        self.host = host
        self.spheres = SPHERES[quick]
        self.name = f"packing-{host}"
        self.title = f"Packing, {HOSTS[host]}"
        self.text = f"""{self.spheres} spheres fall from up to 1 m and come to rest in 1.2 s (inputs/{host}/in.packing):
            density of the bed. Linear contacts, gamma = 1, mu = 0.3."""

    def run(self, setting, seed, bed):
        short = {"duration": 0.5} if self.quick else {}
        variables = {**setting.variables(), "n": self.spheres, "samples": SAMPLES, **short}
        return packing.settling(self.host, seed=seed, dashpot=DASHPOT[self.host], **variables)

    def read(self, result):
        bed = packing.read(result, self.spheres)
        if bed.blown_up:
            return BLEW_UP
        if not self.quick and not resting(bed.energy[-1], self.spheres, packing.WEIGHT / 9.81, 0.05):
            return SHAKES
        return {"packing ratio": bed.ratio[-1]}


CASES = [lambda quick, host=host: Packing(host, quick) for host in HOSTS]
