# SPDX-License-Identifier: GPL-2.0-or-later
"""Why the packing ratio needs far smaller steps in the paper than here: its Fig. 8 with other readings of the paper.

The paper calls the second-order Adams-Bashforth method conventional; the hosts have velocity Verlet. Here the stock
LAMMPS settles the same beds with Adams-Bashforth, its own styles and a small integrator for its fix python/move. The
paper does not say either which mass its damping is made of: two other readings are run.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "packing")]
import ensemble  # noqa: E402
import packing  # noqa: E402
from averages import mean_and_error, paired_difference  # noqa: E402
from cases import DASHPOT, EXACT, SIGMA, STOCK, Case, Outcome, execute, from_which_on, number  # noqa: E402
from exhibit import Exhibit  # noqa: E402

HOST = "lammps"  # whose stock style has the paper's law of friction
VERLET, AB2, CFPM = "velocity Verlet", "Adams-Bashforth", "cfpm exact"
METHODS = {AB2: STOCK, VERLET: STOCK, CFPM: EXACT}
NT = (3, 6, 10, 30, 100, 300)
QUICK_NT = (6, 30)
AS_IN_DECKS = "gamma sqrt(m k)"
DAMPING = {"gamma sqrt(m* k)": np.sqrt(0.5), "2 gamma sqrt(m* k)": np.sqrt(2.0)}  # eta over that of the decks
DAMPING_NT = (3, 6, 30)
ROUGH = 30


class Reading(NamedTuple):
    damping: str
    method: str
    nt: float


def changed_deck(folder, name, changes):
    """The packing deck with some of its words replaced."""
    text = packing.DECKS[HOST].read_text()
    for old, new in changes.items():
        assert text.count(old) == 1, f"the deck has '{old}' {text.count(old)} times"
        text = text.replace(old, new)
    folder.mkdir(parents=True, exist_ok=True)
    deck = folder / f"in.packing-{name}"
    deck.write_text(text)
    return deck


def make_decks(folder):
    """{(damping, method): deck} where it is not the usual one."""
    integrator = (HERE / "adams_bashforth.py").read_text()
    changes = {
        "units           si\n": f'python AdamsBashforth here """\n{integrator}"""\nunits           si\n',
        "fix integrate all nve/sphere": "fix integrate all python/move AdamsBashforth",
        "atom_modify     map array": "atom_modify     map array sort 0 0",
    }
    decks = {(AS_IN_DECKS, AB2): changed_deck(folder, "adams-bashforth", changes)}
    eta = "variable eta      equal "
    for damping, factor in DAMPING.items():
        deck = changed_deck(folder, f"damping-{factor:.3f}", {eta: f"{eta}{factor:.15g}*"})
        decks |= {(damping, method): deck for method in (VERLET, CFPM)}
    return decks


def settle(readings, decks, folder):
    """{reading: final packing ratios, NaN where a run blew up}. readings: {reading: number of starts}"""
    seeds = packing.primes(max(readings.values()))

    def make_run(reading, k):
        case = Case(HOST, DASHPOT[HOST], METHODS[reading.method], reading.nt)
        deck = decks.get((reading.damping, reading.method))
        usual = packing.settling(HOST, seed=seeds[k], **case.variables())
        return ensemble.Run(HOST, deck, usual.variables, usual.cost) if deck else usual

    found = execute(readings, make_run, folder, "readings, runs")
    beds = {reading: Outcome([packing.read(one) for one in results]) for reading, results in found.items()}
    return {reading: outcome.values(lambda bed: bed.ratio[-1]) for reading, outcome in beds.items()}


def told(values):
    blown_up = np.count_nonzero(np.isnan(values))
    mean = number(mean_and_error(values)[0], ".4f", mean_and_error(values)[1])
    return f"{mean}, {blown_up} of {len(values)} blew up" if blown_up else mean


def plot(ratios, nts):
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for k, method in enumerate(METHODS):
        own = [(nt * 1.04 ** (k - 1), ratios[AS_IN_DECKS, method, nt]) for nt in nts]
        points = [(nt, *mean_and_error(values)) for nt, values in own if np.isfinite(values).all()]
        axes.errorbar(*np.transpose(points), fmt="sod"[k], capsize=3, label=method)
    axes.set(xscale="log", xlabel="nt", ylabel="Packing ratio", xlim=(1, 10000), ylim=(0.55, 0.62))
    axes.legend()
    axes.grid(alpha=0.3)
    figure.tight_layout()
    return figure


def judge(exhibit, ratios, nts):
    """How far each method is from small steps of velocity Verlet, which all of them tend to."""
    small = ratios[AS_IN_DECKS, VERLET, max(nts)]
    off = {(m, nt): paired_difference(ratios[AS_IN_DECKS, m, nt], small) for m in METHODS for nt in nts}
    alike = {m: from_which_on({nt: abs(off[m, nt][0]) <= SIGMA * off[m, nt][1] for nt in nts}) for m in METHODS}
    exhibit.text(
        f"""The same in percent of velocity Verlet's at nt = {max(nts)}, paired by start, and the nt from which on
        {SIGMA} standard errors do not tell them apart. The paper's Fig. 8 is constant from 300 on for its conventional
        method, from 30 on for the new one."""
    )
    exhibit.table(
        ["method", *(f"nt = {nt}" for nt in nts), "alike from nt ="],
        [[m, *(number(off[m, nt][0], "+.2f", off[m, nt][1]) for nt in nts), number(alike[m], "g")] for m in METHODS],
    )
    rough = [off[AB2, nt] for nt in nts if nt <= ROUGH and np.isfinite(off[AB2, nt][0])]
    worst, error = max(rough, key=lambda found: found[0])
    exhibit.verdict(
        f"{AB2} packs up to {worst:.1f} +- {error:.1f} % too densely at nt <= {ROUGH}: with it a large step shows, as "
        "in the paper's Fig. 8",
        worst > (0 if exhibit.quick else SIGMA * error),
    )


def tell_damping(exhibit, ratios):
    exhibit.text(
        f"""Damping: the decks read the paper's eta as {AS_IN_DECKS} with the particle's mass, which fits its Figs 3-5.
        With either other reading:"""
    )
    exhibit.table(
        ["eta", "method", *(f"nt = {nt}" for nt in DAMPING_NT)],
        [
            [damping, method, *(told(ratios[damping, method, nt]) for nt in DAMPING_NT)]
            for damping in DAMPING
            for method in (VERLET, CFPM)
        ],
    )


def add_arguments(parser):
    parser.add_argument("--seeds", type=int, help="random starts of each case (default 8, quick 2)")


def main():
    exhibit = Exhibit("Fig. 8 read again: conventional method and damping", __doc__, add_arguments)
    seeds = exhibit.arguments.seeds or (2 if exhibit.quick else 8)
    nts = QUICK_NT if exhibit.quick else NT
    readings = {Reading(AS_IN_DECKS, method, nt): seeds for nt in nts for method in METHODS}
    if not exhibit.quick:
        readings |= {Reading(d, m, nt): seeds for d in DAMPING for m in (VERLET, CFPM) for nt in DAMPING_NT}
    ratios = settle(readings, make_decks(exhibit.out), exhibit.runs)

    exhibit.text(
        f"""Packing ratio, mean and standard error over {seeds} random starts, in the stock LAMMPS with the paper's law
        of friction. The paper compares its method with Adams-Bashforth; here all three start from the same places."""
    )
    exhibit.table(
        ["method", *(f"nt = {nt}" for nt in nts)],
        [[method, *(told(ratios[AS_IN_DECKS, method, nt]) for nt in nts)] for method in METHODS],
    )
    exhibit.plot(plot(ratios, nts), "ratio", "Packing ratio over nt on the axes of the paper's Fig. 8.")
    judge(exhibit, ratios, nts)
    if not exhibit.quick:
        tell_damping(exhibit, ratios)
    rows = [
        [*reading, len(values), np.count_nonzero(np.isnan(values)), *(f"{x:.5f}" for x in mean_and_error(values))]
        for reading, values in ratios.items()
    ]
    exhibit.csv("readings", ["damping", "method", "nt", "runs", "blown_up", "ratio", "ratio_error"], rows)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
