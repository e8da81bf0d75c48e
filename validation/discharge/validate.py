# SPDX-License-Identifier: GPL-2.0-or-later
"""Discharge (section 3.2.2, Figs 9 and 10): number discharged and kinetic energy over the time step, as ensembles.

A discharge is chaotic: two runs from one bed soon go apart. So every case is run from many beds, and all cases of a
host from the same ones, which the conventional method has settled. Each host runs both methods with one law of friction
(cases.py).

Finished runs are kept; the same command goes on after an interruption, and more seeds add to what is there.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import outlet
from harness.discharge import SPHERES
from outflow import BAND, END, GRID, JUDGED, QUANTITIES, REFERENCE, compare, discharge, mean_curve, scatter

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from averages import mean_and_error  # noqa: E402
from cases import DASHPOT, EXACT, HOSTS, ONE_LAW, SIGMA, STOCK  # noqa: E402
from cases import Case, add_arguments, limits, number, report_limits, starts  # noqa: E402
from exhibit import Exhibit  # noqa: E402

METHODS = STOCK, EXACT
NT = {STOCK: (1.5, 3, 4, 6, 10, 30), EXACT: (1, 1.5, 2, 3, 4, 6, 10, 30)}
QUICK_NT = {STOCK: (3, 6, 30), EXACT: (1.5, 3, 6)}
SMALL = 300  # nt of the smallest step in the paper's figures; from one bed, for Fig. 9
SHOWN = (1.5, 2, 3, 6, 30, 300)  # in the plots, of which the paper has 1.5 and 3 (new), 3, 6 and 300 (conventional)
PAPER = {STOCK: 6, EXACT: 1.5}  # the smallest nt at which Figs 9 and 10 do not diverge
STABLE = {STOCK: 6, EXACT: 3}  # from here on no run must blow up
SEEDS = {"full": 24, "quick": 2}
ALIKE = {"full": 10, "quick": 30}  # percent: no big difference, which would show in Fig. 10


def plan(exhibit):
    """{case: number of beds}"""
    seeds = starts(exhibit, **SEEDS)
    nts = QUICK_NT if exhibit.quick else NT
    hosts = exhibit.arguments.hosts
    cases = {Case(host, DASHPOT[host], m, nt): seeds for m in METHODS for nt in nts[m] for host in hosts}
    if not exhibit.quick:
        cases = {Case(host, DASHPOT[host], STOCK, SMALL): 1 for host in hosts} | cases
    return cases, seeds


def explain(exhibit, comparisons, seeds):
    spread = {name: scatter(comparisons, name) for name in JUDGED}
    told = ", ".join(f"{s:.0f} % {name}" for name, s in spread.items())
    resolved = ", ".join(f"{SIGMA * s / np.sqrt(seeds):.1f} % {name}" for name, s in spread.items())
    exhibit.text(
        f"""An outlet of 0.2 m opens under {SPHERES} settled spheres; they fall to a lower floor 1 m below, where
        they leave. Discharged: all of the sphere is below the upper floor. {ONE_LAW} All cases of a host start from the
        same beds, made by the conventional method at nt = {outlet.BED_NT}; from {seeds} beds, but for nt = {SMALL},
        which is run from one for Fig. 9. Reference: the conventional method at nt = {REFERENCE}; differences paired by
        bed, means with standard errors. A run blew up if a coordinate was no number, or the spheres had more kinetic
        energy than all of them could have by falling freely since the start, each at most to where it leaves; such runs
        are left out of the means. CPU times only indicate: as many runs as cores were under way at a time, on a
        machine that others may use."""
    )
    exhibit.text(
        f"""Two runs from one bed that differ in step or method scatter: their numbers are apart by {told} (standard
        deviation). So {seeds} beds tell a difference of {resolved} ({SIGMA} standard errors), and the band within which
        numbers count as equal is {BAND} %."""
    )


def summarise(exhibit, comparisons):
    """One row per case in the CSV file and in two tables."""
    rows, counts, differences = [], [], []
    for case, compared in comparisons.items():
        outcome = compared.outcome
        means = [mean_and_error(outcome.values(quantity)) for quantity in QUANTITIES.values()]
        spheres, percent = ([f(name) for name in QUANTITIES] for f in (compared.spheres, compared.percent))
        half, half_error = mean_and_error(outcome.values(lambda d: d.time_of(SPHERES / 2)))
        peak, cpu = outcome.mean(lambda d: d.energy.max()), outcome.mean(lambda d: d.run.cpu_seconds)
        numbers = [x for triple in zip(means, spheres, percent) for pair in triple for x in pair]
        rows.append([*case, len(outcome.runs), outcome.blown_up, *numbers, half, half_error, peak, cpu])
        name = [f"{case.host}, dashpot {case.dashpot}", case.method, f"{case.nt:g}"]
        counts.append(
            [*name, f"{outcome.blown_up} of {len(outcome.runs)}", *(number(m, ".1f", e) for m, e in means)]
            + [number(half, ".3f", half_error), number(peak, ".1f"), number(cpu, ".1f")]
        )
        if outcome is not compared.reference and np.isfinite(spheres[0][0]):
            both = zip(spheres, percent)
            differences.append(
                [*name, *(f"{number(s, '+.1f', se)} ({number(p, '+.1f', pe)} %)" for (s, se), (p, pe) in both)]
            )
    kinds = [kind + error for kind in ("number", "difference", "percent") for error in ("", " error")]
    columns = [f"{kind} {quantity}".replace(" ", "_") for quantity in QUANTITIES for kind in kinds]
    exhibit.csv(
        "discharge",
        ["host", "dashpot", "method", "nt", "runs", "blown_up", *columns]
        + ["half_out_s", "half_out_error", "peak_energy_joule", "cpu_seconds"],
        [["" if x != x else f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows],
    )
    exhibit.text("Number discharged, and when half of the spheres are out:")
    exhibit.table(
        ["law", "method", "nt", "blown up", *QUANTITIES, "half out, s", "peak energy, J", "CPU s"],
        counts,
    )
    exhibit.text(f"Number discharged minus that of the conventional method at nt = {REFERENCE} from the same beds:")
    exhibit.table(["law", "method", "nt", *QUANTITIES], differences)


def panels(hosts, draw, ylabel, ylim, legend):
    """A row for each host, conventional and new side by side; draw(axes, case, color); legend: where it is."""
    figure, rows = plt.subplots(len(hosts), 2, figsize=(11, 4 * len(hosts)), sharex=True, sharey=True, squeeze=False)
    for row, host in zip(rows, hosts):
        for axes, method in zip(row, METHODS):
            for k, nt in enumerate(SHOWN):
                draw(axes, Case(host, DASHPOT[host], method, nt), f"C{k}")
            axes.set(title=f"{HOSTS[host]}: {method}", xlim=(0, END), ylim=ylim)
            axes.legend(fontsize=8, loc=legend)
            axes.grid(alpha=0.3)
        row[0].set(ylabel=ylabel)
    for axes in rows[-1]:
        axes.set(xlabel="Time, s")
    figure.tight_layout()
    return figure


def plot_energy(outcomes, hosts):
    """The paper's Fig. 9, from the first bed."""

    def draw(axes, case, color):
        if outcome := outcomes.get(case):
            d = outcome.runs[0]
            label = f"nt = {case.nt:g}" + (", blew up" if d.blown_up else "")
            energy = np.where(d.energy > 0, d.energy, np.nan)  # ends when the last sphere has left
            axes.plot([0, *d.time], [0, *energy], color=color, linewidth=1.2, label=label)

    figure = panels(hosts, draw, "Kinetic energy, J", (0, 18), "upper right")
    for axes in figure.axes:
        axes.axhline(6, color="0.4", linestyle="--", linewidth=0.8)
        axes.text(0, 6, " end of the paper's axis", color="0.4", fontsize=8, va="bottom")
    return figure


def plot_number(outcomes, hosts):
    """The paper's Fig. 10. A case with one bed has no band: left out."""

    def draw(axes, case, color):
        outcome = outcomes.get(case)
        if not outcome or len(outcome.runs) < 2:
            return
        mean, error = mean_curve(outcome)
        blown = f", {outcome.blown_up} of {len(outcome.runs)} blew up" if outcome.blown_up else ""
        line = ":" if outcome.blown_up == len(outcome.runs) else "-"
        axes.plot(GRID, mean, line, color=color, linewidth=1.2, label=f"nt = {case.nt:g}{blown}")
        if line == "-":
            axes.fill_between(GRID, mean - error, mean + error, color=color, alpha=0.2)

    return panels(hosts, draw, "Number of discharged particles", (0, 200), "lower right")


def write_curves(exhibit, outcomes):
    """The curves of Figs 9 and 10; of the energy only where nothing blew up."""
    shown = {case: outcomes[case] for case in outcomes if case.nt in SHOWN}
    names = {case: f"{case.host} {case.method} nt={case.nt:g}" for case in shown}
    sparse = GRID[5::5]
    energy = {names[c]: np.interp(sparse, o.runs[0].time, o.runs[0].energy) for c, o in shown.items() if not o.blown_up}
    exhibit.curves("energy", sparse, energy)
    numbers = {}
    for case, outcome in shown.items():
        if outcome.blown_up == 0 and len(outcome.runs) > 1:
            mean, error = mean_curve(outcome)
            numbers |= {names[case]: mean[10::10], f"{names[case]} error": error[10::10]}
    exhibit.curves("curves", GRID[10::10], numbers)


def judge(exhibit, comparisons, hosts):
    """For each method: from which nt on it is stable, and discharges what the reference does."""
    found = {}
    for host in hosts:
        for method in METHODS:
            law = host, DASHPOT[host], method
            own = {case.nt: c for case, c in comparisons.items() if case[:3] == law and case.nt != SMALL}
            good = {nt: compared.agrees() for nt, compared in own.items()}
            found[host, method] = limits({nt: compared.outcome.blown_up == 0 for nt, compared in own.items()}, good)
            stable, agreeing, _ = found[host, method]
            name = f"{HOSTS[host]}, {method}"
            exhibit.verdict(f"{name}: no run blew up at nt >= {STABLE[method]:g}", stable <= STABLE[method])
            if not exhibit.quick:
                exhibit.verdict(
                    f"{name}: number discharged within {BAND} % and {SIGMA} standard errors of the reference, "
                    f"{' and '.join(JUDGED)}, at nt = {number(agreeing, 'g')}",
                    agreeing <= STABLE[method],
                )
            apart(exhibit, name, {nt: compared for nt, compared in own.items() if nt >= stable})
    exhibit.text(
        f"""Smallest nt of those that were run: from which on no run blew up; whose number discharged is within {BAND} %
        of the reference and not distinguishable from it at {SIGMA} standard errors, {" and ".join(JUDGED)}; from which
        on this holds at all nt. A true agreement fails the last now and then, as {SIGMA} standard errors are asked of
        every nt. The paper's entry is the smallest nt at which its text on Fig. 9 says that nothing diverges."""
    )
    columns = ["stable from", "number agrees at", "at all from", "paper, stable at"]
    laws = {(host, DASHPOT[host], method): own for (host, method), own in found.items()}
    report_limits(exhibit, laws, columns, paper=PAPER)
    return found


def apart(exhibit, name, stable):
    """The paper: no big difference is found, even with the large step."""
    off = {nt: compared.percent("mean over time") for nt, compared in stable.items()}
    worst = max(off, key=lambda nt: abs(off[nt][0]))
    allowed = ALIKE["quick" if exhibit.quick else "full"]
    exhibit.verdict(
        f"{name}: where it is stable, the number discharged is off by {number(off[worst][0], '+.1f', off[worst][1])} % "
        f"at most (mean over time, nt = {worst:g}), allowed {allowed} %",
        abs(off[worst][0]) <= allowed,
    )


def beside_paper(exhibit, comparisons, found, hosts):
    """Its claims, and what was measured, by host."""

    def blown(method, nt):
        def told(host):
            compared = comparisons.get(Case(host, DASHPOT[host], method, nt))
            return f"{compared.outcome.blown_up} of {len(compared.outcome.runs)} blew up" if compared else "-"

        return told

    def larger(k):
        return lambda host: number(found[host, STOCK][k] / found[host, EXACT][k], ".2g")

    def faster(k):
        def told(host):
            cost = {}
            for method in METHODS:
                compared = comparisons.get(Case(host, DASHPOT[host], method, found[host, method][k]))
                cost[method] = compared.outcome.mean(lambda d: d.run.cpu_seconds) if compared else np.nan
            return number(cost[STOCK] / cost[EXACT], ".1f")

        return told

    claims = {
        "conventional diverges at nt = 3": blown(STOCK, 3),
        "conventional does not at nt = 6": blown(STOCK, 6),
        "new does not at nt = 3": blown(EXACT, 3),
        "new does not at nt = 1.5": blown(EXACT, 1.5),
        "step 4 times larger: from where both are stable": larger(0),
        "step 4 times larger: where both agree with the reference": larger(1),
        "3 times faster: from where both are stable": faster(0),
        "3 times faster: where both agree with the reference": faster(1),
    }
    exhibit.text("The paper's claims and what was measured; how far the numbers discharged are apart is told above.")
    exhibit.table(
        ["paper", *(HOSTS[host] for host in hosts)],
        [[claim, *(told(host) for host in hosts)] for claim, told in claims.items()],
    )


def main():
    title = "Discharge (section 3.2.2, Figs 9 and 10)"
    exhibit = Exhibit(title, __doc__, lambda parser: add_arguments(parser, **SEEDS))
    hosts = exhibit.arguments.hosts
    cases, seeds = plan(exhibit)
    outcomes = discharge(cases, outlet.packing.primes(seeds), exhibit.runs, "discharge")
    comparisons = compare(outcomes)

    explain(exhibit, comparisons, seeds)
    summarise(exhibit, comparisons)
    exhibit.plot(
        plot_energy(outcomes, hosts),
        "energy",
        "Kinetic energy of all particles, one bed, as Fig. 9 of the paper, whose axis ends at 6 J. Here spheres on "
        "their way down count until they reach a floor 1 m below; the paper says only that the fall is under 1 m, and "
        "there they would land on the pile of those before them, which ends the fall sooner and sooner.",
    )
    exhibit.plot(
        plot_number(outcomes, hosts),
        "number",
        "Number discharged, mean over the beds and its standard error as a band, on the axes of the paper's Fig. 10. "
        "Dotted: all runs blew up, spheres that flew off count as discharged.",
    )
    write_curves(exhibit, outcomes)
    found = judge(exhibit, comparisons, hosts)
    beside_paper(exhibit, comparisons, found, hosts)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
