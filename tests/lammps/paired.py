# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares two runs from one start particle by particle, long after rounding errors have made them two.

The mean of N differences whose standard deviation is s scatters by s/sqrt(N) if they are independent. Particles that
flow beside each other are not: so blocks of sqrt(N) neighbours count as one each, by their mean. Four times what
results is allowed, beside what the two schemes themselves make different.
"""

from math import isqrt

import numpy as np
from harness.output import vectors

SIGMAS = 4.0


def mass(snapshot):
    """For a density of 1."""
    return 4.0 / 3.0 * np.pi * snapshot["radius"] ** 3


def kinetic_energy(snapshot):
    return 0.5 * mass(snapshot) * (vectors(snapshot, "vx", "vy", "vz") ** 2).sum(axis=1)


def assert_same_mean(stock, cfpm, order, of_schemes, what):
    """stock, cfpm: a value of every particle in the same order; order: a number of each, by which neighbours lie beside
    each other, as its height; of_schemes: the difference that they may make."""
    difference = cfpm - stock
    blocks = np.array_split(difference[np.argsort(order)], isqrt(len(difference)))
    independent = difference.std() / np.sqrt(len(difference))
    scatter = max(independent, np.std([block.mean() for block in blocks], ddof=1) / np.sqrt(len(blocks)))
    report = f"{what}: stock {stock.mean():.4g}, cfpm {cfpm.mean():.4g}, "
    report += f"scatter {scatter:.2g}, if independent {independent:.2g}, schemes {of_schemes:.2g}"
    print(report)
    assert abs(difference.mean()) <= SIGMAS * scatter + of_schemes, report
