# SPDX-License-Identifier: GPL-2.0-or-later
"""A run continued from a restart file is the run that went on, with the springs of pairs and of walls.

Both processes order their particles alike at the restart (no sorting), so on one rank every digit agrees.
"""

import numpy as np
import pytest
from drum import CONTACT, FRESH, HALF, deck, half
from lammps import read_dump, run, vectors

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


@pytest.mark.parametrize("ranks", [(1, 2), (2, 1)])
def test_on_another_number_of_ranks(tmp_path, ranks):
    """The springs of pairs and walls are in the forces of the first step, which differ by rounding only."""
    before, after = ranks
    run(deck(FRESH, "hooke") + f"run {HALF}\nwrite_restart bed.restart\n" + half("on"), tmp_path, np=before)
    run(deck("read_restart bed.restart", "hooke") + half("again"), tmp_path, np=after)
    on, again = (read_dump(tmp_path / f"{name}.dump")[0][1] for name in ("on", "again"))
    force = vectors(on, "fx", "fy", "fz")
    assert np.abs(force - vectors(again, "fx", "fy", "fz")).max() < 50 * np.finfo(float).eps * np.abs(force).max()


def test_springs_of_walls_are_needed(tmp_path):
    """Without the fixes' data the continuation is another one, or the comparison above would show nothing."""
    run(deck(FRESH, "hooke") + f"run {HALF}\nwrite_restart bed.restart\n" + half("on"), tmp_path)
    renamed = deck("read_restart bed.restart", "hooke").replace("fix wall", "fix other")
    run(renamed + half("again"), tmp_path)
    same = (tmp_path / "on.dump").read_text() == (tmp_path / "again.dump").read_text()
    assert not same
