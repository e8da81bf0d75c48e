# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user waits for has no hidden time limit, as tests have, and shows how far it is."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

VALIDATION = Path(__file__).resolve().parents[2] / "validation"
sys.path[:0] = [str(VALIDATION), *(str(VALIDATION / name) for name in ("bench", "packing"))]
import bed  # noqa: E402
import demo  # noqa: E402
import host_collisions  # noqa: E402
import rows  # noqa: E402
import timing  # noqa: E402


class Started(Exception):
    pass


@pytest.fixture
def limit(monkeypatch):
    """Calls a function up to where it starts a host, and tells the time limit of that."""

    def start(*command, **options):
        raise Started(options["timeout"])

    def found(function, *arguments):
        with monkeypatch.context() as patch, pytest.raises(Started) as started:
            patch.setattr(subprocess, "run", start)
            function(*arguments)
        return started.value.args[0]

    return found


@pytest.mark.parametrize("row", rows.ROWS[::5], ids=str)
def test_bench(tmp_path, limit, row):
    assert limit(bed.settle, row.host, tmp_path, 1) is None
    own = bed.Bed(row.host, tmp_path, 1, 1, 1, 1000)
    for program in timing.pair(row.host, None, None):
        assert limit(timing.measure, program, row, own, 1, 10) is None


def test_collisions(limit):
    spheres = [host_collisions.Sphere(x=(0.0, 0.0, 0.0), v=(0.0, 0.0, 0.0))]
    assert limit(host_collisions.collide, host_collisions.STOCK, "hooke", "", "", spheres, 1e-5, 1) is None


def test_demo_shows_how_far_it_is(tmp_path, monkeypatch):
    """A line that is not complete yet, as a host may leave one, does not count."""
    csv = tmp_path / "packing.csv"
    states = iter(["", "time\n", "time\n0.0,1\n", "time\n0.0,1\n0.6,1\n1", "time\n0.0,1\n0.6,1\n1.2,1\n", None])

    def poll():
        text = next(states)
        if text is not None:
            csv.write_text(text)
        return None if text is not None else 0

    shown = []
    monkeypatch.setattr(demo, "progress", lambda done, total, what: shown.append(done))
    demo.watch(SimpleNamespace(poll=poll), csv, "demo")
    assert shown == [50, 100]
