# SPDX-License-Identifier: GPL-2.0-or-later
"""What a step costs, as a host's log tells."""

import re
from typing import NamedTuple

from harness.output import loops

MEMORY = re.compile(r"Memory usage per processor = (\S+) Mbytes|Per MPI rank memory .* = \S+ \| (\S+) \| \S+ Mbytes")
SHARES = re.compile(r"Nlocal: +(\S+) ave +(\S+) max +(\S+) min")


class StepCost(NamedTuple):
    particles: int
    nanoseconds: float  # on the clock, per particle and step
    bytes: float  # per particle, over all ranks


def of_last_loop(log, ranks):
    loop = [loop for loop in loops(log) if loop.steps > 0][-1]
    megabytes = float(next(filter(None, MEMORY.findall(log)[-1])))
    _, largest, smallest = map(float, SHARES.findall(log)[-1])
    assert largest < 1.1 * smallest, f"the ranks do not hold equal shares of the bed: {smallest:g} to {largest:g}"
    return StepCost(loop.particles, loop.nanoseconds, megabytes * 2**20 * ranks / loop.particles)
