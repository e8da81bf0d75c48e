# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of Debian's package lammps-examples with their style words replaced, beside the same decks as they are.

The host kicks a poured particle by g dt/2 in the step that pours it; predicted forces act from the next step on. The
speeds along g so differ by g dt/2 until a contact, the heights by that times the fall. A predicted sphere at rest
sinks in deeper, by less than mg/k (docs/pair_gran_cfpm.md). All else is scatter.
"""

import re
import shutil
from collections import namedtuple
from pathlib import Path

import numpy as np
import pytest
from host_walls import documented
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import first_error, read_dump, vectors
from paired import assert_same_mean, kinetic_energy, mass

EXAMPLES = Path("/usr/share/lammps/examples")
STYLES = (
    (r"^(pair_style\s+(?:hybrid\s+)?)gran/(hooke|hertz)/history", r"\1gran/cfpm \2"),
    (r"^(pair_style\s+(?:hybrid\s+)?)gran/hooke", r"\1gran/cfpm hooke/nohistory"),
    (r"^(pair_coeff\s.*)gran/hooke", r"\1gran/cfpm"),
    (r"wall/gran(?:/region)?(\s+)(hooke|hertz)/history", r"wall/gran/cfpm\1\2"),
    ("nve/sphere", "nve/cfpm"),
)
STATE = "id x y z vx vy vz omegax omegay omegaz radius modify sort id format float %.17g"

# runs: steps of each run in place of the deck's; changes: others that make it shorter; drop: the longest fall;
# sink: mg/k
Example = namedtuple("Example", "runs drop poured changes gravity sink up ranks", defaults=((), 1.0, 0.0, "z", 1))
HEAVIER = (("gravity equal 1.0", "gravity equal 9.0"),)  # so that they reach the walls sooner
DECKS = {
    # a third of the spheres, then the first of the flow; k = 2000 and dt = 0.001 are nt = 36
    "pour/in.pour": Example((7000, 3000), 15.0, 1206, sink=np.pi / 6 / 2000),
    "pour/in.pour.2d": Example((10000,), 34.5, 886, up="y"),
    # the whole deck: at rest, turning, at rest, turning about another axis, at rest; nt = 5, at a wall 7
    "granregion/in.granregion.box": Example(5 * (5000,), 8.0, 100, sink=np.pi / 6 / 4000),
    "granregion/in.granregion.funnel": Example((1000, 12000, 2000), 50.0, 2000, HEAVIER, gravity=9.0, ranks=2),
    "granregion/in.granregion.mixer": Example((25000, 4000), 18.0, 444, HEAVIER, gravity=9.0, ranks=2),
}


def predicted(deck):
    for word, ours in STYLES:
        deck = re.sub(word, ours, deck, flags=re.MULTILINE)
    return deck


def states(folder, name, example, program, change=str, options=()):
    """Time of every end of a run and the particles there, the time step, and what the host said."""
    deck = (EXAMPLES / name).read_text()
    assert len(re.findall(r"^run\s", deck, re.MULTILINE)) == len(example.runs)
    steps = iter(example.runs)
    state = f"write_dump all custom *.dump {STATE}"
    deck = re.sub(r"^run\s+\d+", lambda _: f"run {next(steps)}\n{state}", deck, flags=re.MULTILINE)
    for old, new in example.changes:
        assert old in deck
        deck = deck.replace(old, new)
    folder.mkdir()
    output = run(change(deck), folder, program=program, options=options, np=example.ranks).stdout
    dt = float(re.search(r"Time step +: (\S+)", output)[1])
    return [(end * dt, read_dump(folder / f"{end}.dump")[0][1]) for end in np.cumsum(example.runs)], dt, output


def assert_as_stock(example, dt, stock, cfpm):
    """Within scatter and what the two schemes make different."""
    late = example.gravity * dt / 2
    fall = np.sqrt(2 * example.drop / example.gravity)
    for (time, a), (_, b) in zip(stock, cfpm):
        assert np.array_equal(a["id"], b["id"])
        height = a[example.up]
        assert_same_mean(height, b[example.up], height, late * min(time, fall) + example.sink, "height")
        speed = np.abs(vectors(a, "vx", "vy", "vz")).max(axis=1)
        late_energy = late * (mass(a) * speed).mean()
        assert_same_mean(kinetic_energy(a), kinetic_energy(b), height, late_energy, "kinetic energy")
    assert np.array_equal(a["id"], np.arange(1, example.poured + 1)), "not all are there"


@pytest.mark.parametrize("name", DECKS)
def test_runs_as_stock(tmp_path, name):
    example = DECKS[name]
    stock, dt, _ = states(tmp_path / "stock", name, example, STOCK, documented)
    cfpm, _, _ = states(tmp_path / "cfpm", name, example, LAUNCHER, predicted)
    assert_as_stock(example, dt, stock, cfpm)


SUFFIX = ("-suffix", "cfpm")


def test_unmodified_with_impulses(tmp_path):
    """A hybrid of gran/hooke, with few steps per contact, where auto takes them."""
    name = "granregion/in.granregion.box"
    example = DECKS[name]
    stock, dt, _ = states(tmp_path / "stock", name, example, STOCK, documented)
    cfpm, _, output = states(tmp_path / "cfpm", name, example, LAUNCHER, options=SUFFIX)
    assert "gran/cfpm: predict auto (impulse)" in output
    assert_as_stock(example, dt, stock, cfpm)


MUCH_HEAVIER = (("gravity equal 1.0", "gravity equal 100.0"),)
SHORTER = {  # until spheres lie on a wall
    "granregion/in.granregion.funnel": Example((1000, 2000, 500), 50.0, 2000, MUCH_HEAVIER),
    "granregion/in.granregion.mixer": Example((8000, 2000), 18.0, 444, MUCH_HEAVIER),
}


@pytest.mark.parametrize("name", SHORTER)
def test_unmodified_in_the_hosts_step(tmp_path, name):
    """Which auto takes for hertz: to the last digit."""
    example = SHORTER[name]
    stock, _, _ = states(tmp_path / "stock", name, example, STOCK)
    _, _, output = states(tmp_path / "cfpm", name, example, LAUNCHER, options=SUFFIX)
    assert "gran/cfpm: predict auto (verlet)" in output
    for end in np.cumsum(example.runs):
        same = (tmp_path / "stock" / f"{end}.dump").read_text() == (tmp_path / "cfpm" / f"{end}.dump").read_text()
        assert same, f"particles differ from stock after {end} steps"
    last = stock[-1][1]
    touched = np.count_nonzero(vectors(last, "omegax", "omegay", "omegaz").any(axis=1))
    print(f"{name}: {touched} of {len(last['id'])} have touched something")
    assert touched > 100 and len(last["id"]) == example.poured


@pytest.mark.parametrize("ranks", [1, 2])
def test_rigid_molecules_are_refused(tmp_path, ranks):
    shutil.copy(EXAMPLES / "pour" / "molecule.vshape", tmp_path)
    deck = predicted((EXAMPLES / "pour" / "in.pour.2d.molecule").read_text())
    error = first_error(run(deck, tmp_path, np=ranks, check=False))
    assert "fix rigid/small (id 3)" in error, error
