# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the decks in.discharge, the settled beds that they start from, and what they leave behind."""

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "packing"))
import packing  # noqa: E402
from packing import WEIGHT, ensemble  # noqa: E402
from harness.decks import MESH, deck  # noqa: E402, ensemble has put it on the path
from harness.discharge import RADIUS, heights  # noqa: E402

FALL = 1.0 - RADIUS  # the centre of a sphere that leaves has come down so far below the floor [m]
BED_NT = 30  # of the conventional method, which settles the beds
SETTLED = 0.01  # largest kinetic energy of a bed [J]; the discharge reaches a thousand times that


@dataclass
class Discharge:
    time: np.ndarray  # [s]
    energy: np.ndarray  # kinetic, translation and rotation [J]
    count: np.ndarray  # discharged spheres
    start: np.ndarray  # heights of the spheres in the bed [m]
    run: ensemble.Result

    @property
    def blown_up(self):
        """The host stopped, or the spheres had more kinetic energy than gravity can have given them by then.

        None of them falls faster than freely, or farther than to where it leaves. The deck lets spheres be lost, so the
        host itself stops for coordinates that are no numbers only.
        """
        fallen = np.minimum(9.81 / 2 * self.time[:, None] ** 2, self.start + FALL)
        bound = SETTLED + WEIGHT * fallen.sum(axis=1)
        return self.run.blown_up or not np.all(self.energy <= bound)

    def number(self, times):
        """Discharged by then."""
        return np.interp(times, self.time, self.count)

    def time_of(self, number):
        """When so many were out; NaN if that many never were."""
        out = self.count >= number
        return self.time[np.argmax(out)] if out.any() else np.nan


def settling(host, dashpot, seed):
    """The run that makes a bed."""
    run = packing.settling(host, "stock", BED_NT, seed, dashpot, bed=1)
    return replace(run, keep=(*run.keep, "*.data"))


def bed(result):
    """The file with a settled bed."""
    settled = packing.read(result)
    if settled.blown_up or settled.energy[-1] > SETTLED:
        sys.exit(f"the bed in {result.folder} has not settled: {settled.energy[-1]:.2g} J, allowed {SETTLED:g} J")
    return result.folder / "packing.data"


def discharging(host, start, **variables):
    """The run from a bed. variables: further ones of the deck."""
    mesh = {"mesh": MESH} if host == "liggghts" else {}
    return ensemble.Run(host, deck(host, "discharge"), {"bed": start, **mesh, **variables}, cost=variables["nt"])


def read(result, start):
    table = np.genfromtxt(result.folder / "discharge.csv", delimiter=",", skip_header=1, ndmin=2)
    return Discharge(*table.T, heights(start), result)
