# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of inputs/HOST/in.bed: a small one is settled once and kept, larger ones are copies of it side by side."""

from pathlib import Path
from typing import NamedTuple

from harness import HOSTS
from harness.decks import deck, options

NT = 6  # that a bed settles with, before it rests at 30
SMALL = {"columns": 10, "layers": 26}  # spheres at the start
WIDER = {"columns": 16, "layers": 26}  # where some are twice as large: eight of these side by side
TINY = {"columns": 6, "layers": 4}  # for tests


class Bed(NamedTuple):
    """Copies of a settled bed."""

    host: str
    folder: Path  # with the small bed, where its runs belong
    sizes: int  # 1; 2: half of the volume are spheres twice as large; 0: no two alike, up to twice as large
    nx: int
    ny: int
    small: int  # spheres of the small one

    @property
    def spheres(self):
        return self.nx * self.ny * self.small

    def variables(self, state):
        """Of the deck, to continue them. state: of a Row."""
        return {"phase": "time", "bed": f"{state}.data", "sizes": self.sizes, "nx": self.nx, "ny": self.ny}


def settle(host, folder, sizes, quick=False):
    """Makes the small bed in that folder, if it is not there."""
    folder.mkdir(parents=True, exist_ok=True)
    if (folder / "bed.data").exists():
        return
    print(f"settling the bed of {host} ...", flush=True)
    start = TINY if quick else SMALL if sizes == 1 else WIDER
    variables = {"phase": "settle", "style": "cfpm", "nt": NT, "sizes": sizes, **start}
    HOSTS[host].run(deck(host, "bed"), folder, np=2, options=options(variables), timeout=None)


def count(data):
    """Particles of a data file."""
    with open(data) as file:
        return next(int(line.split()[0]) for line in file if line.strip().endswith(" atoms"))


def copies(host, folder, sizes, spheres):
    """About as many spheres as asked for."""
    small = count(folder / "bed.data")
    nx = max(1, round((spheres / small) ** 0.5))
    return Bed(host, folder, sizes, nx, max(1, round(spheres / small / nx)), small)
