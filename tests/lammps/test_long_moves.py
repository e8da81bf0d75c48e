# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse, where particles move by much of their radius in a step.

Within half of the skin their contacts begin at the touch, at any such move; beyond it late, as without onset. No run
stops for it; the end of the run tells how often it was.
"""

import numpy as np
import pytest
from harness.lammps import run
from harness.long_moves import DT, FIRST, RADIUS, TEXT, deck, velocities


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("phase", [0.1, 0.9])
def test_within_half_of_the_skin(tmp_path, phase, ranks):
    move = 0.4 * RADIUS
    process = run(deck("lammps", move, (1.0 + phase) * move, skin=2.5 * move), tmp_path, np=ranks)
    end = velocities(tmp_path)[-1]
    assert np.abs(end - [[0.0, 0.0, 0.0], [move / DT, 0.0, 0.0]]).max() <= 1e-9 * move / DT
    assert "WARNING" not in process.stdout, process.stdout


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
            assert "WARNING" not in process.stdout, process.stdout
            continue
        moves = np.linalg.norm(found[onset], axis=2) * DT
        count, passing, passed_by, more = TEXT.search(process.stdout).groups()
        assert len(TEXT.findall(process.stdout)) == 1 and FIRST.findall(process.stdout) == ["0"]
        assert int(count) == (moves > 0.5 * skin).sum() > 0
        assert int(passing) == (moves > RADIUS).sum()
        assert (passed_by is not None) == (int(passing) > 0)
        assert float(more) == pytest.approx(2.0 * moves.max() - skin, rel=1e-2)
    assert np.array_equal(found["on"], found["off"])
