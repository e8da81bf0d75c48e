# SPDX-License-Identifier: GPL-2.0-or-later
"""A bed on a vibrated plate: mean height and granular temperature with the time step, stock and predicted."""

from pathlib import Path

import ensemble
import numpy as np
from averages import difference

DECK = Path(__file__).resolve().parent / "in.vibrated"
REFERENCE = ("stock", 100)
QUANTITIES = ("height", "temperature")
NTS = {
    "stock": (30, 10, 6, 4, 3),
    "exact": (30, 10, 6),
    "exact onset on": (30, 10, 8, 6, 4),
    "rk4": (10,),
    "rk4 onset on": (10, 8, 6),
    "trapezoid onset on": (6, 4),
    "rk2 onset on": (6, 4),
    "impulse": (10, 6, 4, 3, 2, 1),
}
QUICK = ("exact onset on", "impulse")
PERIODS = {False: (5, 20), True: (3, 8)}  # from and to which means are taken, by whether a coarse answer will do


def run_of(method, nt, seed, quick):
    style = {"style": "stock"} if method == "stock" else {"style": "cfpm", "predict": method}
    begin, end = PERIODS[quick]
    variables = {**style, "nt": nt, "begin": begin, "end": end, "seed": seed}
    return ensemble.Run("lammps", DECK, variables, cost=nt)


def means(result):
    """Over time, of the QUANTITIES; NaN if it blew up."""
    if result.blown_up:
        return [np.nan] * len(QUANTITIES)
    table = np.genfromtxt(result.folder / "vibrated.csv", delimiter=",", names=True)
    return [table[name].mean() for name in QUANTITIES]


def compare(exhibit, nts, seeds):
    """{(method, nt): by how much a quantity is off at most, beyond two standard errors [percent]}.

    Every start is a run of its own: bed and plate forget how they began, so that the errors are of two ensembles.
    """
    cases = [(method, nt) for method, values in nts.items() for nt in values]
    wanted = [REFERENCE, *cases]
    runs = [run_of(*case, seed, exhibit.quick) for case in wanted for seed in seeds]
    results = ensemble.run(runs, exhibit.runs, "vibrated beds")
    found = np.array([means(r) for r in results]).reshape(len(wanted), len(seeds), len(QUANTITIES))
    by_case = dict(zip(wanted, found))

    rows, beyond = [], {}
    for case in cases:
        off = [difference(by_case[case][:, k], by_case[REFERENCE][:, k]) for k in range(len(QUANTITIES))]
        rows.append([*case, *(f"{value:.3g}" for pair in off for value in pair)])
        beyond[case] = max(abs(mean) - 2.0 * error for mean, error in off)
    header = ["method", "nt", *(f"{q}_{what}" for q in QUANTITIES for what in ("percent", "percent_error"))]
    exhibit.csv("vibrated", header, rows)
    begin, end = PERIODS[exhibit.quick]
    reference = [f"{by_case[REFERENCE][:, k].mean():.3g}" for k in range(len(QUANTITIES))]
    exhibit.text(
        f"""A bed of 5 layers on a plate that swings with an amplitude of half a diameter and 3 times the acceleration
        of gravity: mean height and granular temperature, more than with stock at nt = {REFERENCE[1]} (there
        {reference[0]} diameters, {reference[1]} m g d), in percent, over periods {begin} to {end}, with standard errors
        over {len(seeds)} starts."""
    )
    exhibit.table(
        ["method", "nt", *QUANTITIES],
        [[*row[:2], f"{row[2]} +- {row[3]}", f"{row[4]} +- {row[5]}"] for row in rows],
    )
    return beyond
