# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/discharge/outlet.py: which discharges blew up, and which beds it takes."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "discharge"))
import outlet  # noqa: E402
from outlet import ensemble  # noqa: E402

START = np.array([0.1, 0.2])  # heights of two spheres
FALLING = np.linspace(0.01, 0.4, 40)  # times before the first of them leaves


def discharged(energy, count=0, host_stopped=False):
    run = ensemble.Result(Path(), host_stopped, 1.0, 10, 1.0, None)
    return outlet.Discharge(FALLING, energy, np.broadcast_to(count, FALLING.shape), START, run)


def free_fall():
    """Kinetic energy of both."""
    return len(START) * outlet.WEIGHT * 9.81 / 2 * FALLING**2


def test_free_fall_did_not_blow_up():
    assert not discharged(free_fall()).blown_up


def test_more_than_free_fall_blew_up():
    early = free_fall()
    early[0] += 2 * outlet.SETTLED
    assert discharged(early).blown_up
    assert discharged(np.where(FALLING == FALLING[-1], np.nan, free_fall())).blown_up
    assert discharged(free_fall(), host_stopped=True).blown_up


def test_numbers_and_their_times():
    one = discharged(free_fall(), count=np.arange(40) // 10)
    assert one.time_of(2) == pytest.approx(0.21) and np.isnan(one.time_of(4))
    assert one.number([0.0, 0.25, 9.0]) == pytest.approx([0, 2, 3])


def test_bed_that_still_moves_stops_it(tmp_path):
    table = tmp_path / "packing.csv"
    result = ensemble.Result(tmp_path, False, 1.0, 10, 1.0, 1.0)
    table.write_text("time,kinetic_energy,packing_ratio,overlap\n0.5,3,0.5,0\n1.2,0.001,0.57,0\n")
    assert outlet.bed(result) == tmp_path / "packing.data"
    table.write_text("time,kinetic_energy,packing_ratio,overlap\n0.5,3,0.5,0\n1.2,0.5,0.57,0\n")
    with pytest.raises(SystemExit, match="has not settled: 0.5 J"):
        outlet.bed(result)
