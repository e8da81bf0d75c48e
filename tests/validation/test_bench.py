# SPDX-License-Identifier: GPL-2.0-or-later
"""All rows of the bench run, each of the two programs on the same bed; what they cost is for the real bench."""

import csv
import subprocess
import sys

import pytest
from harness.host import BUILD, ROOT

BENCH = ROOT / "validation" / "bench"
sys.path[:0] = [str(BENCH), str(BENCH.parent), str(BENCH.parent / "decks")]
import rows  # noqa: E402
from decks import FOLDERS  # noqa: E402


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    """The folder of all, where each bed settles once."""
    return tmp_path_factory.mktemp("bench")


def bench(out, *options, table="costs"):
    """Its table, as a list of dictionaries."""
    program = [sys.executable, BENCH / "bench.py", "--quick", "--out", out]
    done = subprocess.run([str(word) for word in (*program, *options)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    with open(out / f"{table}.csv") as lines:
        return list(csv.DictReader(lines))


def keys(table):
    return [(line["host"], line["model"], line["predict"], int(line["nt"]), line["state"]) for line in table]


@pytest.mark.parametrize("host", rows.MODELS)
def test_beside_stock(out, host):
    table = bench(out, "--hosts", host)
    assert keys(table) == [row for row in rows.ROWS if row.host == host]
    for line in table:
        assert line["other"] == "stock" and float(line["ratio"]) > 0.0
        # a sphere at rest lies on others; what both made of one bed in 110 steps is nearly the same
        touches = float(line["other_touches"]), float(line["cfpm_touches"])
        assert min(touches) > 3.0 and abs(touches[1] - touches[0]) < 0.1, line


def test_beside_another_build(out):
    """Also at steps as long as a contact, and for each set of instructions; spheres of any size and of two."""
    table = bench(out, "--against", BUILD, "--rows", "landing", "--sizes", "0", "2", "--simd", "scalar", "sse2")
    expected = [row for row in rows.LONG_STEPS if row.state == "landing"]
    assert keys(table) == [row for row in expected for _ in range(4)]
    for line in table:  # the same build twice: to the last bit the same bed
        assert line["other"] == "before" and line["other_touches"] == line["cfpm_touches"], line
        assert 0.0 < float(line["cfpm_touches"]) < 3.0


def test_memory(out):
    """Both hosts keep some hundred bytes for a particle and its list of neighbours."""
    for line in bench(out, "--memory", "--rows", "rk2", table="memory"):
        assert 300 < float(line["other_bytes"]) < 3000 and 300 < float(line["cfpm_bytes"]) < 3000


def test_whole_decks(out):
    table = bench(out, "--decks", table="decks")
    assert [(line["host"], line["predict"]) for line in table] == [
        (host, predict) for host in rows.MODELS if FOLDERS[host].is_dir() for predict in ("auto", "impulse")
    ]
    for line in table:
        assert 0.05 < float(line["ratio"]) < 20.0, line


def test_says_what_no_row_has(tmp_path):
    command = [sys.executable, str(BENCH / "bench.py"), "--out", str(tmp_path), "--rows", "hurtz"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr.startswith("bench: no row has any of hurtz")
