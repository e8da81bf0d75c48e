# SPDX-License-Identifier: GPL-2.0-or-later
"""Discharge: what the exact collision of a contact changes in the number that flows out, over the time step."""

import matplotlib.pyplot as plt
import numpy as np
import outlet
from averages import mean_and_error
from cases import DASHPOT, EXACT, HOSTS, IMPULSE, SIGMA, SPLIT, STOCK, Case, limits, number, report_limits
from outflow import BAND, END, GRID, JUDGED, QUANTITIES, REFERENCE, compare, discharge, scatter

HOST = "liggghts"
METHODS = STOCK, EXACT, IMPULSE, SPLIT
NEW = IMPULSE, SPLIT
NT = (1, 1.5, 2, 3, 6, 30)
QUICK_NT = (1, 3)
QUICK_REFERENCE = 6


def run(exhibit, seeds):
    nts, reference = (QUICK_NT, QUICK_REFERENCE) if exhibit.quick else (NT, REFERENCE)
    cases = [Case(HOST, DASHPOT[HOST], method, nt) for method in METHODS for nt in nts]
    cases = dict.fromkeys([*cases, Case(HOST, DASHPOT[HOST], STOCK, reference)], len(seeds))
    comparisons = compare(discharge(cases, seeds, exhibit.runs, "beyond, discharge"), reference)

    explain(exhibit, comparisons, len(seeds), reference)
    tell(exhibit, comparisons)
    exhibit.plot(
        plot(comparisons, nts),
        "discharge",
        f"Number discharged minus that of the conventional method at nt = {reference} from the same beds, mean and "
        "its standard error as a band. Cases of which a run blew up are left out.",
    )
    write_curves(exhibit, comparisons)
    judge(exhibit, comparisons, nts)


def explain(exhibit, comparisons, seeds, reference):
    told = ", ".join(f"{SIGMA * scatter(comparisons, q) / np.sqrt(seeds):.1f} % {q}" for q in JUDGED)
    exhibit.text(
        f"""**Discharge.** An outlet of 0.2 m opens under {seeds} beds that the conventional method has settled at nt
        = {outlet.BED_NT} from the same starts; {HOSTS[HOST]}, so that all methods have one law. Number discharged
        minus that of the conventional method at nt = {reference} from the same beds, in spheres, and in percent of it;
        means and standard errors, or how many runs blew up: the spheres moved too far in a step, or had more kinetic
        energy than they could have by falling freely. So many beds tell a difference of {told} ({SIGMA} standard
        errors)."""
    )


def tell(exhibit, comparisons):
    rows, shown = [], []
    for case, compared in comparisons.items():
        outcome = compared.outcome
        spheres, percent = ([f(name) for name in QUANTITIES] for f in (compared.spheres, compared.percent))
        numbers = [x for pair in zip(spheres, percent) for values in pair for x in values]
        rows.append([*case, len(outcome.runs), outcome.blown_up, *("" if x != x else f"{x:.4g}" for x in numbers)])
        cells = [f"{number(s, '+.1f', se)} ({number(p, '+.1f', pe)} %)" for (s, se), (p, pe) in zip(spheres, percent)]
        if outcome.blown_up:
            cells = [f"{outcome.blown_up} of {len(outcome.runs)} blew up"] + ["-"] * (len(cells) - 1)
        if outcome is not compared.reference:
            shown.append([case.method, f"{case.nt:g}", *cells])
    kinds = [kind + error for kind in ("difference", "percent") for error in ("", " error")]
    columns = [f"{kind} {quantity}".replace(" ", "_") for quantity in QUANTITIES for kind in kinds]
    exhibit.csv("discharge", ["host", "dashpot", "method", "nt", "runs", "blown_up", *columns], rows)
    exhibit.table(["method", "nt", *QUANTITIES], shown)


def curve(compared):
    """Difference over GRID: mean and standard error."""
    pairs = zip(compared.outcome.runs, compared.reference.runs)
    differences = np.transpose([ours.number(GRID) - theirs.number(GRID) for ours, theirs in pairs])
    return np.transpose([mean_and_error(at_a_time) for at_a_time in differences])


def kept(comparisons):
    """Those of which a difference over time can be drawn."""
    return {c: x for c, x in comparisons.items() if not x.outcome.blown_up and x.outcome is not x.reference}


def plot(comparisons, nts):
    figure, panels = plt.subplots(2, 2, figsize=(11, 7.5), sharex=True, sharey=True)
    for axes, method in zip(panels.flat, METHODS):
        for case, compared in kept(comparisons).items():
            if case.method == method:
                color = f"C{nts.index(case.nt)}"
                mean, error = curve(compared)
                axes.plot(GRID, mean, color=color, linewidth=1.2, label=f"nt = {case.nt:g}")
                axes.fill_between(GRID, mean - error, mean + error, color=color, alpha=0.2)
        axes.set(title=method, xlim=(0, END))
        if axes.lines:
            axes.legend(fontsize=8, loc="upper left")
        axes.grid(alpha=0.3)
    for axes in panels[:, 0]:
        axes.set(ylabel="Number discharged minus reference")
    for axes in panels[1]:
        axes.set(xlabel="Time, s")
    figure.tight_layout()
    return figure


def write_curves(exhibit, comparisons):
    curves = {}
    for case, compared in kept(comparisons).items():
        mean, error = curve(compared)
        name = f"{case.method} nt={case.nt:g}"
        curves |= {name: mean[10::10], f"{name} error": error[10::10]}
    exhibit.curves("discharge-curves", GRID[10::10], curves)


def judge(exhibit, comparisons, nts):
    found = {}
    for method in METHODS:
        own = {nt: comparisons[Case(HOST, DASHPOT[HOST], method, nt)] for nt in nts}
        stable = {nt: compared.outcome.blown_up == 0 for nt, compared in own.items()}
        found[HOST, DASHPOT[HOST], method] = limits(stable, {nt: compared.agrees() for nt, compared in own.items()})
    exhibit.text(
        f"""Smallest nt of those that were run: from which on no run blew up; whose number discharged is within {BAND}
        % of the reference and not distinguishable from it at {SIGMA} standard errors, {" and ".join(JUDGED)}; from
        which on this holds at all nt."""
    )
    report_limits(exhibit, found, ["stable from", "number agrees at", "at all from"], "discharge-limits")
    exact = found[HOST, DASHPOT[HOST], EXACT]
    for method in NEW:
        stable, agrees, lasting = found[HOST, DASHPOT[HOST], method]
        exhibit.verdict(
            f"discharge, {method}: no run blew up from nt = {number(stable, 'g')} on; {EXACT}: "
            f"{number(exact.stable_from, 'g')}",
            stable <= exact.stable_from,
        )
        if not exhibit.quick:
            exhibit.verdict(
                f"discharge, {method}: number discharged that of the reference at nt = {number(agrees, 'g')} (and at "
                f"all larger ones from {number(lasting, 'g')}); {EXACT}: {number(exact.agrees_at, 'g')}",
                agrees <= exact.agrees_at,
            )
