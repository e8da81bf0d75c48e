# SPDX-License-Identifier: GPL-2.0-or-later
"""What is left of a bed after a run, and whether two codes continued the same one."""

from typing import NamedTuple

# What a step costs grows at most as the number of touches: 0.1 of 4.6 moves no ratio by more than 2 %. At another nt a
# bed has other overlaps, and sinks while it is timed.
TOUCHES_BOUND, OTHER_NT_BOUND = 0.1, 0.5
# Without floor or gravity the energy at the end would differ by m g^2 t^2 / 2 with t = 1.5 ms, more than all of it;
# what the laws of friction differ by changes it by a percent.
ENERGY_BOUND = 0.05


class State(NamedTuple):
    """Of a bed after its last step."""

    spheres: int
    touches: float  # others that a sphere touches, mean
    energy: float  # kinetic, of translation, per sphere [J]


def same_bed(own, other, same_nt=True):
    """Whether two States are of one bed. same_nt: at the same instant too."""
    if own.spheres != other.spheres:
        return False
    apart = abs(own.touches - other.touches)
    if not same_nt:
        return apart <= OTHER_NT_BOUND
    return apart <= TOUCHES_BOUND and abs(own.energy / other.energy - 1) <= ENERGY_BOUND
