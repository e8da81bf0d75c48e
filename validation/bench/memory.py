# SPDX-License-Identifier: GPL-2.0-or-later
"""Memory of a run: what a process holds at most."""

import os

from harness import host
from harness.decks import deck, options


def resident(program, row, bed):
    """Bytes that a run of some steps on one rank holds at most."""
    own = {"style": program.style, "model": row.model, "predict": row.predict, "nt": row.nt, "warm": 5, "steps": 5}
    given = options({**bed.variables(row.state), **own})
    process = host.start(program.path, deck(row.host, "bed"), bed.folder, options=given)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, (bed.folder / "log").read_text()[-4000:]
    return 1024 * usage.ru_maxrss


def per_particle(program, row, bed):
    """Bytes by which a run grows with each particle: what copies of the small bed need beyond it."""
    more = resident(program, row, bed) - resident(program, row, bed._replace(nx=1, ny=1))
    return more / (bed.spheres - bed.small)
