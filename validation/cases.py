# SPDX-License-Identifier: GPL-2.0-or-later
"""What the ensembles of packing and discharge share: laws, methods, cases and their outcomes.

The conventional method is the stock style of a host with nve/sphere.
"""

import sys
from typing import NamedTuple

import ensemble
import numpy as np
from averages import mean_and_error

NAMES = {"liggghts": "LIGGGHTS", "lammps": "LAMMPS"}
DASHPOT = {"liggghts": "off", "lammps": "on"}  # in friction, of which each host has its own law


def law_name(host, dashpot):
    return f"{NAMES[host]}, dashpot {dashpot}"


HOSTS = {host: law_name(host, dashpot) for host, dashpot in DASHPOT.items()}
ONE_LAW = """Each host runs both methods with its own law of friction: LIGGGHTS, which limits the spring's part to mu
    fn, without the tangential dashpot; LAMMPS, which limits the sum as the paper does (Eq. 10), with it."""
STOCK, EXACT, RK4 = "conventional", "cfpm exact", "cfpm rk4"
IMPULSE, SPLIT = "cfpm impulse", "cfpm impulse split 0.2"
METHODS = STOCK, EXACT, RK4, IMPULSE, SPLIT
SIGMA = 2


def predictor(method):
    """Of a predicted method, as the decks take it."""
    return method.removeprefix("cfpm ")


def style(method):
    """The variables of a deck that choose the method."""
    return {"style": "stock"} if method == STOCK else {"style": "cfpm", "predict": predictor(method)}


class Case(NamedTuple):
    host: str
    dashpot: str
    method: str
    nt: float

    def order(self):
        """In tables."""
        return list(HOSTS).index(self.host), self.dashpot, METHODS.index(self.method), self.nt

    def variables(self):
        """Of the deck."""
        return {"nt": self.nt, "dashpot": self.dashpot, **style(self.method)}


class Outcome:
    """A case over its starts. runs: as they were read; those that blew up have no values."""

    def __init__(self, runs):
        self.runs = runs
        self.blown_up = sum(run.blown_up for run in runs)

    def values(self, quantity):
        return np.array([np.nan if run.blown_up else quantity(run) for run in self.runs])

    def mean(self, quantity):
        """Over the runs that did not blow up."""
        return mean_and_error(self.values(quantity))[0]


def execute(cases, make_run, folder, what):
    """{case: results}. cases: {case: number of starts}; make_run(case, k): its run from start k.

    All cases of a start come before the next start.
    """
    jobs = [(case, k) for k in range(max(cases.values())) for case, count in cases.items() if k < count]
    results = ensemble.run([make_run(*job) for job in jobs], folder, what)
    found = {case: [] for case in cases}
    for (case, _), result in zip(jobs, results):
        found[case].append(result)
    return found


def from_which_on(good):
    """good: {nt: whether something holds}. The smallest nt from which on it holds at all; infinite if there is none."""
    return min((nt for nt in good if all(good[n] for n in good if n >= nt)), default=np.inf)


class Limits(NamedTuple):
    """Smallest nt of a method; infinite if there is none."""

    stable_from: float  # from here on no run blew up
    agrees_at: float  # here it gives what the reference gives
    agrees_from: float  # and from here on at all nt


def limits(stable, agrees):
    """Both: {nt: whether the method is so}."""
    smallest = min((nt for nt in agrees if agrees[nt]), default=np.inf)
    return Limits(from_which_on(stable), smallest, from_which_on(agrees))


def report_limits(exhibit, found, columns, name="limits", paper=None):
    """found: {(host, dashpot, method): Limits}; paper: {method: nt} for a last column.

    The CSV file is for exhibits that build on them.
    """
    rows = [[*case, *(f"{nt:g}" for nt in own)] for case, own in found.items()]
    exhibit.csv(name, ["host", "dashpot", "method", *Limits._fields], rows)
    exhibit.table(
        ["law", "method", *columns],
        [
            [law_name(*law), method, *(number(nt, "g") for nt in (*own, *([paper[method]] if paper else [])))]
            for (*law, method), own in found.items()
        ],
    )


def number(value, form, error=None):
    """As text, with its standard error if there is one, which a single run has not; "-" for none."""
    if not np.isfinite(value):
        return "-"
    known = error is not None and np.isfinite(error)
    return format(value, form) + (f" +- {error:{form.strip('+')}}" if known else "")


def add_arguments(parser, full, quick):
    """full, quick: how many random starts without --seeds."""
    parser.add_argument("--seeds", type=int, help=f"random starts of each case (default {full}, quick {quick})")
    parser.add_argument("--hosts", nargs="+", choices=HOSTS, default=list(HOSTS), help="default both")


def starts(exhibit, full, quick):
    """How many random starts each case has."""
    seeds = exhibit.arguments.seeds or (quick if exhibit.quick else full)
    if seeds < 2:
        sys.exit("validate: --seeds is below 2; expected enough for a standard error")
    return seeds
