# SPDX-License-Identifier: GPL-2.0-or-later
"""Speed: CPU time for the same bed, each method at the fewest steps that give it, and what a step costs."""

import re

import bidisperse
import ensemble
import numpy as np
import packing
from averages import spread
from cases import DASHPOT, EXACT, IMPULSE, SPLIT, STOCK, Case, style
from harness.output import loops

HOST = "liggghts"
METHODS = STOCK, EXACT, IMPULSE, SPLIT
FINE = 30  # nt that practice takes for safe
COARSE = 1  # nt of a step as long as a contact
QUICK_NT = {STOCK: 6, EXACT: 6, IMPULSE: 3, SPLIT: 3}  # a quick answer has no ensemble to find any
PARTS = "steps", "steps without lists", "contacts"  # without the output; and the neighbour lists; the host's "Pair"
LARGEST_COST = 1.2  # of an impulse over stock's, of a long step over a short one; a quick run is mostly free fall
OUTPUT = re.compile(r"^Outpt time \(%\) = (\S+)", re.MULTILINE)
LISTS = re.compile(r"^Neigh time \(%\) = (\S+)", re.MULTILINE)
PAIR = re.compile(r"^Pair  time \(%\) = (\S+)", re.MULTILINE)
TURNS = {"full": 3, "quick": 1}
# what is run of in.packing, beside the methods that are timed on it
DECKS = {"packing": ({}, METHODS), "large bed": ({"n": 20000, "duration": 0.4}, (STOCK, IMPULSE, SPLIT))}
QUICK_DECKS = {
    "packing": ({"duration": 0.1}, METHODS),
    "large bed": ({"n": 1000, "duration": 0.05}, (STOCK, IMPULSE, SPLIT)),
}
BED = "settled bed"  # where only steps are timed: few, so that it is the same bed at any nt; of in.bidisperse
COPIES = {"full": 2, "quick": 1}  # of it, along x and along y
WARM = {"full": 20, "quick": 2}  # steps before those that are timed
TIMED = {"full": 100, "quick": 10}  # steps
BED_TURNS = {"full": 9, "quick": 1}


def needed(exhibit, limits):
    """{method: smallest nt that gives the right packing ratio}, without the methods that have none."""
    found = QUICK_NT if exhibit.quick else {m: limits[HOST, DASHPOT[HOST], m].agrees_at for m in METHODS}
    return {method: nt for method, nt in found.items() if np.isfinite(nt)}


def run(exhibit, limits, seed):
    nts = needed(exhibit, limits)
    decks = QUICK_DECKS if exhibit.quick else DECKS
    turns = TURNS[form(exhibit)]
    timings = {}
    for deck, (variables, methods) in decks.items():
        own = [(method, nts[method]) for method in methods if method in nts]
        todo = dict.fromkeys([*own, (STOCK, FINE), (IMPULSE, FINE), (IMPULSE, COARSE)])
        cases = {one: Case(HOST, DASHPOT[HOST], *one) for one in todo}
        runs = {k: packing.settling(HOST, seed=seed, **case.variables(), **variables) for k, case in cases.items()}
        timings[deck] = ensemble.in_turn(runs, exhibit.runs, turns, f"beyond, {deck}")

    timings_of_steps = {**timings, BED: time_bed(exhibit)}

    what = {deck: ", ".join(f"{k} = {v:g}" for k, v in variables.items()) for deck, (variables, _) in decks.items()}
    told = "; ".join(f"{deck}: {text or 'as it is'}" for deck, text in what.items())
    exhibit.text(
        f"""**Speed.** in.packing without the tangential dashpot ({told}), one run at a time, all in turn, {turns}
        turns, each of which gives one ratio. CPU time of the whole run: each method at the smallest nt at which its
        packing ratio agreed with the reference, and the conventional one at nt = {FINE}; median and range. Methods
        that never did are left out."""
    )
    compare(exhibit, timings, nts, {deck: methods for deck, (_, methods) in decks.items()})
    costs = cost_of_a_step(exhibit, timings_of_steps)
    for (deck, part, what), cost in costs.items():
        if not exhibit.quick:
            exhibit.verdict(
                f"{deck}: the {part} of {what} cost {np.median(cost):.2f}, allowed {LARGEST_COST:g}",
                np.median(cost) <= LARGEST_COST,
            )


def form(exhibit):
    """A key of TURNS and the like."""
    return "quick" if exhibit.quick else "full"


def time_bed(exhibit):
    """{(method, nt): Timing of each turn} of steps of a bed that has settled."""
    bed = bidisperse.settle([HOST], exhibit.runs)[HOST]
    own = form(exhibit)
    runs = {
        (method, nt): bidisperse.timed(
            HOST, bed, COPIES[own], COPIES[own], warm=WARM[own], steps=TIMED[own], nt=nt, **style(method)
        )
        for method, nt in ((STOCK, FINE), (IMPULSE, FINE), (IMPULSE, COARSE))
    }
    return ensemble.in_turn(runs, exhibit.runs, BED_TURNS[own], f"beyond, {BED}")


def compare(exhibit, timings, nts, methods):
    rows, shown = [], []
    own_nt = nts.get(STOCK, FINE)
    for deck, own in timings.items():
        cpu = {one: np.array([t.cpu_seconds for t in found]) for one, found in own.items()}
        for method in filter(nts.get, methods[deck]):
            new = cpu[method, nts[method]]
            gains = [cpu[STOCK, nt] / new for nt in (own_nt, FINE)]
            quantiles = [q for gain in gains for q in np.quantile(gain, (0.5, 0, 1))]
            rows.append([deck, method, nts[method], np.median(new), *quantiles])
            shown.append([deck, method, f"{nts[method]:g}", f"{np.median(new):.2f}", *(spread(g) for g in gains)])
    kinds = [f"faster_than_conventional_{which}{q}" for which in ("own", "fine") for q in ("", "_min", "_max")]
    exhibit.csv(
        "speed",
        ["deck", "method", "nt", "cpu_seconds", *kinds],
        [[f"{x:.5g}" if isinstance(x, float) else x for x in row] for row in rows],
    )
    exhibit.table(
        ["deck", "method", "nt", "CPU s", f"faster than conventional at nt = {own_nt:g}, its own"]
        + [f"faster than conventional at nt = {FINE}"],
        shown,
    )


def step_nanoseconds(log):
    """Of the PARTS of the last time loop, on the clock and per particle and step."""
    loop = loops(log)[-1]
    output, lists, pair = (float(part.findall(log)[-1]) for part in (OUTPUT, LISTS, PAIR))
    whole = loop.seconds - output
    return np.array([whole, whole - lists, pair]) * 1e9 / (loop.steps * loop.particles)


def cost_of_a_step(exhibit, timings):
    """{(deck, part, what): ratios, one per turn}"""
    pairs = {
        f"{IMPULSE} over {STOCK}, nt = {FINE}": ((IMPULSE, FINE), (STOCK, FINE)),
        f"{IMPULSE} at nt = {COARSE} over nt = {FINE}": ((IMPULSE, COARSE), (IMPULSE, FINE)),
    }
    costs, rows = {}, []
    for deck, own in timings.items():
        nanoseconds = {one: np.array([step_nanoseconds(t.log) for t in found]) for one, found in own.items()}
        for what, (new, old) in pairs.items():
            for k, part in enumerate(PARTS):
                cost = nanoseconds[new][:, k] / nanoseconds[old][:, k]
                costs[deck, part, what] = cost
                medians = [np.median(nanoseconds[one][:, k]) for one in (new, old)]
                low, middle, high = np.quantile(cost, (0, 0.5, 1))
                rows.append([deck, part, what, *(f"{x:.4g}" for x in (*medians, middle, low, high))])
    exhibit.csv("step-cost", ["deck", "part", "ratio_of", "ns", "over_ns", "ratio", "ratio_min", "ratio_max"], rows)
    exhibit.text(
        f"""Cost of a step, per particle and on the clock, median and range: the time loop without the output, the same
        without the building of neighbour lists, which a host does as often per simulated time at any nt, and the
        contacts between spheres. {BED}: two sizes, in.bidisperse, {TIMED[form(exhibit)]} steps of one and the same bed.
        The other decks are whole runs, where more collisions are under way in a longer step, and what is printed is
        evaluated as often per simulated time."""
    )
    exhibit.table(
        ["deck", "part", "of", "ns", "over ns", "ratio"],
        [[*row[:5], spread(cost)] for row, cost in zip(rows, costs.values())],
    )
    return costs
