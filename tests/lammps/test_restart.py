# SPDX-License-Identifier: GPL-2.0-or-later
"""A run continued from a restart file is the run that went on, with the springs of pairs and of walls.

Both processes order their particles alike at the restart (no sorting), so on one rank every digit agrees.
"""

import numpy as np
import pytest
from drum import CONTACT, FRESH, HALF, deck, half
from harness.lammps import run
from harness.output import first_error, read_dump, vectors


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
@pytest.mark.parametrize("law", ["hooke", "split"])
def test_on_another_number_of_ranks(tmp_path, law, ranks):
    """The springs of pairs and walls are in the forces of the first step, which differ by rounding only.

    Of particles that the command write_restart itself moves to another rank the host loses the history; "run 0" moves
    them before.
    """
    before, after = ranks
    start = deck(FRESH, law) + f"run {HALF}\nrun 0\n"
    run(start + "write_restart bed.restart\n" + half("on"), tmp_path, np=before)
    run(deck("read_restart bed.restart", law) + half("again"), tmp_path, np=after)
    on, again = (read_dump(tmp_path / f"{name}.dump")[0][1] for name in ("on", "again"))
    force = vectors(on, "fx", "fy", "fz")
    assert np.abs(force - vectors(again, "fx", "fy", "fz")).max() < 50 * np.finfo(float).eps * np.abs(force).max()


@pytest.mark.parametrize("law", ["hooke", "impulse"])
def test_springs_of_walls_are_needed(tmp_path, law):
    """Without the fixes' data the continuation is another one, or the comparison above would show nothing."""
    run(deck(FRESH, law) + f"run {HALF}\nwrite_restart bed.restart\n" + half("on"), tmp_path)
    renamed = deck("read_restart bed.restart", law).replace("fix wall", "fix other")
    run(renamed + half("again"), tmp_path)
    same = (tmp_path / "on.dump").read_text() == (tmp_path / "again.dump").read_text()
    assert not same


@pytest.mark.parametrize("before, after", [("hooke", "impulse"), ("impulse", "hooke"), ("split", "impulse")])
def test_another_predictor_goes_on(tmp_path, before, after):
    """Forces and impulses keep other things of a contact; what the file holds is not taken for the other kind: friction
    begins anew, with forces as large as before."""
    run(deck(FRESH, before) + f"run {HALF}\nwrite_restart bed.restart\n", tmp_path)
    run(deck("read_restart bed.restart", after) + half("again"), tmp_path)
    snapshots = read_dump(tmp_path / "again.dump")
    assert len(snapshots) == 4
    force = [np.abs(vectors(s, "fx", "fy", "fz")).max() for _, s in snapshots]
    assert max(force) < 3.0 * force[0]
    assert snapshots[-1][1]["z"].min() > 0.0


SHAKEN = "WARNING: fix nve/cfpm: a bed at rest will move, as below nt = 6 with predict impulse its overlaps are those"


def test_warns_where_the_step_changes_overlaps_at_rest(tmp_path):
    """Between runs, and between the run of a restart file and the next."""
    few = "timestep 1.5e-4\n"  # 3.8 steps per contact
    runs = "run 1\nrun 1\nwrite_restart bed.restart\n" + few + "run 1\nrun 1\n"
    assert run(deck(FRESH, "impulse") + runs, tmp_path).stdout.count(SHAKEN) == 1
    again = deck("read_restart bed.restart", "impulse", pair=False)
    assert SHAKEN not in run(again + "run 1\n", tmp_path).stdout
    found = "the run before had predict impulse, nt = 28.42, this one has predict impulse, nt = 3.789"
    assert found in run(again + few + "run 1\n", tmp_path).stdout
    assert SHAKEN not in run(deck(FRESH, "hooke") + "run 1\n" + few + "run 1\n", tmp_path).stdout


def test_a_file_without_coefficients_is_refused(tmp_path):
    """As one that an earlier version has written, where the host's own numbers stand in their place."""
    run(deck(FRESH, "hooke") + "run 1\nwrite_restart bed.restart\n", tmp_path)
    file = tmp_path / "bed.restart"
    content = file.read_bytes()
    count = content.index(b"\0", content.index(b"\0dt=") + 1) + 1
    assert content[count:].startswith(b"\2\0\0\0001\0"), "one pair_coeff, by its number"
    file.write_bytes(content[:count] + b"\377" * 4 + content[count + 4 :])
    for ranks in (1, 2):
        process = run(deck("read_restart bed.restart", "hooke", pair=False), tmp_path, np=ranks, check=False)
        assert process.returncode != 0
        assert "pair_style gran/cfpm: the restart file does not hold every pair_coeff" in first_error(process)
