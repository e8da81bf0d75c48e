# SPDX-License-Identifier: GPL-2.0-or-later
"""A run continued from a restart file is the run that went on, with the springs of pairs and of walls.

Both processes order their particles alike at the restart (no sorting), so on one rank every digit agrees.
"""

import numpy as np
import pytest
from drum import CONTACT, FRESH, HALF, deck, half
from lammps import read_dump, run

@pytest.mark.parametrize("pair", [True, False], ids=["pair_style", "no_pair_style"])
@pytest.mark.parametrize("law", CONTACT)
def test_continues_to_the_last_digit(tmp_path, law, pair):
    run(deck(FRESH, law) + f"run {HALF}\nwrite_restart bed.restart\n" + half("on"), tmp_path)
    run(deck("read_restart bed.restart", law, pair) + half("again"), tmp_path)
    on, again = ((tmp_path / f"{name}.dump").read_text() for name in ("on", "again"))
    same = on == again
    assert same
    snapshots = read_dump(tmp_path / "on.dump")
    assert len(snapshots) == 4
    moved = np.abs(snapshots[-1][1]["z"] - snapshots[0][1]["z"]).max()
    assert moved > 1e-3, "nothing happened after the restart"


def test_springs_of_walls_are_needed(tmp_path):
    """Without the fixes' data the continuation is another one, or the comparison above would show nothing."""
    run(deck(FRESH, "hooke") + f"run {HALF}\nwrite_restart bed.restart\n" + half("on"), tmp_path)
    renamed = deck("read_restart bed.restart", "hooke").replace("fix wall", "fix other")
    run(renamed + half("again"), tmp_path)
    same = (tmp_path / "on.dump").read_text() == (tmp_path / "again.dump").read_text()
    assert not same
