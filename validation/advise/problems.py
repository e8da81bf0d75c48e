# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of stock hosts, as users write them, and the figures that each of them is run for."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness.decks import deck, variables  # noqa: E402

USE = "flows"  # what both are for, in the words of advise
BEGIN = 0.15  # from when on after the lid has gone grains are counted [s]


def outflow(table, values):
    """Grains that leave the box per second, from when the flow is steady."""
    fill, duration = float(values["fill"]), float(values["duration"])
    begin = min(BEGIN, duration / 2)
    time = table["Step"] * float(values["dt"])
    before, after = np.interp([fill + begin, fill + duration], time, table["Atoms"])
    return {"outflow [1/s]": (before - after) / (duration - begin)}


def heap(table, values):
    """Of all grains in the end: mean height and mean distance from the axis."""
    return {"height [mm]": 1e3 * table["v_height"][-1], "distance [mm]": 1e3 * table["v_distance"][-1]}


@dataclass(frozen=True)
class Problem:
    title: str
    host: str
    name: str  # of the deck in inputs
    step: str  # the variable of the deck that chooses its step
    figures: Callable  # of the host's table of thermo and the deck's variables: {figure: value}
    given: dict  # variables of the deck for a full run
    quick: dict  # for a short one of few grains, which all the same lie longer than they fall; None: none is as short
    text: str  # what is run, for the report

    @property
    def deck(self):
        return deck(self.host, self.name)

    def variables(self, quick):
        return {**self.given, **(self.quick if quick else {})}

    def values(self, given):
        """Of all variables of the deck."""
        return {**variables(self.deck), **given}

    def at(self, ratio):
        """The variable for a step so many times the deck's."""
        own = float(variables(self.deck)[self.step])
        return {self.step: f"{own / ratio if self.step == 'nt' else own * ratio:.10g}"}


PROBLEMS = [
    Problem(
        "A hopper of wheat", "liggghts", "wheat", "dt", outflow,
        {"mesh": deck("liggghts", "wheat").parent / "meshes" / "hopper.stl"},
        {"n": 1000, "fill": 0.7, "duration": 0.1},
        f"""8,000 grains of 6, 7 and 8 mm, Hertz contacts, fill a hopper from an STL file and run out of its outlet of
        60 mm. Outflow: grains that leave the box per second, from {BEGIN} s after the lid has gone.""",
    ),
    Problem(
        "A collapse", "lammps", "collapse", "nt", heap, {}, None,
        """4,992 grains of 4 to 6 mm, linear contacts, in a tube that is taken away: mean height of the grains and mean
        distance from the axis 0.15 s later.""",
    ),
]
