# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/decks: what is rewritten of a deck of others, and which figures of two sets of starts differ."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "decks"))
import figures  # noqa: E402
import validate  # noqa: E402
from decks import FOLDERS, Deck, all_decks  # noqa: E402
from rewriting import Rewriting  # noqa: E402

DECK = """
units si   # a comment
include in.step
variable half equal 100
pair_style gran model hertz &
  tangential history
timestep ${dt}
thermo 300
fix ins all insert/pack seed 32452843 insert_every 900 particles_in_region 250
fix grow all adapt ${half} atom diameter v_d
dump dmp all custom/vtk 800 post/a_*.vtk id type x f_Temp[0]
dump mesh all mesh/stl 300 post/dump*.stl
dump more all custom 100 post/more id
run 1
run ${half}
run 6000 upto
variable rest equal 0.1/${dt}
variable turned equal (step-500)*2*PI
variable time equal step*${dt}
run ${rest}
"""
AT_THREE_TIMES_THE_STEP = """units si
variable dt equal 3*(1e-5*2)
variable half equal 33
pair_style gran model hertz tangential history
timestep ${dt}
thermo 100
fix ins all insert/pack seed 10007 insert_every 300 particles_in_region 250
fix grow all adapt ${half} atom diameter v_d
dump decks all custom 111 decks.dump id mass radius x y z vx vy vz omegax omegay omegaz f_Temp[0]
run 1
run 16
run 1000 upto
variable rest equal 0.1/${dt}
variable turned equal ((3*step)-500)*2*PI
variable time equal step*${dt}
variable decks_run equal ceil(0.5*${rest})
run ${decks_run}
"""
MAY_CHANGE = re.compile(
    r"(timestep|run|thermo \d+|variable|velocity \w+ create|fix \S+ \S+ (insert|pour|adapt|check))\b"
)
SNAPSHOT = """ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
{count}
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id mass radius x y z vx vy vz omegax omegay omegaz
"""


def test_times_stay_and_the_rest_stays(tmp_path):
    (tmp_path / "in.step").write_text("variable dt equal 1e-5*2\n")
    (tmp_path / "in.deck").write_text(DECK)
    text = Rewriting(Deck("liggghts", tmp_path / "in.deck"), ratio=3.0, part=0.5, seed=10007).text()
    assert text == AT_THREE_TIMES_THE_STEP


@pytest.mark.parametrize("host", FOLDERS)
def test_of_real_decks_only_numbers_of_steps_change(host):
    """And seeds, and the dump: without their numbers all other lines are those of the deck."""
    if not FOLDERS[host].is_dir():
        pytest.skip(f"no decks at {FOLDERS[host]}")
    number = re.compile(r"\$\{\w+\}|(?<![\w.])[\d.]+(e[-+]?\d+)?\b")
    decks = all_decks(host)
    assert len(decks) > 5
    for deck in decks:
        before = [line for line in deck.commands if not line.startswith(("dump", "undump"))]
        after = Rewriting(deck, 3.0, 0.5, 10007).text().splitlines()
        after = [line for line in after if not line.startswith(("dump", "variable decks_run"))]
        changed = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
        for old, new in changed:
            assert MAY_CHANGE.match(new)
            own = re.sub(r"\(3\*step\)", "step", re.sub(r"\d+\*\((.*)\)$", r"\1", new))
            assert number.sub("", old) == number.sub("", own)


def test_nothing_differs_from_what_was_not_run():
    """As LAMMPS's decks with another law of friction."""
    outcome = validate.runs.Outcome("", False, [], None, 0.0, "", {"particles": [1.0, 0.0]})
    judged = validate.Judged(None, 1.0)
    judged.outcomes = {(validate.STOCK, k): outcome for k in range(2)}
    assert judged.differences(validate.IMPULSE3) == judged.differences(validate.IMPULSE3, validate.STOCK_OFF) == []
    assert not judged.differing(validate.STOCK)


def test_energy_and_centre_of_spheres(tmp_path):
    """Two spheres of 2 and 6 kg: m v^2/2 + m r^2 omega^2/5 of the first, the other at rest and one step later away."""
    lines = "1 2 0.5 1 0 0 3 0 0 0 0 4\n", "2 6 0.5 5 0 0 0 0 0 0 0 0\n"
    dump = tmp_path / "dump"
    dump.write_text(SNAPSHOT.format(step=0, count=0) + SNAPSHOT.format(step=10, count=2) + "".join(lines)
                    + SNAPSHOT.format(step=20, count=1) + lines[0])
    found = figures.read(dump, granular=True)
    assert found["particles"] == (1.0, 0.1)
    assert found["kinetic energy"] == pytest.approx((10.6, 0.0))
    assert found["largest speed"] == pytest.approx((3.0, 0.0))
    assert found["centre of mass x"] == pytest.approx((1.0, 0.3))  # 4 before, in 10 steps


def starts(mean, step=0.0, n=3):
    """Figures of n starts that scatter about the mean."""
    return [{"a": (mean + x, step), "b": (5.0, 0.0)} for x in np.linspace(-1.0, 1.0, n)]


def test_only_what_chance_and_a_step_do_not_explain_differs():
    """With three starts of each and two figures Student's quantile is that of 4 degrees of freedom at 0.25 %: 5.60."""
    one = figures.compare(starts(0.0), starts(0.0))[0]
    assert one.value == 0.0 and one.allowed / one.error == pytest.approx(5.598, abs=0.001)
    within, beyond = 0.99 * one.allowed, 1.01 * one.allowed
    assert not figures.compare(starts(within), starts(0.0))[0].differs
    assert figures.compare(starts(beyond), starts(0.0))[0].differs
    assert not figures.compare(starts(beyond, step=0.02 * one.allowed), starts(0.0))[0].differs
    assert not any(d.differs for d in figures.compare(starts(0.0), starts(0.0))[1:])
    assert figures.compare([{"a": (np.nan, 0.0)}] * 2, [{"a": (1.0, 0.0)}] * 2)[0].differs
