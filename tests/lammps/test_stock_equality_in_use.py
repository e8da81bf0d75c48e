# SPDX-License-Identifier: GPL-2.0-or-later
"""With "predict none" the pair style is the host's to the last digit also while particles come and go, in a run that
continues from a restart file, beside particles that are frozen or led, and under another pair style."""

from pathlib import Path

import pytest
from granular_bed import granular_bed
from kicked_bed import STEPS, assert_equal, bed, cfpm_style, stock_style
from harness.instruction_sets import SETS
from harness.lammps import LAUNCHER, STOCK, run

LAWS = ("hooke", "hertz")
GRANULAR = "granular"  # with the resistance to rolling of granular_bed.py
POUR = f"""
region slab block 0.02 0.08 0.02 0.08 0.15 0.165 units box
fix pour all pour 90 1 4767548 vol 0.3 10 diam range 0.006 0.009 dens 2500 2500 region slab
run {STEPS}
"""
# twice so many at once that they stand where all neighbours across the borders were
LAYERS = f"""
region slab block 0 0.099 0 0.099 0.12 0.14 units box
fix pour all pour 540 1 4767548 vol 0.3 10 diam range 0.006 0.009 dens 2500 2500 region slab
run {STEPS}
"""
GRAIN = "one grain\n\n1 atoms\n" + "".join(
    f"\n{section}\n\n1 {values}\n"
    for section, values in {"Coords": "0 0 0", "Types": "1", "Diameters": "0.008", "Masses": "7e-4"}.items()
)
COME_AND_GO = f"""
molecule grain ../grain.txt
region slab block 0.02 0.08 0.02 0.08 0.13 0.165 units box
region middle block INF INF INF INF 0.02 0.06 units box
fix come all deposit 40 0 100 4711 region slab near 0.01 vz -0.5 -0.5 mol grain units box
fix go all evaporate 200 10 middle 815
run {STEPS}
"""
BASE = f"""
region low block 0 0.0989 0 0.0989 0 0.015 units box
group base region low
group active subtract all base
velocity base set 0 0 0
neigh_modify exclude group base base
fix hold base {{}}
unfix integrate
fix integrate active nve/sphere
run {STEPS}
"""
HELD = {"frozen": "freeze", "led": "move wiggle 0.001 0 0.002 0.02"}


def both(law, **options):
    """The decks of stock and of the plugin."""
    if law == GRANULAR:
        styles = "granular", "granular/cfpm predict none"
        return [granular_bed("rolling", "off", style, **options) for style in styles]
    return [bed(style(law), "off", **options) for style in (stock_style, cfpm_style)]


def counts(dump):
    """Of particles, in each snapshot."""
    lines = dump.splitlines()
    return [int(lines[k + 1]) for k, line in enumerate(lines) if line == "ITEM: NUMBER OF ATOMS"]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", [*LAWS, GRANULAR])
def test_while_pouring(tmp_path, law, ranks):
    found = counts(assert_equal(tmp_path, *both(law, after=POUR), ranks))
    assert found[0] < found[1] < found[-1] <= found[0] + 90, "poured before and during the run"


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", ["hooke_given", "hertz"])  # right with the host's own step at that of the deck
def test_while_pouring_with_auto(tmp_path, law, ranks):
    """Which begins with the larger history of impulses, and has that of the host when it knows the particles."""
    auto = cfpm_style(law).replace("none", "auto")
    decks = [bed(style, "off", before="fix integrate all nve/cfpm", after=LAYERS) for style in (stock_style(law), auto)]
    decks = [deck.replace("fix integrate all nve/sphere", "") for deck in decks]
    decks[0] = decks[0].replace("nve/cfpm", "nve/sphere")
    found = counts(assert_equal(tmp_path, *decks, ranks))
    assert found[0] < found[1] < found[-1], "poured before and during the run"


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", [*LAWS, GRANULAR])
def test_while_grains_come_and_go(tmp_path, law, ranks):
    (tmp_path / "grain.txt").write_text(GRAIN)
    found = counts(assert_equal(tmp_path, *both(law, after=COME_AND_GO), ranks))
    ids = [int(line.split()[0]) for line in (tmp_path / "cfpm/bed.dump").read_text().splitlines()[-found[-1] :]]
    assert found[-1] < found[0] - 20 and max(ids) == found[0] + 40, "some were taken, and 40 were added"


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", [*LAWS, GRANULAR])
@pytest.mark.parametrize("held", HELD)
def test_on_a_base(tmp_path, held, law, ranks):
    assert_equal(tmp_path, *both(law, after=BASE.format(HELD[held])), ranks)


RIGID = """
group body id 1:4
group active subtract all body
neigh_modify exclude group body body
fix body body rigid single
unfix integrate
fix integrate active nve/sphere
"""


def test_beside_a_rigid_body(tmp_path):
    """Its spheres have its mass, which the host's style knows."""
    decks = [bed(style("hertz"), "off", after=RIGID + f"run {STEPS}") for style in (stock_style, cfpm_style)]
    assert_equal(tmp_path, *decks, 1)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("beside", ["", RIGID], ids=["alone", "rigid"])
def test_says_what_is_left_to_the_host(tmp_path, law, beside):
    deck = bed(cfpm_style(law), "off", after=beside + "run 0").replace("nve/sphere", "nve/cfpm")
    output = run(deck, tmp_path, program=LAUNCHER).stdout
    left = "contacts of pairs are left to the host's own style, as fix rigid (id body) gives its particles the masses"
    assert (left in output) == bool(beside)
    assert ("at a time" in output) == (not beside and len(SETS) > 1)


@pytest.mark.parametrize("ranks", [1, 2])
def test_under_another_style(tmp_path, ranks):
    decks = []
    for style in (stock_style("hooke"), cfpm_style("hooke")):
        deck = bed(f"hybrid/overlay {style} lj/cut 0.012", "off")
        coefficients = f"pair_coeff * * {style.split()[0]}\npair_coeff * * lj/cut 1e-6 0.009"
        decks.append(deck.replace("pair_coeff * *", coefficients))
    assert_equal(tmp_path, *decks, ranks)


def continued(style):
    """The deck of the bed with its state from a restart file, and the pair style too if it is None."""
    deck = bed(style, "off", after="run 2000")
    pair, end = (deck.index(word) for word in ("pair_style", "fix gravity"))
    settings = deck[deck.index("neighbor") : pair if style is None else end]
    return f"comm_modify vel yes\nprocessors * 1 1\nread_restart bed.restart\n{settings}{deck[end:]}"


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", LAWS)
def test_from_a_restart(tmp_path, law, ranks):
    """The host's style forgets in a restart file whether damping is limited, so its deck gives it again."""
    ends = {}
    for program, style in ((STOCK, stock_style(law)), (LAUNCHER, cfpm_style(law))):
        folder = tmp_path / Path(program).name
        folder.mkdir()
        run(bed(style, "off", after=f"run {STEPS}\nwrite_restart bed.restart"), folder, program=program, np=ranks)
        for given in (style, None) if program == LAUNCHER else (style,):
            run(continued(given), folder, program=program, np=ranks)
            ends[program, given is None] = (folder / "bed.dump").read_text()
    assert ends[STOCK, False].count("ITEM: TIMESTEP") == 3
    same = [ends[STOCK, False] == ends[LAUNCHER, stored] for stored in (False, True)]
    assert same == [True, True]
