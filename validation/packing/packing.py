# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the decks in.packing and what they leave behind."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import ensemble  # noqa: E402
from harness.decks import deck  # noqa: E402, ensemble has put it on the path

SPHERES = 200  # without another n
WEIGHT = 800 * 4 / 3 * np.pi * 0.025**3 * 9.81  # of a sphere [N]
DECKS = {host: deck(host, "packing") for host in ensemble.HOSTS}


@dataclass
class Packing:
    time: np.ndarray  # [s]
    energy: np.ndarray  # kinetic, translation and rotation [J]
    ratio: np.ndarray  # packing ratio N Vs/(2 A mean height)
    overlap: np.ndarray  # largest of all pairs, in radii
    run: ensemble.Result
    spheres: int = SPHERES

    @property
    def blown_up(self):
        """Particles were lost, or had more kinetic energy than the fall can give, m g H/2 for a uniform column."""
        bound = self.spheres * WEIGHT * 1.0 / 2
        return self.run.blown_up or not self.energy.max() <= bound


def settling(host, style, nt, seed, dashpot="on", **variables):
    """One run. variables: further ones of the deck."""
    variables = {"style": style, "nt": nt, "seed": seed, "dashpot": dashpot, **variables}
    return ensemble.Run(host, DECKS[host], variables, cost=nt)


def read(result, spheres=SPHERES):
    table = np.genfromtxt(result.folder / "packing.csv", delimiter=",", skip_header=1, ndmin=2)
    return Packing(*table.T, result, spheres)


def primes(count, first=15485863):
    """Seeds that the hosts accept: primes above 10000, spread out from the first on, which is odd."""
    found = []
    candidate = first
    while len(found) < count:
        if all(candidate % k for k in range(3, int(candidate**0.5) + 1, 2)):
            found.append(candidate)
            candidate += 10000
        candidate += 2
    return found
