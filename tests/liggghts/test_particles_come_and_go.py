# SPDX-License-Identifier: GPL-2.0-or-later
"""Particles that are added or removed have forces of their own before they are moved.

Inside a run the host adds and removes them before it computes the forces of a step. Between two runs the setup of the
second does; "run N pre no" leaves it out and would move a new particle by the forces of another.
"""

import re

import pytest
from harness.liggghts import run
from small_deck import INSERTION, MODEL, PAIR, STOCK_INTEGRATOR, TEMPLATE, assert_refused, attempt, write

STALE = "fix nve/cfpm: particles were added or removed after the forces over the step were predicted; "
STALE += "do it only between"
CREATE = "create_atoms 1 single 0 0 0.8 units box\nset type 1 diameter 0.05 density 800\n"
CHANGES = {
    "added": CREATE,
    "removed": "delete_atoms group one\n",
    "last_removed": "group last id 3\ndelete_atoms group last\n",
    "as_many_removed_as_added": "delete_atoms group one\n" + CREATE,
    "as_many_added_as_removed": CREATE + "group last id 3\ndelete_atoms group last\n",
}


def predicted(predict):
    return {"pair": f"{PAIR}{MODEL} predict {predict}"}


@pytest.mark.parametrize("predict", ["exact", "rk4", "impulse", "impulse onset off"])
@pytest.mark.parametrize("case", CHANGES)
def test_without_setup(tmp_path, case, predict):
    process = attempt(tmp_path, 1, {**predicted(predict), "run": f"run 2\n{CHANGES[case]}run 5 pre no"})
    assert_refused(process, [STALE])


@pytest.mark.parametrize("case", CHANGES)
def test_without_setup_on_two_ranks(tmp_path, case):
    process = attempt(tmp_path, 2, {**predicted("impulse"), "run": f"run 2\n{CHANGES[case]}run 5 pre no"})
    assert_refused(process, [STALE])


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("predict", ["exact", "impulse"])
@pytest.mark.parametrize("case", CHANGES)
def test_with_setup(tmp_path, case, predict, ranks):
    runs = f"run 2\n{CHANGES[case]}run 5\nrun 5 pre no\n"
    # another pair style counts its predictions anew
    runs += CREATE.replace("0 0 0.8", "0 0.5 0.8") + f"{PAIR}{MODEL} predict {predict}\npair_coeff * *\nrun 20\n"
    run(write(**predicted(predict), run=runs), tmp_path, np=ranks, timeout=20)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("predict", ["exact", "impulse"])
def test_inside_a_run(tmp_path, predict, ranks):
    """Inserted every few steps, and lost through the lower face of the box."""
    falling = INSERTION.replace("vel constant 0 0 0", "vel constant 0 0 -60")
    insertion = TEMPLATE + falling.replace("insert_every once", "insert_every 200")
    changes = {
        **predicted(predict),
        "extra": insertion + "thermo 20\nthermo_modify lost ignore",
        "wall": "",
        "run": "velocity all set 0 0 -60\nrun 3200",
    }
    output = run(write(**changes), tmp_path, np=ranks, timeout=60).stdout
    counts = [int(count) for count in re.findall(r"^ +\d+ +(\d+) +\S+", output, re.MULTILINE)]
    steps = [later - earlier for earlier, later in zip(counts, counts[1:])]
    assert max(steps) > 0 > min(steps)


def test_stock_goes_on(tmp_path):
    """What is not predicted is left to the host."""
    changes = {**predicted("none"), "integrator": STOCK_INTEGRATOR, "run": f"run 2\n{CREATE}run 5 pre no"}
    run(write(**changes), tmp_path)
