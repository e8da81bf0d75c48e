# SPDX-License-Identifier: GPL-2.0-or-later
"""Packing: what the exact collision of a contact changes in the bed that settles, over the time step."""

import matplotlib.pyplot as plt
import numpy as np
from averages import mean_and_error
from cases import EXACT, IMPULSE, SIGMA, SPLIT, STOCK, Case, law_name, limits, number, report_limits
from ratios import BAND, Reference, converged, last_change, ratio, settle

HOST = "liggghts"
NT = (1, 1.5, 2, 3, 4, 6, 10, 30)
LARGE = (30, 100)  # whose runs are the reference
QUICK_NT = (1, 3)
QUICK_LARGE = (6,)
# by tangential dashpot, off and on; the reference's comes first. With the dashpot the conventional method comes to its
# limit from nt = 30 on only
METHODS = {"off": (STOCK, EXACT, IMPULSE, SPLIT), "on": (EXACT, IMPULSE, SPLIT)}
NEW = IMPULSE, SPLIT
ADVISED = 3  # nt of beds that the plugin tells at the start of a run with an impulse


def run(exhibit, seeds):
    """{dashpot: Limits of each method}, after it was told what came out."""
    nts, large = (QUICK_NT, QUICK_LARGE) if exhibit.quick else (NT, LARGE)
    cases = [Case(HOST, dashpot, m, nt) for dashpot, methods in METHODS.items() for m in methods for nt in nts]
    cases += [Case(HOST, dashpot, methods[0], nt) for dashpot, methods in METHODS.items() for nt in large]
    outcomes = settle(dict.fromkeys(cases, len(seeds)), seeds, exhibit.runs, "beyond, packing")
    references = {dashpot: Reference(outcomes, HOST, dashpot, own[0], large) for dashpot, own in METHODS.items()}

    explain(exhibit, references, len(seeds))
    tell(exhibit, outcomes, references)
    write(exhibit, outcomes, references)
    exhibit.plot(
        plot(outcomes, references),
        "packing",
        "Packing ratio minus the reference's, and kinetic energy that is left at the end, means and standard errors. "
        "Hollow: some runs blew up. Grey: the band.",
    )
    return judge(exhibit, outcomes, references, nts)


def explain(exhibit, references, seeds):
    exhibit.text(
        f"""**Packing.** 200 spheres fall from up to 1 m and settle for 1.2 s, from {seeds} random starts that no
        other exhibit uses. Reference without the tangential dashpot: {METHODS["off"][0]} at nt =
        {references["off"].nt}, pooled; with it {METHODS["on"][0]} at nt = {references["on"].nt}, pooled. Packing ratio
        minus the reference's in percent, paired by start, mean and standard error; or how many runs blew up:
        particles were lost, moved too far in a step, or had more kinetic energy than the fall can give."""
    )


def of_law(outcomes, dashpot):
    """{method: {nt: Outcome}}, both in the order of the tables."""
    own = sorted(((case, o) for case, o in outcomes.items() if case.dashpot == dashpot), key=lambda x: x[0].order())
    return {method: {c.nt: o for c, o in own if c.method == method} for method in METHODS[dashpot]}


def left(p):
    """Kinetic energy at the end [J]."""
    return p.energy[-1]


def tell(exhibit, outcomes, references):
    def difference(dashpot):
        return lambda o: told(references[dashpot].difference(o), "+.2f")

    def table(make_cell):
        """make_cell(dashpot): a function of an outcome."""
        nts = sorted({case.nt for case in outcomes})
        exhibit.table(
            ["law", "method", *(f"nt = {nt:g}" for nt in nts)],
            [
                [law_name(HOST, dashpot), method, *(cell(own.get(nt), make_cell(dashpot)) for nt in nts)]
                for dashpot in METHODS
                for method, own in of_law(outcomes, dashpot).items()
            ],
        )

    table(difference)
    exhibit.text("Kinetic energy that is left at the end, J:")
    table(lambda _: lambda o: told(mean_and_error(o.values(left)), ".1e"))


def told(mean_error, form):
    mean, error = mean_error
    return number(mean, form, error)


def cell(outcome, tell_value):
    if outcome is None:
        return ""
    return f"{outcome.blown_up} of {len(outcome.runs)} blew up" if outcome.blown_up else tell_value(outcome)


def write(exhibit, outcomes, references):
    rows = []
    for case, outcome in sorted(outcomes.items(), key=lambda item: item[0].order()):
        measured = [*mean_and_error(outcome.values(ratio)), *references[case.dashpot].difference(outcome)]
        measured += mean_and_error(outcome.values(left))
        measured += [outcome.mean(lambda p: 100 * p.overlap.max()), outcome.mean(last_change)]
        rows.append([*case, len(outcome.runs), outcome.blown_up, *(f"{x:.5g}" for x in measured)])
    names = """host dashpot method nt runs blown_up ratio ratio_error difference_percent difference_error
        energy_left_joule energy_left_error largest_overlap_percent last_change_percent"""
    exhibit.csv("packing", names.split(), rows)


def plot(outcomes, references):
    figure, rows = plt.subplots(2, 2, figsize=(11, 7.5), sharex=True, sharey="row")
    for column, dashpot in enumerate(METHODS):
        quantities = references[dashpot].difference, lambda o: mean_and_error(o.values(left))
        for axes, quantity in zip(rows[:, column], quantities):
            for method, own in of_law(outcomes, dashpot).items():
                k = METHODS["off"].index(method)
                for hollow in (False, True):
                    points = [(nt * 1.03**k, *quantity(o)) for nt, o in own.items() if (o.blown_up > 0) == hollow]
                    nt, mean, error = np.reshape([p for p in points if np.isfinite(p[1])], (-1, 3)).T
                    fill = {"markerfacecolor": "none"} if hollow else {"label": method}
                    style = {"fmt": "sod^"[k], "color": f"C{k}", "capsize": 3}
                    axes.errorbar(nt, mean, np.nan_to_num(error), **style, **fill)
            axes.grid(alpha=0.3)
        rows[0, column].axhspan(-BAND, BAND, color="0.9")
        rows[0, column].set(title=law_name(HOST, dashpot), xscale="log", ylim=(-2, 5))
        rows[0, column].legend(fontsize=8)
        rows[1, column].set(xlabel="nt", yscale="log")
    rows[0, 0].set(ylabel="Packing ratio minus reference, %")
    rows[1, 0].set(ylabel="Kinetic energy left, J")
    figure.tight_layout()
    return figure


def judge(exhibit, outcomes, references, nts):
    """The verdicts are on what the impulse is for and on what the plugin says of it."""
    found = {}
    for dashpot, methods in METHODS.items():
        for method in methods:
            own = {nt: outcomes[Case(HOST, dashpot, method, nt)] for nt in nts}
            good = {nt: converged(outcome, references[dashpot]) for nt, outcome in own.items()}
            found[HOST, dashpot, method] = limits({nt: o.blown_up == 0 for nt, o in own.items()}, good)
    exhibit.text(
        f"""Smallest nt of those that were run: from which on no run blew up; whose packing ratio is within {BAND} %
        of the reference and not distinguishable from it at {SIGMA} standard errors; from which on this holds at all
        nt. A true agreement fails the last now and then, as {SIGMA} standard errors are asked of every nt."""
    )
    report_limits(exhibit, found, ["stable from", "ratio agrees at", "at all from"], "packing-limits")
    for dashpot in METHODS:
        exact = found[HOST, dashpot, EXACT]
        for method in NEW:
            stable, agrees, lasting = found[HOST, dashpot, method]
            law = f"{law_name(HOST, dashpot)}, {method}"
            exhibit.verdict(
                f"{law}: no run blew up from nt = {number(stable, 'g')} on; {EXACT}: "
                f"{number(exact.stable_from, 'g')}",
                stable <= exact.stable_from,
            )
            if not exhibit.quick:
                exhibit.verdict(
                    f"{law}: packing ratio that of small steps at the advised nt = {ADVISED}; it is from nt = "
                    f"{number(agrees, 'g')}, at all larger ones from {number(lasting, 'g')}; {EXACT}: from "
                    f"{number(exact.agrees_at, 'g')} and {number(exact.agrees_from, 'g')}",
                    converged(outcomes[Case(HOST, dashpot, method, ADVISED)], references[dashpot])
                    and agrees <= exact.agrees_at,
                )
    return found
