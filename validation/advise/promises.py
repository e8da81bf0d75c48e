# SPDX-License-Identifier: GPL-2.0-or-later
"""What ./cfpm advise prints for a deck, as a user reads it: lines to paste for each use, and what they are to gain."""

import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))
from harness.host import ROOT  # noqa: E402
from harness.programs import call  # noqa: E402

WITHIN = 0.3  # of the nearer end of what was promised a gain may lie beyond it
NUMBER = r"\d[\d.e+-]*"
SPAN = rf"({NUMBER})(?: to ({NUMBER}))?"
DECK_STEP = re.compile(rf", dt = ({NUMBER}), particles at the start")
# use (in its first row), * of the method that is recommended, method, nt, dt, dt/deck's, cost, faster, than stock's
ROW = re.compile(
    rf"^  (.*?) +(\* )?([a-z]\w*) +({NUMBER}) +({NUMBER}) +{NUMBER} +{SPAN} +{SPAN} +(?:{SPAN}|\?)", re.MULTILINE
)
LINES = re.compile(rf"^for (.*):\n  timestep ({NUMBER})\n  \./cfpm run \S+ (.*)$", re.MULTILINE)
STOCK = "verlet"  # the method of the table that stock is


class Gain(NamedTuple):
    """Of whole runs: how many times as fast at least and at most."""

    least: float
    most: float

    def keeps(self, measured):
        return (1 - WITHIN) * self.least <= measured <= (1 + WITHIN) * self.most

    def __str__(self):
        return f"{self.least:g} to {self.most:g}"


class Row(NamedTuple):
    """Of the table of methods."""

    use: str
    method: str
    recommended: bool
    nt: float
    dt: float
    faster: Gain  # than stock at the deck's step
    than_stock: Gain  # at its own largest step for the use; None if that is not known


class Lines(NamedTuple):
    """To paste."""

    uses: tuple
    dt: float
    words: tuple  # behind ./cfpm run DECK


@dataclass(frozen=True)
class Advice:
    dt: float  # of the deck
    rows: list
    lines: list

    def promise(self, lines):
        """The Row that recommends them. What they are to gain over the deck is the same for all of their uses."""
        return next(row for row in self.rows if row.use == lines.uses[0] and row.recommended)

    def stock_step(self, use):
        """Largest that stock was measured to be right at."""
        return next(row.dt for row in self.rows if row.use == use and row.method == STOCK)


def gain(least, most):
    return Gain(float(least), float(most or least)) if least else None


def read(text):
    """Advice of all that is printed."""
    rows, use = [], None
    for of, star, method, nt, dt, _, _, *faster in ROW.findall(text):
        use = of.strip() or use
        rows.append(Row(use, method, bool(star), float(nt), float(dt), gain(*faster[:2]), gain(*faster[2:])))
    lines = [Lines(tuple(uses.split(", ")), float(dt), tuple(words.split())) for uses, dt, words in LINES.findall(text)]
    return Advice(float(DECK_STEP.search(text)[1]), rows, lines)


def ask(host, deck, variables):
    """What it says of a deck: the text."""
    program = ROOT / "harness" / "advise" / "advise.py"
    given = [word for pair in variables.items() for word in ("-var", *pair)]
    return call(sys.executable, program, deck.relative_to(ROOT), "-host", host, *given, cwd=ROOT)
