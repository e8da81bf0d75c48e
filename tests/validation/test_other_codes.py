# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/peers: the codes continue one bed with one law, and it is seen where they do not."""

import subprocess
import sys

import pytest
from harness.host import ROOT

VALIDATION = ROOT / "validation"
sys.path[:0] = [str(VALIDATION / folder) for folder in ("", "bench", "peers")]
import bed as beds  # noqa: E402
import codes  # noqa: E402
from state import same_bed  # noqa: E402

STEPS = 200
SAME_LAW = 1e-3  # of the energy after an impact of 30 steps, whose error goes as 1/30^2
YADE = codes.CODES[codes.Name("YADE", "ViscElPhys")]
needs_yade = pytest.mark.skipif(YADE.missing, reason="YADE is not installed")
WRONG_BED = {  # of the script that YADE runs
    "no gravity": ("-9.81", "0.0"),
    "no floor": ("utils.wall(0,", "utils.wall(-0.04,"),
    "a sphere less": ("for row in spheres:", "for row in spheres[1:]:"),
    "at rest at the start": ("= row[3:6], row[6:]", "= (0, 0, 0), (0, 0, 0)"),
}
WRONG_LAW = {
    "stiffness": ("kn=2 * STIFFNESS", "kn=1.8 * STIFFNESS"),
    "tangential stiffness": ("ks=2 * TANGENTIAL", "ks=1.5 * TANGENTIAL"),
    "damping": ("material(2 * DAMPING,", "material(1.8 * DAMPING,"),
    "tangential damping": ("2 * TANGENTIAL_DAMPING", "1.5 * TANGENTIAL_DAMPING"),
    "damping at the floor": ("material(HUGE,", "material(2 * DAMPING,"),
    "friction": ("FRICTION, SKIN = 0.025, 800.0, 2.0e-4, 0.3", "FRICTION, SKIN = 0.025, 800.0, 2.0e-4, 0.0"),
}
# two spheres meet and one meets the floor, all with some slip, after 90 steps
IMPACTS = """LAMMPS data file

3 atoms
2 atom types

0.0 0.3 xlo xhi
0.0 0.3 ylo yhi
-0.05 0.8 zlo zhi

Atoms

1 1 0.05 800 0.1 0.1 0.3 0 0 0
2 1 0.05 800 0.1506 0.1 0.3 0 0 0
3 1 0.05 800 0.2 0.25 0.0253 0 0 0

Velocities

1 0.5 0.1 0 0 0 0
2 -0.5 -0.1 0 0 0 0
3 0.1 0 -0.5 0 0 0
"""


def changed(change, folder):
    """YADE with another script."""
    text = YADE.script.read_text()
    assert text.count(change[0]) == 1
    other = codes.Yade()
    other.script = folder / "yade_bed.py"
    other.script.write_text(text.replace(*change))
    return other


@pytest.fixture(scope="module")
def bed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("peers")
    beds.settle("liggghts", folder, 1, quick=True)
    return beds.copies("liggghts", folder, 1, 600)


@pytest.fixture(scope="module")
def impacts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("impacts")
    (folder / "bed.data").write_text(IMPACTS)
    return beds.Bed("liggghts", folder, 1, 1, 1, 3)


def difference(code, other, impacts):
    """Of the energy of translation after all impacts, relative."""
    states = [one.run(impacts, STEPS) for one in (code, other)]
    assert [state.touches for state in states] == [0.0, 0.0]
    return abs(states[0].energy / states[1].energy - 1)


@pytest.fixture(scope="module")
def stock(bed):
    return codes.CODES[codes.BASE].run(bed, STEPS)


def test_differences_are_seen(stock):
    assert same_bed(stock, stock)
    assert not same_bed(stock._replace(spheres=stock.spheres - 1), stock, same_nt=False)
    assert not same_bed(stock._replace(touches=stock.touches + 0.11), stock)
    assert not same_bed(stock._replace(touches=stock.touches + 0.51), stock, same_nt=False)
    assert not same_bed(stock._replace(energy=1.06 * stock.energy), stock)
    assert same_bed(stock._replace(energy=1.06 * stock.energy), stock, same_nt=False)


@needs_yade
def test_yade_holds_the_bed(bed, stock):
    assert same_bed(YADE.run(bed, STEPS), stock)


@needs_yade
@pytest.mark.parametrize("change", WRONG_BED)
def test_a_wrong_bed_is_seen(bed, stock, tmp_path, change):
    assert not same_bed(changed(WRONG_BED[change], tmp_path).run(bed, STEPS), stock)


def test_granular_has_the_law_of_gran(impacts):
    gran, granular = (codes.CODES[codes.Name("LAMMPS", style)] for style in ("gran/hooke/history", "granular hooke"))
    assert difference(granular, gran, impacts) < SAME_LAW


@needs_yade
def test_yade_has_the_law_of_liggghts(impacts):
    assert difference(YADE, codes.CODES[codes.BASE], impacts) < SAME_LAW


@needs_yade
@pytest.mark.parametrize("change", WRONG_LAW)
def test_a_wrong_law_is_seen(impacts, tmp_path, change):
    assert difference(changed(WRONG_LAW[change], tmp_path), codes.CODES[codes.BASE], impacts) > SAME_LAW


def test_yade_may_be_missing(tmp_path):
    """Where it is not on the path the exhibit leaves it out."""
    show = "import sys; sys.path.insert(0, sys.argv[1]); from codes import CODES; " \
        "print([name.program for name, code in CODES.items() if code.missing])"
    command = [sys.executable, "-c", show, VALIDATION / "peers"]
    done = subprocess.run(command, env={"PATH": str(tmp_path)}, text=True, capture_output=True, check=True)
    assert done.stdout == "['YADE']\n"
