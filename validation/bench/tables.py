# SPDX-License-Identifier: GPL-2.0-or-later
"""The tables of the bench, on the screen line by line and as files for other programs."""

import csv
import sys

import numpy as np

COSTS = "host model predict nt state spheres sizes ranks simd other other_ns cfpm_ns ratio ratio_min ratio_max"
FASTEST = "other_fastest_ns cfpm_fastest_ns fastest_ratio"
TOUCHES = "other_touches cfpm_touches"
MEMORY = "host model predict spheres sizes other other_bytes cfpm_bytes ratio"
PLACE = f"{'host':9} {'model':16} {'predict':8} {'nt':>3} {'bed':8}"


def progress(text):
    """Written over by the next line."""
    if sys.stdout.isatty():
        print(f"\r\033[K{text} ", end="\r", flush=True)


class CostTable:
    """What a step costs, with a group of columns for each set of instructions."""

    def __init__(self, file, sets, other):
        self._sets = [name or "" for name in sets]
        self._other = other
        self._csv = csv.writer(file)
        self._csv.writerow([*COSTS.split(), *FASTEST.split(), *TOUCHES.split()])
        groups = "".join(f" | {name.upper() or 'ns per particle-step':45}" for name in self._sets)
        print(f"{'':63}{groups} | touches per sphere")
        columns = f" | {other:>7} {'cfpm':>7}   {'ratio (min - max)':18} fastest " * len(sets)
        print(f"{PLACE} {'spheres':>8} {'ranks':>5}{columns} | {other:>8} {'cfpm':>7}")

    def add(self, row, bed, ranks, costs):
        groups = ""
        for name, cost in zip(self._sets, costs):
            medians = np.median(cost.nanoseconds, axis=0)
            low, middle, high = np.quantile(cost.ratios, (0, 0.5, 1))
            fastest = cost.nanoseconds.min(axis=0)
            of_fastest = fastest[1] / fastest[0]
            groups += f" | {medians[0]:7.0f} {medians[1]:7.0f}   {middle:.2f} ({low:.2f} - {high:.2f})"
            groups += f"  {of_fastest:7.2f} "
            place = [*row, bed.spheres, bed.sizes, ranks, name, self._other]
            numbers = [*medians, middle, low, high, *fastest, of_fastest, *cost.touches]
            self._csv.writerow([*place, *(f"{x:.5g}" for x in numbers)])
        touches = costs[0].touches
        progress("")
        print(f"{row} {bed.spheres:8} {ranks:5}{groups} | {touches[0]:8.3f} {touches[1]:7.3f}", flush=True)


class MemoryTable:
    """What a particle takes in memory."""

    def __init__(self, file, other):
        self._other = other
        self._csv = csv.writer(file)
        self._csv.writerow(MEMORY.split())
        print(f"{PLACE} {'spheres':>8} | bytes per particle, {other} and cfpm, and their ratio")

    def add(self, row, bed, other, own):
        place = [row.host, row.model, row.predict, bed.spheres, bed.sizes, self._other]
        self._csv.writerow([*place, f"{other:.0f}", f"{own:.0f}", f"{own / other:.4g}"])
        progress("")
        print(f"{row} {bed.spheres:8} | {other:7.0f} {own:7.0f}   {own / other:.2f}", flush=True)
