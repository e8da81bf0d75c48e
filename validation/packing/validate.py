# SPDX-License-Identifier: GPL-2.0-or-later
"""Packing (section 3.2.1, Figs 7 and 8): packing ratio and kinetic energy over the time step, as ensembles.

A bed is chaotic: one run scatters by about 1 %, so every case is run from many random starts and the packing ratios
are averaged. Each host runs both methods with one law of friction (cases.py).

Finished runs are kept; the same command goes on after an interruption, and more seeds add to what is there.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import packing
from ratios import BAND, Reference, converged, last_change, ratio, settle

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from averages import difference, mean_and_error  # noqa: E402
from cases import DASHPOT, EXACT, HOSTS, IMPULSE, ONE_LAW, RK4, SIGMA, STOCK  # noqa: E402
from cases import Case, add_arguments, limits, number, report_limits, starts  # noqa: E402
from exhibit import Exhibit  # noqa: E402

METHODS = STOCK, EXACT, RK4
PAPER = {STOCK: 300, EXACT: 30, RK4: 30}  # the nt from which the packing ratio is constant in the paper's Fig. 8

NT = (1, 1.5, 2, 3, 4, 6, 10, 30, 100, 300)
QUICK_NT = (1.5, 3, 6, 30)
LARGE = (100, 300)  # whose stock runs are the reference
STABLE = 3  # from here on cfpm must not blow up
IN_BOTH_HOSTS = (3, 6)  # with one law, dashpot off
# LIGGGHTS, dashpot on: stock comes to its limit late, as the force has a jump where the spring slides
OTHER_LAW = ((STOCK, 60), (STOCK, 200), (EXACT, 30), (EXACT, 6), (EXACT, 3), (IMPULSE, 10), (IMPULSE, 3), (IMPULSE, 1))
SHOWN = (1.5, 3, 6, 30, 300)  # in Fig. 7, of which the paper has 1.5 and 3 (new), 3, 6 and 300 (conventional)

FEW_SEEDS = 8  # for the comparison of the hosts
SEEDS = {"full": 12, "quick": 3}


def plan(exhibit):
    """{case: number of random starts}"""
    seeds = starts(exhibit, **SEEDS)
    methods, nts = ((STOCK, EXACT), QUICK_NT) if exhibit.quick else (METHODS, NT)
    hosts = exhibit.arguments.hosts
    cases = {Case(host, DASHPOT[host], method, nt): seeds for nt in nts for method in methods for host in hosts}
    if "liggghts" in hosts and not exhibit.quick:
        cases |= {Case("liggghts", "on", method, nt): seeds for method, nt in OTHER_LAW}
    if len(hosts) == len(HOSTS):
        cases |= {Case(host, "off", EXACT, nt): max(seeds, FEW_SEEDS) for nt in IN_BOTH_HOSTS for host in hosts}
    return cases, methods, nts


def explain(exhibit, references, hosts):
    apart = ""
    if other := references.get(("liggghts", "on")):
        apart = f"LIGGGHTS has its law with the dashpot too; reference: nt = {other.nt}."
    exhibit.text(
        f"""200 spheres fall from up to 1 m and settle for 1.2 s. {ONE_LAW}
        Packing ratio: mean and standard error over the random starts. Reference: the conventional method of the same
        host and law at nt = {references[hosts[0], DASHPOT[hosts[0]]].nt}, differences paired by start.
        {apart}
        A run blew up if particles were lost or had more kinetic energy than the fall can give; such runs are left out
        of the means. Overlap: the largest at any of the 240 times that a run writes, in percent of a radius. Last
        change: of the packing ratio in the last sixth of the run, for whether 1.2 s are enough. CPU times only
        indicate: as many runs as cores were under way at a time, on a machine that others may use."""
    )


def summarise(exhibit, outcomes, references):
    """One row per case in the CSV file and in the table."""
    rows, shown = [], []
    for case, outcome in sorted(outcomes.items(), key=lambda item: item[0].order()):
        mean, error = mean_and_error(outcome.values(ratio))
        law = references.get(case[:2])
        d, d_error = law.difference(outcome) if law else (np.nan, np.nan)
        overlap = outcome.mean(lambda p: 100 * p.overlap.max())
        change = outcome.mean(last_change)
        steps, cpu = outcome.mean(lambda p: p.run.steps), outcome.mean(lambda p: p.run.cpu_seconds)
        count = len(outcome.runs)
        rows.append([*case, count, outcome.blown_up, mean, error, d, d_error, overlap, change, steps, cpu])
        shown.append(
            [f"{case.host}, dashpot {case.dashpot}", case.method, f"{case.nt:g}", f"{outcome.blown_up} of {count}"]
            + [number(mean, ".4f", error), number(d, "+.2f", d_error), number(overlap, ".2f")]
            + [number(change, "+.3f"), number(steps, ".0f"), number(cpu, ".1f")]
        )
    names = """host dashpot method nt runs blown_up ratio ratio_error difference_percent difference_error
        largest_overlap_percent last_change_percent steps cpu_seconds"""
    exhibit.csv("packing", names.split(), [[f"{x:.6g}" if isinstance(x, float) else x for x in row] for row in rows])
    exhibit.table(
        ["law", "method", "nt", "blown up", "packing ratio", "minus reference, %", "overlap, %", "last change, %"]
        + ["steps", "CPU s"],
        shown,
    )


def plot_energy(outcomes, hosts):
    """The paper's Fig. 7: one start, conventional and new side by side."""
    figure, panels = plt.subplots(len(hosts), 2, figsize=(11, 4 * len(hosts)), sharex=True, sharey=True, squeeze=False)
    for row, host in zip(panels, hosts):
        for axes, method in zip(row, (STOCK, EXACT)):
            for k, nt in enumerate(SHOWN):
                if outcome := outcomes.get(Case(host, DASHPOT[host], method, nt)):
                    p = outcome.runs[0]
                    label = f"nt = {nt:g}" + (", blew up" if p.blown_up else "")
                    axes.plot(p.time, p.energy, color=f"C{k}", linewidth=1.2, label=label)
            axes.set(title=f"{HOSTS[host]}: {method}", xlim=(0, 0.8), ylim=(0, 25))
            axes.legend(fontsize=8)
            axes.grid(alpha=0.3)
        row[0].set(ylabel="Kinetic energy, J")
    for axes in panels[-1]:
        axes.set(xlabel="Time, s")
    figure.tight_layout()
    return figure


def write_energy(exhibit, outcomes):
    """The curves of Fig. 7, on a common grid of times; empty after a run blew up."""
    shown = [case for case in outcomes if case.nt in SHOWN and case.method != RK4]
    cases = [case for case in shown if case.dashpot == DASHPOT[case.host]]
    first = [outcomes[case].runs[0] for case in cases]
    grid = np.linspace(0.02, 0.8, 40)
    curves = [np.interp(grid, p.time, p.energy, right=np.nan) for p in first]
    exhibit.curves("energy", grid, {f"{case.host} {case.method} nt={case.nt:g}": c for case, c in zip(cases, curves)})


def plot_ratio(outcomes, references, hosts, methods):
    """The paper's Fig. 8, a panel for each host; cases of which runs blew up are hollow."""
    figure, panels = plt.subplots(1, len(hosts), figsize=(5.5 * len(hosts), 4.2), sharey=True, squeeze=False)
    for axes, host in zip(panels[0], hosts):
        mean, error = mean_and_error(references[host, DASHPOT[host]].ratios)
        axes.axhspan(mean - SIGMA * error, mean + SIGMA * error, color="0.9", label="reference +- 2 standard errors")
        for k, method in enumerate(methods):
            style = {"color": ("C0", "C3", "C1")[k], "marker": "sod"[k], "linestyle": "none", "capsize": 3}
            for hollow in (False, True):
                points = [
                    (case.nt * 1.04 ** (k - 1), *mean_and_error(outcome.values(ratio)))
                    for case, outcome in outcomes.items()
                    if case[:3] == (host, DASHPOT[host], method) and (outcome.blown_up > 0) == hollow
                ]
                if points := [point for point in points if np.isfinite(point[1])]:
                    nt, mean, error = np.transpose(points)
                    fill = {"markerfacecolor": "none"} if hollow else {"label": method}
                    axes.errorbar(nt, mean, np.nan_to_num(error), **style, **fill)
        axes.set(title=HOSTS[host], xscale="log", xlabel="nt", xlim=(1, 10000), ylim=(0.55, 0.62))
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    panels[0, 0].set(ylabel="Packing ratio")
    figure.tight_layout()
    return figure


def judge(exhibit, outcomes, references, hosts, methods, nts):
    """For each method: from which nt on it is stable, and the packing ratio that of small steps."""
    found = {}
    for host in hosts:
        reference = references[host, DASHPOT[host]]
        for method in methods:
            own = {nt: outcomes[Case(host, DASHPOT[host], method, nt)] for nt in sorted(nts)}
            good = {nt: converged(outcome, reference) for nt, outcome in own.items()}
            found[host, DASHPOT[host], method] = stable, smallest, lasting = limits(
                {nt: outcome.blown_up == 0 for nt, outcome in own.items()}, good
            )
            if method != STOCK:
                exhibit.verdict(f"{HOSTS[host]}, {method}: no run blew up at nt >= {STABLE}", stable <= STABLE)
            if exhibit.quick:
                worst = max(abs(reference.difference(own[nt])[0]) for nt in own if nt > STABLE)
                exhibit.verdict(
                    f"{HOSTS[host]}, {method}: packing ratio off by {worst:.1f} % at most at nt > {STABLE}, allowed 3 "
                    "% for so few runs",
                    worst <= 3,
                )
            else:
                exhibit.verdict(
                    f"{HOSTS[host]}, {method}: packing ratio within {BAND} % and {SIGMA} standard errors of the "
                    f"reference at nt = {number(smallest, 'g')} (and at all larger ones from {number(lasting, 'g')}); "
                    f"in the paper at {PAPER[method]}",
                    smallest <= PAPER[method],
                )
    exhibit.text(
        f"""Smallest nt of those that were run: from which on no run blew up; whose packing ratio is within {BAND} % of
        the reference and not distinguishable from it at {SIGMA} standard errors; from which on this holds at all nt.
        A true agreement fails the last now and then, as {SIGMA} standard errors are asked of every nt. The paper's
        entry is read from its text on Fig. 8."""
    )
    report_limits(exhibit, found, ["stable from", "ratio agrees at", "at all from", "paper"], paper=PAPER)


def compare_hosts(exhibit, outcomes):
    """Both hosts' cfpm with one law. Their random starts are made differently, so nothing is paired."""
    allowed = 3 if exhibit.quick else SIGMA  # a quick answer is a test, which chance should not fail
    for nt in IN_BOTH_HOSTS:
        ours, theirs = (outcomes[Case(host, "off", EXACT, nt)].values(ratio) for host in ("lammps", "liggghts"))
        d, error = difference(ours, theirs)
        exhibit.verdict(
            f"{EXACT}, nt = {nt}, dashpot off: LAMMPS's packing ratio minus LIGGGHTS's {d:+.2f} +- {error:.2f} % over "
            f"{len(ours)} starts each, allowed {allowed} standard errors",
            abs(d) <= allowed * error,
        )


def main():
    title = "Packing (section 3.2.1, Figs 7 and 8)"
    exhibit = Exhibit(title, __doc__, lambda parser: add_arguments(parser, **SEEDS))
    hosts = exhibit.arguments.hosts
    cases, methods, nts = plan(exhibit)
    outcomes = settle(cases, packing.primes(max(cases.values())), exhibit.runs, "packing, runs")
    laws = dict.fromkeys(case[:2] for case in outcomes if case.method == STOCK)
    references = {law: Reference(outcomes, *law, STOCK, LARGE) for law in laws}

    explain(exhibit, references, hosts)
    summarise(exhibit, outcomes, references)
    exhibit.plot(
        plot_energy(outcomes, hosts),
        "energy",
        "Kinetic energy of all particles, one start, on the axes of the paper's Fig. 7.",
    )
    exhibit.plot(
        plot_ratio(outcomes, references, hosts, methods),
        "ratio",
        "Packing ratio and standard error over nt, on the axes of the paper's Fig. 8. Hollow: some runs blew up.",
    )
    write_energy(exhibit, outcomes)
    judge(exhibit, outcomes, references, hosts, methods, nts)
    if len(hosts) == len(HOSTS):
        compare_hosts(exhibit, outcomes)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
