# SPDX-License-Identifier: GPL-2.0-or-later
"""Times a row of the bench: what a step costs with one program and with another, in turn.

The machine's speed changes with time; two runs that follow each other see nearly the same.
"""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import step_cost
import tables
from harness import HOSTS, host
from harness.decks import deck, options

STEPS_OF = 23_400  # spheres: a larger bed is timed over as many particle-steps, but over
LEAST_STEPS = 20
TOUCHES = re.compile(r"^touches per sphere: (\S+)", re.MULTILINE)


class Program(NamedTuple):
    """What runs a deck."""

    style: str  # stock or cfpm
    path: str
    environment: dict  # beside the usual one

    def run(self, row, bed, ranks, **variables):
        """The output of the deck's phase "time"."""
        own = {"style": self.style, "model": row.model, "predict": row.predict, "nt": row.nt}
        given = options({**bed.variables(row.state), **own, **variables})
        settings = {"np": ranks, "options": given, "env": self.environment, "timeout": None}
        return host.run(self.path, deck(row.host, "bed"), bed.folder, **settings).stdout


def name_of_other(build):
    return "before" if build else "stock"


def pair(of_host, simd, build):
    """What a row is timed with: the stock host or, where it is given, the launcher of another build, and that of this
    one. simd: the instructions that the plugin is to use, None: its choice."""
    launcher = Path(HOSTS[of_host].LAUNCHER)
    environment = {"CFPM_SIMD": simd} if simd else {}
    other = Program("stock", HOSTS[of_host].STOCK, {})
    if build:
        other = Program("cfpm", str(build.resolve() / "bin" / launcher.name), environment)
    return other, Program("cfpm", str(launcher), environment)


class Cost(NamedTuple):
    """Of both programs of a pair, over all turns."""

    nanoseconds: np.ndarray  # per particle and step, on the clock: turn, program
    touches: tuple  # per sphere, at the end of the first turn

    @property
    def ratios(self):
        return self.nanoseconds[:, 1] / self.nanoseconds[:, 0]


def measure(program, row, bed, ranks, steps):
    """Nanoseconds per particle and step on the clock, and how many others each sphere touches at the end."""
    steps = min(steps, max(LEAST_STEPS, steps * STEPS_OF // bed.spheres))
    text = program.run(row, bed, ranks, steps=steps)
    return step_cost.of_last_loop(text, ranks).nanoseconds, float(TOUCHES.search(text)[1])


def in_turn(pairs, turns, row, bed, ranks, steps):
    """The Cost of each pair: all of them in every turn. steps: see measure()."""
    samples = []
    for turn in range(turns):
        tables.progress(f"{row} {bed.spheres} spheres on {ranks}: pair {turn + 1} of {turns}")
        samples.append([[measure(program, row, bed, ranks, steps) for program in programs] for programs in pairs])
    table = np.array(samples)  # turn, pair, program, (nanoseconds, touches)
    return [Cost(table[:, k, :, 0], tuple(table[0, k, :, 1])) for k in range(len(pairs))]
