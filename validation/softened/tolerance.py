# SPDX-License-Identifier: GPL-2.0-or-later
"""When the results of a setting count as those of the reference: one rule for everyone.

Both are run from the same n starts, which gives n differences with mean d and standard error s; T is the tolerance. A
setting is **within** it if |d| + t s < T, with t the 95 % quantile of Student's distribution with n - 1 degrees of
freedom: two one-sided tests (D. J. Schuirmann, J. Pharmacokinet. Biopharm. 15, 657, 1987). One whose true difference is
T or more then passes in less than 5 % of all cases, whatever n and s are. With |d| < T alone it would pass in half of
them at T, and the more often beyond it the more its runs scatter. It is **outside** if |d| - t s > T. In between it is
not known well enough, which is as good as outside: who has to rely on it cannot.
"""

from typing import NamedTuple

import numpy as np
from averages import paired_difference
from scipy.stats import t as student

CONFIDENCE = 0.95


class Difference(NamedTuple):
    """To the reference, in percent of it."""

    mean: float
    error: float  # of the mean
    starts: int

    @property
    def margin(self):
        """What the true difference may be beside the mean."""
        return student.ppf(CONFIDENCE, self.starts - 1) * self.error

    def within(self, tolerance):
        return bool(abs(self.mean) + self.margin < tolerance)

    def outside(self, tolerance):
        return bool(abs(self.mean) - self.margin > tolerance)


def difference(values, reference):
    """Both: one value for each start, in the same order."""
    values, reference = np.asarray(values, dtype=float), np.asarray(reference, dtype=float)
    return Difference(*paired_difference(values, reference), len(values))


def ratio_and_interval(values, others):
    """Geometric mean of the ratios value/other, start by start, and its 95 % confidence interval (two-sided)."""
    logarithms = np.log(np.asarray(values, dtype=float) / np.asarray(others, dtype=float))
    count = len(logarithms)
    margin = student.ppf((1 + CONFIDENCE) / 2, count - 1) * logarithms.std(ddof=1) / np.sqrt(count)
    return tuple(np.exp(logarithms.mean() + np.array([0, -margin, margin])))
