# SPDX-License-Identifier: GPL-2.0-or-later
"""One rank and two give the same motion up to the growth of rounding errors, with pairs and walls, newton on and off.

The bound is that of tests/liggghts/test_rank_independence.py: a step adds at most n eps L to the difference of two
states, n terms of a sum in another order (14 neighbours at most, two walls, gravity), L the box; what one step added
grows by the factor A that a small disturbance of the start shows, so N steps give at most N n eps L A.
"""

import numpy as np
import pytest
from drum import CONTACT, FRESH, HALF, deck, half
from harness.lammps import run
from harness.output import read_dump, vectors

SIDE = 0.1
TERMS = 17
STEPS = HALF
DISTURBANCE = 1.0e-10


def positions(folder, law, newton, ranks=1, change=""):
    """At the end, sorted by id; change: a command before the run."""
    text = deck(f"read_restart {folder}/start.restart", law).replace("newton off", f"newton {newton}")
    text += f"run 0\n{change}\n"  # the host wants its restart to be taken up before it displaces anything
    here = folder / f"{ranks}{bool(change)}"
    here.mkdir()
    run(text + half("bed"), here, np=ranks)
    return vectors(read_dump(here / "bed.dump")[-1][1], "x", "y", "z")


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("law", CONTACT)
def test_one_and_two_ranks_agree(tmp_path, law, newton):
    fresh = deck(FRESH, law).replace("newton off", f"newton {newton}")
    run(fresh + "run 5000\nwrite_restart start.restart\n", tmp_path)  # the bed has met both walls
    one = positions(tmp_path, law, newton)
    two = positions(tmp_path, law, newton, ranks=2)
    size = f"{DISTURBANCE} {DISTURBANCE} {DISTURBANCE}"
    disturbed = positions(tmp_path, law, newton, change=f"displace_atoms all random {size} 8123 units box")
    growth = np.abs(disturbed - one).max() / DISTURBANCE
    bound = STEPS * TERMS * np.finfo(float).eps * SIDE * max(growth, 1.0)
    difference = np.abs(two - one).max()
    report = f"A {growth:.2g}, bound {bound:.2g}, ranks differ by {difference:.2g}"
    print(report)
    assert difference <= bound, report
    assert difference > 0.0, "the sums were in the same order: the comparison says nothing"
    assert DISTURBANCE * growth > bound, report  # it would notice such a disturbance
