# SPDX-License-Identifier: GPL-2.0-or-later
"""What the exhibits share: a section of the report made of text, tables, plots and verdicts, CSV files, progress.

An exhibit is a folder with a validate.py that is run as "validate.py --out FOLDER [--quick]". It leaves its CSV files
and plots there and section.md, which report.py joins with the others; it exits with 1 if a verdict fails.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

import style  # noqa: F401: that of the plots


class Exhibit:
    def __init__(self, title, description, add_arguments=lambda parser: None):
        parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("--out", type=Path, required=True, help="folder for the section, its CSV files and plots")
        parser.add_argument("--quick", action="store_true", help="a coarse answer, as the tests use it")
        add_arguments(parser)
        self.arguments = parser.parse_args()
        self.quick = self.arguments.quick
        self.out = self.arguments.out
        self.out.mkdir(parents=True, exist_ok=True)
        self.runs = self.out.parent / "runs"  # finished runs of a host, shared by the exhibits
        self._title = title
        self._parts = []
        self._failed = 0
        print(f"{title}", flush=True)

    def text(self, paragraph):
        """A paragraph of Markdown."""
        self._parts.append(" ".join(paragraph.split()))

    def table(self, header, rows):
        """A table of strings, in the report and on the screen."""
        rows = [[str(cell) for cell in row] for row in rows]
        widths = [max(len(line[k]) for line in [header, *rows]) for k in range(len(header))]
        lines = ["| " + " | ".join(c.ljust(w) for c, w in zip(line, widths)) + " |" for line in [header, *rows]]
        lines.insert(1, "|" + "|".join("-" * (w + 2) for w in widths) + "|")
        self._parts.append("\n".join(lines))
        print("\n".join(lines) + "\n", flush=True)

    def plot(self, figure, name, caption):
        """Saves a matplotlib figure as name.png."""
        figure.savefig(self.out / f"{name}.png", dpi=120, bbox_inches="tight")
        self._parts.append(f"![{caption}]({self.out.name}/{name}.png)\n\n*{caption}*")

    def csv(self, name, header, rows):
        """Numbers as they were measured, in name.csv."""
        with open(self.out / f"{name}.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(header)
            writer.writerows(rows)

    def curves(self, name, times, curves):
        """Curves {name: values at the times} in name.csv; empty where a value is no number."""
        lines = zip(times, *curves.values())
        rows = [[f"{t:.2f}", *(f"{x:.4g}" if math.isfinite(x) else "" for x in line)] for t, *line in lines]
        self.csv(name, ["time", *curves], rows)

    def verdict(self, claim, holds):
        """A claim that the numbers above support or not; one that does not hold fails the exhibit."""
        self._failed += not holds
        line = f"{'PASS' if holds else 'FAIL'}: {claim}"
        self._parts.append("**" + line.replace(": ", ":** ", 1))
        print(line, flush=True)

    def finish(self):
        """Writes section.md; returns the exit code."""
        (self.out / "section.md").write_text("\n\n".join([f"## {self._title}", *self._parts]) + "\n")
        print(flush=True)
        return 1 if self._failed else 0


def progress(done, total, what, note=""):
    """One line on a terminal that is written over; elsewhere a line now and then."""
    if sys.stdout.isatty():
        print(f"\r\033[K{what}: {done} of {total}{note}", end="\r" if done < total else "\n", flush=True)
    elif done == total or done % max(1, total // 5) == 0:
        print(f"{what}: {done} of {total}{note}", flush=True)
