# SPDX-License-Identifier: GPL-2.0-or-later
"""Which methods a deck can have for a use of its grains, with which time step, and what that costs and gains."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from harness.advise import softness

USES = {"beds": "dense beds at rest", "flows": "flows", "agitated": "agitated grains"}
STOCK = "verlet"  # the method that stock is
# a step that is 30 times as large finds more collisions and builds more lists, and costs up to 1.9 times as much
# (docs/speed.md, with impulses); in between as a power of how much larger it is
LARGER_STEPS = math.log(1.9) / math.log(30)


@dataclass(frozen=True)
class Cost:
    """Of a step over the stock style's."""

    least: float  # on a settled bed of one size
    largest: float
    of_decks: float  # the largest of whole decks, with lists, insertion, walls and output; at least that of beds
    any_sizes: float = None  # on a bed in which no two sizes are alike; None if it was not measured

    def where_sizes_differ(self):
        """The facts tell the smallest and the largest size, not whether there are a few between or as many as grains:
        up to the cost of the latter, whose steps are made anew for each contact."""
        if not self.any_sizes:
            return self
        largest, of_decks = (max(cost, self.any_sizes) for cost in (self.largest, self.of_decks))
        return Cost(self.least, largest, of_decks, self.any_sizes)


@dataclass(frozen=True)
class Choice:
    method: str
    nt: float  # of the kind of contact that allows the smallest step
    dt: float
    cost: Cost
    softer: float  # by which overlaps at rest are larger than the law's

    def faster_than(self, stock_dt):
        """Whole runs than those of the stock style with that step, (least, largest)."""
        larger = self.dt / stock_dt
        return larger / (self.cost.of_decks * max(1.0, larger) ** LARGER_STEPS), larger / self.cost.least


def read_costs():
    """{(host, spring, method): Cost}"""
    lines = (Path(__file__).parent / "step_costs.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    costs = {}
    for row in rows:
        least, largest = float(row["least"]), float(row["largest"])
        of_decks, any_sizes = float(row["of_decks"] or largest), float(row["any_sizes"] or 0) or None
        costs[row["host"], row["spring"], row["method"]] = Cost(least, largest, of_decks, any_sizes)
    return costs


def stock_step(contacts, use, time_of):
    """The largest dt with which the host's own method was measured to be right; None where it was not."""
    found = _step(contacts, STOCK, use, time_of)
    return found and found[0]


def choices(host, contacts, use, time_of, resting, refused=()):
    """The cheapest for the same time first. time_of(contact): its shortest tc. resting: largest overlap at rest over
    radius as the law has it, None if it is not known; a choice for beds keeps it below the usual limit. refused:
    methods that the plugin does not take in this deck."""
    found = []
    for method, cost in candidates(host, contacts).items():
        step = _step(contacts, method, use, time_of)
        if not step or method in refused:
            continue
        dt, nt = step
        # impulses rest as a softer material: with as many steps as keep that usual, if it is told how much there is
        steps = [nt] + [n for n, _ in softness.IMPULSE_AT_REST if n > nt] if method == "impulse" else [nt]
        allowed = [n for n in steps if use != "beds" or resting is None or method != "impulse"
                   or resting * softness.at_rest_factor(method, n) <= softness.USUAL_LIMIT]
        if not allowed:
            continue
        found.append(Choice(method, allowed[0], dt * nt / allowed[0], cost,
                            softness.at_rest_factor(method, allowed[0])))
    return sorted(found, key=lambda choice: (choice.cost.least + choice.cost.largest) / choice.dt)


def candidates(host, contacts):
    """{method: cost of its step} of those that all contacts have and whose cost was measured; none if the time of some
    contacts is not known."""
    collisions = [contact["collisions"] for contact in contacts]
    if not all(collisions):
        return {}
    spring = "hertz" if any(c["hertz"] for of_one in collisions for c in of_one) else "linear"
    names = [{method["name"] for method in contact["methods"]} for contact in contacts]
    common = set.intersection(*names)
    costs = {method: cost for (*where, method), cost in read_costs().items() if where == [host, spring]}
    radii = [r for of_one in collisions for c in of_one for r in c["radii"] if r]
    differ = max(radii) > 1.001 * min(radii)
    return {method: cost.where_sizes_differ() if differ else cost for method, cost in costs.items() if method in common}


def _step(contacts, method, use, time_of):
    """(dt, nt) of the contact that allows the smallest step; None if that was not measured."""
    steps = []
    for contact in contacts:
        nt = next((m[use] for m in contact["methods"] if m["name"] == method), None)
        if not nt:
            return None
        steps.append((time_of(contact) / nt, nt))
    return min(steps)
