# SPDX-License-Identifier: GPL-2.0-or-later
"""Predicted contacts while fix pour adds particles: on one rank and two, and with the springs of walls."""

import numpy as np
import pytest
from drum import CONTACT, deck
from harness.lammps import run
from harness.output import read_dump

BOX = """region box block -0.05 0.05 -0.05 0.05 -0.01 0.4 units box
create_box 1 box"""
STATE = "id x y z vx vy vz omegax omegay omegaz"
POURED = 300
OVERLAP = {**dict.fromkeys(CONTACT, 6.4e-7), "hertz": 6.9e-6}  # of a sphere at rest on the floor


def pour(count):
    return f"""
region slab block -0.025 0.025 -0.025 0.025 0.15 0.165 units box
fix pour all pour {count} 1 4767548 vol 0.3 50 diam range 0.006 0.008 dens 2500 2500 region slab
"""


def dump(group, every, steps):
    return f"""
dump state {group} custom {every} state.dump {STATE}
dump_modify state sort id format float %.17g
run {steps}
"""


@pytest.mark.parametrize("law", CONTACT)
def test_ranks_pour_alike(tmp_path, law):
    """As many at any time, to the last digit at the same places while they fall, and all of them in the drum."""
    fresh = deck(BOX, law).replace("map array ", "")  # with a map the host crashes when it pours into an empty box
    runs = []
    for ranks in (1, 2):
        folder = tmp_path / str(ranks)
        folder.mkdir()
        run(fresh + pour(POURED) + "run 10\n" + dump("all", 1000, 20000), folder, np=ranks)
        runs.append([columns for _, columns in read_dump(folder / "state.dump")])
    counts = [[len(s["id"]) for s in snapshots] for snapshots in runs]
    assert counts[0] == counts[1]
    assert 0 < counts[0][0] < counts[0][-1] == POURED, "poured during the run"
    falling = [snapshots[0] for snapshots in runs]
    assert all(np.array_equal(*(s[name] for s in falling)) for name in STATE.split())
    for end in (snapshots[-1] for snapshots in runs):
        assert np.array_equal(end["id"], np.arange(1, POURED + 1))
        assert np.hypot(end["x"], end["y"]).max() < 0.04 and end["z"].min() > 0.0
        assert 0.0 < np.median(end["z"]) < 0.06, "they did not settle"


@pytest.mark.parametrize("law", CONTACT)
def test_springs_of_walls_outlast_it(tmp_path, law):
    """A sphere that has begun to roll on the floor does so as if nothing were poured, though the host's arrays grow for
    it: they have room for a multiple of 16384 particles."""
    start = f"""{BOX}
create_atoms 1 single 0.03 0.045 {0.005 - OVERLAP[law]} units box
lattice sc 0.0029
region dust block -15.1 15.1 -16.1 16.1 105 120.5
create_atoms 1 region dust
set group all diameter 0.002 density 2500
group one id 1
set group one diameter 0.01 density 2500
velocity one set -0.05 0 0 units box"""
    paths, counts = [], []
    for poured in ("", pour(20)):
        text = deck(start, law, walls=("zplane 0.0 NULL",)) + "run 500\n" + poured + dump("one", 100, 1000)
        output = run(text + 'print "together $(atoms)"\n', tmp_path).stdout
        counts.append(int(output.split("\ntogether ")[1].split()[0]))
        paths.append((tmp_path / "state.dump").read_text())
    assert counts == [16384 - 15, 16384 + 5]
    first, last = (read_dump(tmp_path / "state.dump")[k][1] for k in (0, -1))
    assert last["x"][0] < first["x"][0] - 5e-4 and last["omegay"][0] < -5.0
    same = paths[0] == paths[1]
    assert same
