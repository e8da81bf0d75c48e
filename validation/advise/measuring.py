# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a deck as it is and as advise says, from several starts in turn: how long that takes and what comes out."""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = map(str, (HERE.parent, HERE.parent / "decks", HERE.parents[1]))
import ensemble  # noqa: E402
from figures import compare  # noqa: E402
from harness.output import thermo  # noqa: E402
from problems import USE  # noqa: E402
from promises import Lines  # noqa: E402
from runs import SEEDS  # noqa: E402

AS_IS, LARGEST = "stock, as the deck is", "stock, its largest step"


class Way(NamedTuple):
    """How a deck is run."""

    name: str
    dt: float
    lines: Lines = None  # of advise, that say so; stock without

    @property
    def words(self):
        return self.lines.words if self.lines else ()

    def is_for(self, use):
        return bool(self.lines) and use in self.lines.uses


class Measured(NamedTuple):
    """Of all starts."""

    seconds: np.ndarray  # user time
    figures: list  # {figure: value} of each start; of one that blew up {}

    @property
    def blown_up(self):
        return self.figures.count({})

    def values(self, figure):
        return [one.get(figure, np.nan) for one in self.figures]

    def faster_than(self, other):
        """Ratio of each start."""
        return other.seconds / self.seconds

    def apart_from(self, other):
        """[figures.Difference]: which of the figures differ by more than starts do; empty if any start blew up."""
        if self.blown_up or other.blown_up:
            return []
        return compare(*([{name: (value, 0.0) for name, value in one.items()} for one in of.figures]
                         for of in (self, other)))


def ways_of(advice):
    """As the deck is, stock at its largest step for what the deck is for, and each set of lines."""
    return [
        Way(AS_IS, advice.dt),
        Way(LARGEST, advice.stock_step(USE)),
        *(Way(f"lines for {', '.join(lines.uses)}", lines.dt, lines) for lines in advice.lines),
    ]


def measure(problem, advice, quick, starts, folder):
    """{way: Measured}. A start is run in all ways before the next one is; finished starts are kept in the folder."""
    ways = ways_of(advice)
    variables = [{**problem.variables(quick), **problem.at(way.dt / advice.dt)} for way in ways]
    results = []
    for k, seed in enumerate(SEEDS[:starts], 1):
        runs = [
            ensemble.Run(problem.host, problem.deck, {**own, "seed": seed}, advice.dt / way.dt, ("log",), way.words)
            for way, own in zip(ways, variables)
        ]
        results.append(ensemble.together(runs, folder, f"{problem.name}, start {k} of {starts}"))
    return {way: collected(problem, own, of) for way, own, of in zip(ways, variables, zip(*results))}


def collected(problem, variables, results):
    logs = [None if result.blown_up else (result.folder / "log").read_text() for result in results]
    figures = [problem.figures(thermo(log), problem.values(variables)) if log else {} for log in logs]
    return Measured(np.array([result.user_seconds for result in results]), figures)
