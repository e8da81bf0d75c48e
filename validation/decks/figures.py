# SPDX-License-Identifier: GPL-2.0-or-later
"""What a dump of any deck tells of its particles, and whether two sets of starts tell the same."""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy import stats

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness.output import read_dump, vectors  # noqa: E402

LEVEL = 0.01  # how likely at least one figure of a deck is found to differ where none does


def read(dump, granular):
    """{figure: (value, how much it changes in one step)}: of the last snapshot, or the mean over all of them.

    A time is known to a step only, as counts of steps are whole numbers, so figures of runs with different steps cannot
    agree better than to their change in one.
    """
    snapshots = [(step, columns) for step, columns in read_dump(dump) if len(columns["id"])]
    if len(snapshots) < 2:
        return {"particles": (float(sum(len(columns["id"]) for _, columns in snapshots)), 0.0)}
    steps = [step for step, _ in snapshots]
    found = {}
    for name, (values, mean) in series([columns for _, columns in snapshots], granular).items():
        if mean:
            value, change = np.mean(values), (values[-1] - values[0]) / (steps[-1] - steps[0])
        else:
            value, change = values[-1], (values[-1] - values[-2]) / (steps[-1] - steps[-2])
        found[name] = (float(value), abs(float(change)))
    return found


def series(snapshots, granular):
    """{figure: (its values, whether their mean over time is compared; else the last one)}."""
    found = {
        "particles": ([float(len(s["id"])) for s in snapshots], False),
        "kinetic energy": ([energy(s, granular) for s in snapshots], True),
        "largest speed": ([np.linalg.norm(vectors(s, "vx", "vy", "vz"), axis=1).max() for s in snapshots], True),
    }
    for axis in "xyz":
        found[f"centre of mass {axis}"] = ([np.average(s[axis], weights=s["mass"]) for s in snapshots], False)
    for name in (name for name in snapshots[0] if name.startswith("f_")):
        found[f"mean {name}"] = ([s[name].mean() for s in snapshots], False)
        found[f"spread {name}"] = ([s[name].std() for s in snapshots], False)
    return found


def energy(s, granular):
    """Kinetic, of motion and of the spin of spheres."""
    total = 0.5 * np.sum(s["mass"] * np.sum(vectors(s, "vx", "vy", "vz") ** 2, axis=1))
    if granular:
        spin = np.sum(vectors(s, "omegax", "omegay", "omegaz") ** 2, axis=1)
        total += 0.2 * np.sum(s["mass"] * s["radius"] ** 2 * spin)
    return float(total)


class Difference(NamedTuple):
    figure: str
    value: float  # mean over starts less that of the others
    error: float  # its standard error, from the scatter of both over starts
    allowed: float  # how large chance makes it at most

    @property
    def differs(self):
        return not abs(self.value) <= self.allowed

    def __str__(self):
        return f"{self.figure} {self.value:+.3g} +- {self.error:.2g}"


def compare(found, others):
    """The Difference of each figure; both: figures of at least two starts, as many of one as of the other."""
    names = [name for name in others[0] if all(name in one for one in (*found, *others))]
    # Student's quantile of two samples of n, two-sided, shared among the figures (Bonferroni)
    n = len(found)
    quantile = stats.t.ppf(1.0 - 0.5 * LEVEL / len(names), 2 * n - 2)
    differences = []
    for name in names:
        a, b = (np.array([one[name] for one in group]) for group in (found, others))
        error = np.sqrt((a[:, 0].var(ddof=1) + b[:, 0].var(ddof=1)) / n)
        step = max(a[:, 1].mean(), b[:, 1].mean())
        value = a[:, 0].mean() - b[:, 0].mean()
        differences.append(Difference(name, float(value), float(error), float(quantile * error + step)))
    return differences
