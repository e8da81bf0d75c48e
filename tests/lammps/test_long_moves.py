# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse, where particles move by much of their radius in a step.

Within half of the skin their contacts begin at the touch, at any such move; beyond it late, as without onset. No run
stops for it; the end of the run tells how often it was.
"""

import re

import numpy as np
import pytest
from harness.lammps import run
from harness.long_moves import DT, FIRST, PAIR_STYLES, RADIUS, TEXT, deck, velocities

LAW = PAIR_STYLES["lammps"].removeprefix("gran/cfpm ").removesuffix(" predict impulse{}")


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("phase", [0.1, 0.9])
def test_within_half_of_the_skin(tmp_path, phase, ranks):
    move = 0.4 * RADIUS
    process = run(deck("lammps", move, (1.0 + phase) * move, skin=2.5 * move), tmp_path, np=ranks)
    end = velocities(tmp_path)[-1]
    assert np.abs(end - [[0.0, 0.0, 0.0], [move / DT, 0.0, 0.0]]).max() <= 1e-9 * move / DT
    assert not FIRST.search(process.stdout) and not TEXT.search(process.stdout), process.stdout


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("part", [0.4, 1.2])
def test_beyond(tmp_path, part, ranks):
    """The move into the contact begins with a gap that no list reaches over."""
    move, skin = part * RADIUS, 0.002
    found = {}
    for onset in ("on", "off"):
        process = run(deck("lammps", move, 1.8 * move, skin, f" onset {onset}"), tmp_path, np=ranks)
        found[onset] = np.array(velocities(tmp_path))
        if onset == "off":
            assert not FIRST.search(process.stdout) and not TEXT.search(process.stdout), process.stdout
            continue
        moves = np.linalg.norm(found[onset], axis=2) * DT
        count, passing, passed_by, more = TEXT.search(process.stdout).groups()
        assert len(TEXT.findall(process.stdout)) == 1 and FIRST.findall(process.stdout) == ["0"]
        assert int(count) == (moves > 0.5 * skin).sum() > 0
        assert int(passing) == (moves > RADIUS).sum()
        assert (passed_by is not None) == (int(passing) > 0)
        assert float(more) == pytest.approx(2.0 * moves.max() - skin, rel=1e-2)
    assert np.array_equal(found["on"], found["off"])


# a region outside of which particles are, places and moves in a step over the radius; all pass by
PASSING = {
    "edge": ("block -0.5 0 -0.5 0.5 -0.5 0 side out", (0.5, 1.5), (0.75, -0.95)),
    "from the face over the edge": ("block -0.5 0 -0.5 0.5 -0.5 0 side out", (-0.1, 1.4), (0.9, -0.6)),
    "rod": (f"cylinder y 0 0 {0.5 * RADIUS} -0.5 0.5 side out", (-0.5, 1.8), (1.6, -0.4)),
}


@pytest.mark.parametrize("case", PASSING)
def test_past_a_region(tmp_path, case):
    """Where the plane through the nearest point of the wall would be met, but not the wall."""
    region, (x, z), (u, w) = PASSING[case]
    text = deck("lammps", 0.1, 0.1, 4.0 * RADIUS, extra=f"region W {region}\nfix w all wall/gran/cfpm {LAW} region W")
    place = f"create_atoms 1 single {x * RADIUS} 0 {z * RADIUS} units box\n"
    start = f"velocity all set {u * RADIUS / DT} 0 {w * RADIUS / DT} units box\n"
    text = re.sub("(create_atoms.*\n)+", place, text)
    text = re.sub("velocity first.*\n", start, text)
    run(text.replace("run 10", "run 3"), tmp_path)
    assert np.array_equal(velocities(tmp_path)[-1], velocities(tmp_path)[0])
