# SPDX-License-Identifier: GPL-2.0-or-later
"""Agitated grains with the time step, stock and every predictor: how a gas cools by its collisions, and a bed that is
vibrated.

512 grains of restitution 0.9 in a periodic box of LAMMPS at two solid fractions, from random velocities. The energy
that is left at two times is compared with that of stock's smallest step, paired by start. Then a bed, see vibrated.py.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "packing")]
import ensemble  # noqa: E402
import packing  # noqa: E402
import vibrated  # noqa: E402
from averages import mean_and_error  # noqa: E402
from cases import starts  # noqa: E402
from exhibit import Exhibit  # noqa: E402

DECK = HERE / "in.gas"
FRACTIONS = {0.34: 1.15, 0.49: 1.02}  # solid fraction: spacing of the start
TIMES = (0.5, 1.0)
REFERENCE = ("stock", 100)
RIGHT = 3.0  # percent
# from which nt on it is right, as in the methods' rows (src/core/predict, src/core/method/method.h)
RIGHT_FROM = {
    "stock": 6,
    "exact": 30,
    "trapezoid": 30,
    "rk2": 30,
    "rk4": 30,
    "exact onset on": 6,
    "trapezoid onset on": 4,
    "rk2 onset on": 4,
    "rk4 onset on": 6,
    "impulse": 4,
}
NTS = {
    "stock": (30, 10, 6, 4, 3),
    "exact": (60, 30, 20, 10, 6),
    "trapezoid": (30, 10),
    "rk2": (30, 10),
    "rk4": (30, 10, 6),
    "exact onset on": (30, 20, 10, 8, 6, 4),
    "trapezoid onset on": (30, 10, 8, 6, 4),
    "rk2 onset on": (30, 10, 8, 6, 4),
    "rk4 onset on": (30, 10, 8, 6),
    "impulse": (30, 10, 6, 4, 3, 2, 1.5, 1),
}
QUICK = [method for method in RIGHT_FROM if "onset" not in method or method.startswith("exact")]
SEEDS = {"full": 8, "quick": 3}


def add_arguments(parser):
    parser.add_argument("--seeds", type=int, help="random starts (default {full}, quick {quick})".format(**SEEDS))


def run_of(method, nt, fraction, seed):
    style = {"style": "stock"} if method == "stock" else {"style": "cfpm", "predict": method}
    variables = {**style, "nt": nt, "spacing": FRACTIONS[fraction], "seed": seed}
    return ensemble.Run("lammps", DECK, variables, cost=nt)


def energies(result):
    """What is left of the energy at the TIMES; NaN if it blew up."""
    if result.blown_up:
        return [np.nan] * len(TIMES)
    table = np.genfromtxt(result.folder / "gas.csv", delimiter=",", names=True)
    return np.interp(TIMES, table["time"], table["energy"]) / table["energy"][0]


def main():
    exhibit = Exhibit("Agitated grains: the cooling of a gas", __doc__, add_arguments)
    seeds = packing.primes(starts(exhibit, **SEEDS), 10007)
    nts = {method: (RIGHT_FROM[method],) for method in QUICK} if exhibit.quick else NTS
    cases = [(method, nt, f) for f in FRACTIONS for method, values in nts.items() for nt in values]
    wanted = [(*REFERENCE, f) for f in FRACTIONS] + cases
    runs = [run_of(*case, seed) for case in wanted for seed in seeds]
    results = ensemble.run(runs, exhibit.runs, "cooling gases")
    left = np.array([energies(r) for r in results]).reshape(len(wanted), len(seeds), len(TIMES))
    by_case = dict(zip(wanted, left))

    rows, worst = [], {}
    for case in cases:
        method, nt, fraction = case
        percent = 100.0 * (by_case[case] / by_case[(*REFERENCE, fraction)] - 1.0)
        found = [mean_and_error(percent[:, k]) for k in range(len(TIMES))]
        rows.append([fraction, method, nt, *(f"{value:.3g}" for pair in found for value in pair)])
        excess = max(abs(mean) - 2.0 * error for mean, error in found)
        worst[method, nt] = max(worst.get((method, nt), 0.0), excess)
    header = ["solid_fraction", "method", "nt"]
    header += [f"{what}_at_{time}" for time in TIMES for what in ("percent", "percent_error")]
    exhibit.csv("gas", header, rows)
    exhibit.text(
        f"""Energy that is left, more than with stock at nt = {REFERENCE[1]}, in percent, with standard errors over
        {len(seeds)} starts, at two times; by then about 78 and 90 % are lost at the lower solid fraction, 95 and 98 %
        at the higher one."""
    )
    exhibit.table(["solid fraction", "method", "nt", *(f"t = {t}" for t in TIMES)],
                  [[*row[:3], f"{row[3]} +- {row[4]}", f"{row[5]} +- {row[6]}"] for row in rows])
    for method in nts:
        least = RIGHT_FROM[method]
        right = all(worst[method, nt] <= RIGHT for nt in nts[method] if nt >= least)
        exhibit.verdict(f"{method} is within {RIGHT:g} % and two standard errors from nt = {least} on", right)

    nts = {method: (RIGHT_FROM[method],) for method in vibrated.QUICK} if exhibit.quick else vibrated.NTS
    beyond = vibrated.compare(exhibit, nts, seeds[:2] if exhibit.quick else seeds)
    for method, values in nts.items():
        judged = [beyond[method, nt] for nt in values if nt >= RIGHT_FROM[method]]
        if judged:
            exhibit.verdict(f"in the vibrated bed {method} is so too", max(judged) <= RIGHT)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
