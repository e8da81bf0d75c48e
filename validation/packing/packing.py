# SPDX-License-Identifier: GPL-2.0-or-later
"""One packing run of inputs/liggghts/in.packing and what it left behind."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "liggghts"))
import liggghts  # noqa: E402

DECK = ROOT / "inputs" / "liggghts" / "in.packing"


@dataclass
class Packing:
    time: np.ndarray  # [s]
    energy: np.ndarray  # kinetic, translation and rotation [J]
    ratio: np.ndarray  # packing ratio N Vs/(2 A mean height)
    overlap: np.ndarray  # largest of all pairs, in radii
    steps: int
    seconds: float  # of the host's time loop, all ranks side by side
    nanoseconds: float  # the same per particle and step

    @property
    def blown_up(self):
        """More kinetic energy than the fall can give, m g H/2 for a uniform column, or particles lost."""
        bound = 200 * 800 * 4 / 3 * np.pi * 0.025**3 * 9.81 * 1.0 / 2
        return not np.all(np.isfinite(self.energy)) or self.energy.max() > bound


def run(cwd, style, nt, seed, np_ranks=1, **variables):
    """Runs the deck in the folder cwd and reads its CSV. variables: further deck variables."""
    cwd = Path(cwd)
    cwd.mkdir(parents=True, exist_ok=True)
    options = ["-log", "none"]
    for name, value in {"style": style, "nt": nt, "seed": seed, **variables}.items():
        options += ["-var", name, value]
    # the stock host loses particles when it blows up: an outcome here, not a failure of the run
    process = liggghts.run(DECK, cwd, np=np_ranks, options=options, check=False, timeout=3600)
    blown_up = "Lost atoms" in process.stdout or "Non-numeric" in process.stdout
    if process.returncode != 0 and not blown_up:
        raise RuntimeError(process.stdout[-3000:])
    table = np.genfromtxt(cwd / "packing.csv", delimiter=",", skip_header=1, ndmin=2)
    loops = [line.split() for line in process.stdout.splitlines() if line.startswith("Loop time")]
    seconds = sum(float(words[3]) for words in loops)
    steps = sum(int(words[8]) for words in loops)
    count = int(loops[-1][11])
    energy = np.append(table[:, 1], np.inf) if blown_up else table[:, 1]
    time = np.append(table[:, 0], np.nan) if blown_up else table[:, 0]
    return Packing(time, energy, table[:, 2], table[:, 3], steps, seconds, 1e9 * seconds / max(steps * count, 1))


def primes(count):
    """Seeds that the host accepts: primes above 10000, spread out."""
    found = []
    candidate = 15485863
    while len(found) < count:
        if all(candidate % k for k in range(3, int(candidate**0.5) + 1, 2)):
            found.append(candidate)
            candidate += 10000
        candidate += 2
    return found
