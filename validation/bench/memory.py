# SPDX-License-Identifier: GPL-2.0-or-later
"""Memory of a run: what a process holds at most."""

import subprocess
import sys
from pathlib import Path

from harness import host
from harness.decks import deck, options

PEAK = Path(__file__).resolve().parent / "peak.py"


def resident(program, row, bed):
    """Bytes that a run of some steps on one rank holds at most."""
    own = {"style": program.style, "model": row.model, "predict": row.predict, "nt": row.nt, "warm": 5, "steps": 5}
    given = options({**bed.variables(row.state), **own})
    found = bed.folder / "peak"
    command = [sys.executable, "-S", PEAK, found, program.path, "-in", deck(row.host, "bed"), *given]
    done = subprocess.run(
        [str(word) for word in command], cwd=bed.folder, env=host.environment(bed.folder), stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
    )
    assert done.returncode == 0, done.stdout[-4000:]
    return 1024 * int(found.read_text())


def per_particle(program, row, bed):
    """Bytes by which a run grows with each particle: what copies of the small bed need beyond it."""
    more = resident(program, row, bed) - resident(program, row, bed._replace(nx=1, ny=1))
    return more / (bed.spheres - bed.small)
