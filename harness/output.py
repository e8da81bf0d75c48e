# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads what a host writes: its dumps and what it says of a run. Both hosts write the same."""

import re
from itertools import islice
from typing import NamedTuple

import numpy as np

LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", re.MULTILINE)
REBUILDS = re.compile(r"Neighbor list builds = (\d+)")


class Loop(NamedTuple):
    """One time loop, which a "run" of the deck is."""

    seconds: float  # on the clock
    steps: int
    particles: int  # that are there at the end

    @property
    def nanoseconds(self):
        """On the clock, per particle and step; None if no particle is left."""
        return 1e9 * self.seconds / (self.steps * self.particles) if self.particles else None


def loops(text):
    """Every Loop that the output tells of."""
    return [Loop(float(seconds), int(steps), int(count)) for seconds, steps, count in LOOP.findall(text)]


def thermo(text):
    """{column: array} of the tables that a host printed, one behind the other; all must have the same columns.

    What it says in between, as warnings, is left out.
    """
    names, rows, inside = [], [], False
    for words in map(str.split, text.splitlines()):
        if words[:1] == ["Step"]:
            names, inside = words, True
        elif words[:2] == ["Loop", "time"]:
            inside = False
        elif inside and len(words) == len(names) and words[0].isdigit():
            rows.append(words)
    return dict(zip(names, np.array(rows, dtype=float).T))


def rebuilds(text):
    """How often the neighbour lists were built anew in each of the runs."""
    return [int(count) for count in REBUILDS.findall(text)]


def first_error(process):
    """The first line of a run with an error; fails if it ended well, or without a word."""
    assert process.returncode != 0, process.stdout[-2000:]
    errors = [line for line in process.stdout.splitlines() if line.startswith("ERROR")]
    assert errors, "no error message:\n" + process.stdout[-2000:]
    return errors[0]


def snapshots_of(lines):
    """Of the lines of a "dump custom" text file each snapshot: (timestep, {column: array in the order of the file}).

    ValueError if the last one is not whole.
    """
    lines = iter(lines)
    for line in lines:
        if not line.startswith("ITEM: TIMESTEP"):
            continue
        step = int(next(lines, ""))
        count = 0
        for line in lines:
            if line.startswith("ITEM: NUMBER OF ATOMS"):
                count = int(next(lines, ""))
            if line.startswith("ITEM: ATOMS"):
                break
        names = line.split()[2:]
        rows = [line.split() for line in islice(lines, count)]
        if len(rows) < count:
            raise ValueError(f"found {len(rows)} of {count} particles at step {step}; expected a whole snapshot")
        table = np.array(rows, dtype=float).reshape(count, len(names))
        yield step, {name: table[:, k] for k, name in enumerate(names)}


def read_dump(path):
    """Snapshots of a "dump custom" text file: a list of (timestep, {column: array sorted by id})."""
    with open(path) as lines:
        snapshots = list(snapshots_of(lines))
    for _, columns in snapshots:
        order = np.argsort(columns["id"])
        columns.update({name: values[order] for name, values in columns.items()})
    return snapshots


def vectors(columns, *names):
    """Columns of a snapshot side by side: vectors(s, "x", "y", "z") has shape (particles, 3)."""
    return np.column_stack([columns[name] for name in names])
