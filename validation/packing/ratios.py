# SPDX-License-Identifier: GPL-2.0-or-later
"""Packing ratios of an ensemble beside those of small steps."""

import numpy as np
import packing
from averages import paired_difference
from cases import SIGMA, Outcome, execute

BAND = 0.5  # percent


def ratio(p):
    """At the end."""
    return p.ratio[-1]


def last_change(p):
    """Of the packing ratio during the last sixth of the run, in percent."""
    return 100 * (p.ratio[-1] / np.interp(p.time[-1] * 5 / 6, p.time, p.ratio) - 1)


def settle(cases, seeds, runs_folder, what):
    """{case: Outcome}. cases: {case: number of random starts}; seeds: of these starts."""

    def make_run(case, k):
        return packing.settling(case.host, seed=seeds[k], **case.variables())

    results = execute(cases, make_run, runs_folder, what)
    return {case: Outcome([packing.read(result) for result in own]) for case, own in results.items()}


class Reference:
    """A method at large nt, pooled, of one host and law; at the largest if none of these was run."""

    def __init__(self, outcomes, host, dashpot, method, large):
        own = {case.nt: o for case, o in outcomes.items() if case[:3] == (host, dashpot, method)}
        large = [nt for nt in large if nt in own] or [max(own)]
        self.ratios = np.mean([own[nt].values(ratio) for nt in large], axis=0)  # for each start
        self.nt = " and ".join(f"{nt:g}" for nt in large)

    def difference(self, outcome):
        """Of an outcome to this, in percent, and its standard error; starts that only one of them has are left out."""
        ratios = outcome.values(ratio)
        count = min(len(ratios), len(self.ratios))
        return paired_difference(ratios[:count], self.ratios[:count])


def converged(outcome, reference):
    d, error = reference.difference(outcome)
    return outcome.blown_up == 0 and abs(d) <= BAND and abs(d) <= SIGMA * error
