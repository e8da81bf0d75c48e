# SPDX-License-Identifier: GPL-2.0-or-later
"""./cfpm advise: its numbers against closed forms, decks of others, and what it cannot know."""

import re
import subprocess
from math import pi, sqrt
from pathlib import Path

import pytest
from harness.advise import setups
from harness.advise.choices import Choice, Cost, read_costs
from harness.decks import deck as input_deck, two_spheres
from harness.host import ROOT
from hosts import DECKS

ADVISE = ROOT / "harness" / "advise" / "advise.py"
TUTORIAL = Path("/usr/share/doc/liggghts/examples/LIGGGHTS/Tutorials_public/cohesion/in.noCohesion")
POURED = Path("/usr/share/lammps/examples/pour/in.pour")
WITHOUT_IMPULSES = Path("/usr/share/lammps/examples/multi/in.powerlaw")
# of the spheres of two_spheres(), in a box of 2 m; one moves at 1 m/s
RADIUS, MASS, HEIGHT, GRAVITY = 0.025, 800 * 4 / 3 * pi * 0.025**3, 2.0, 9.81
FALL = sqrt(1 + 2 * GRAVITY * HEIGHT)
GRAVITY_LINE = f"fix weight all gravity {GRAVITY} vector 0 0 -1\n"


def advise(deck, host, *options, cwd=ROOT):
    return subprocess.run(
        ["/usr/bin/python3", ADVISE, deck, "-host", host, *options],
        cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=2 * setups.SECONDS,
    )


def said(*words):
    done = advise(*words)
    assert done.returncode == 0, done.stderr
    return done.stdout


def refused(*words):
    done = advise(*words)
    assert done.returncode == 1 and "Traceback" not in done.stderr, done.stderr
    return done.stderr


def written(folder, text):
    (folder / "in.deck").write_text(text)
    return folder / "in.deck"


def with_gravity(host):
    return DECKS[host].replace("run 10", GRAVITY_LINE + "run 10")


def pairs(text):
    """Of the row of pairs: radius, tc, nt, overlap at rest and in impact over radius."""
    row = re.search(r"^  (?:pairs|types 1-1) +(.*)$", text, re.MULTILINE).group(1)
    radius, tc, nt, rest, impact, _ = re.split(r"  +", row)
    overlaps = [None if word == "?" else float(word.rstrip(" %")) / 100 for word in (rest, impact)]
    return float(radius), float(tc), float(nt), *overlaps


def recommended(text, use):
    """method, nt, dt"""
    method, nt, dt = re.search(rf"^  {use} +\* (\S+) +(\S+) +(\S+)", text, re.MULTILINE).groups()
    return method, float(nt), float(dt)


def test_linear_contacts_in_closed_form(tmp_path):
    """kn = 1e5 N/m. Overlaps are printed with two digits, half a unit of the second is 5 % at most."""
    text = said(written(tmp_path, with_gravity("lammps")), "lammps")
    tc, reduced = pi * sqrt(MASS / 2 / 1e5), MASS / 2
    radius, found, nt, rest, impact = pairs(text)
    assert radius == RADIUS
    assert found == pytest.approx(tc, rel=1e-3) and nt == pytest.approx(tc / 1e-5, rel=1e-3)
    assert rest == pytest.approx(MASS * GRAVITY * HEIGHT / (2 * RADIUS) / 1e5 / RADIUS, rel=0.05)
    assert impact == pytest.approx(FALL * sqrt(reduced / 1e5) / RADIUS, rel=0.05)
    assert f"impact speed {FALL:.4g}, a bound" in text
    # three digits, rounded down
    method, nt, dt = recommended(text, "flows")
    assert (method, nt) == ("impulse", 2) and dt == pytest.approx(tc / 2, rel=0.01) and dt <= tc / 2


def test_whole_runs_gain_less_than_steps_of_beds():
    """At most what a step on a bed does; at least what one of whole decks does, less what larger steps cost more."""
    choice = Choice("verlet", 6, 30.0, Cost(0.4, 0.5, 0.8), 1)
    assert choice.faster_than(30.0) == pytest.approx((1 / 0.8, 1 / 0.4))
    assert choice.faster_than(1.0) == pytest.approx((30 / (0.8 * 1.9), 30 / 0.4))
    assert choice.faster_than(60.0) == pytest.approx((0.5 / 0.8, 0.5 / 0.4))
    assert all(cost.least <= cost.largest <= cost.of_decks for cost in read_costs().values())


def test_hertz_contacts_in_closed_form(tmp_path):
    """kn = 4/3 Y* sqrt(R*); the deepest overlap takes the energy of the impact, 2/5 kn d^(5/2) = m* v^2/2."""
    deck = with_gravity("liggghts").replace("model hooke", "model hertz")
    text = said(written(tmp_path, deck), "liggghts")
    kn = 4 / 3 * 5e6 / 2 / (1 - 0.45**2) * sqrt(RADIUS / 2)
    radius, found, nt, rest, impact = pairs(text)
    assert found == pytest.approx(3.218 * (MASS / 2 / kn) ** 0.4 * FALL**-0.2, rel=2e-3)
    assert nt == pytest.approx(found / 1e-5, rel=1e-3)
    assert rest == pytest.approx((MASS * GRAVITY * HEIGHT / (2 * RADIUS) / kn) ** (2 / 3) / RADIUS, rel=0.05)
    assert impact == pytest.approx((5 / 4 * MASS / 2 * FALL**2 / kn) ** 0.4 / RADIUS, rel=0.05)


def test_sizes_that_differ_may_cost_more(tmp_path):
    """One of the two spheres with a tenth more of diameter. linear, LAMMPS; see step_costs.csv."""
    deck = with_gravity("lammps")
    costs = read_costs()["lammps", "linear", "impulse"]
    other = deck.replace("group left id 1", "group left id 1\nset group left diameter 0.055")
    assert other != deck
    for text, largest in ((deck, costs.largest), (other, costs.any_sizes)):
        row = re.search(r"impulse +2 .*", said(written(tmp_path, text), "lammps"))[0]
        assert f"{costs.least:.2f} to {largest:.2f}" in row
    worst = costs.where_sizes_differ()
    assert worst.least == costs.least and worst.of_decks == costs.any_sizes > costs.of_decks
    unmeasured = read_costs()["lammps", "hertz", "rk4"]
    assert unmeasured.where_sizes_differ() == unmeasured


@pytest.mark.parametrize("host", DECKS)
def test_given_speed_and_height(tmp_path, host):
    """Overlaps go with them: linear ones in proportion."""
    deck = written(tmp_path, with_gravity(host))
    text = said(deck, host, "-speed", "0.5", "-height", "4")
    *_, rest, impact = pairs(text)
    *_, rest_of_bound, impact_of_bound = pairs(said(deck, host))
    assert "impact speed 0.5, as given" in text and "height 4 (as given)" in text
    assert rest == pytest.approx(2 * rest_of_bound, rel=0.11)
    assert impact == pytest.approx(impact_of_bound * 0.5 / FALL, rel=0.11)


@pytest.mark.parametrize("host", DECKS)
def test_without_gravity(tmp_path, host):
    text = said(written(tmp_path, DECKS[host]), host)
    *_, rest, impact = pairs(text)
    assert "no gravity: no overlap under weight" in text and "impact speed 1, a bound" in text
    assert rest is None and impact is not None
    still = DECKS[host].replace("velocity left set 1 0 0", "velocity left set 0 0 0")
    assert still != DECKS[host]
    text = said(written(tmp_path, still), host)
    assert "impact speed not known" in text and pairs(text)[3:] == (None, None)


def test_a_bed_that_impulses_would_make_soft(tmp_path):
    """At rest 0.5 % of a radius under the law, so 10 times that at nt = 1, 1.7 times at 5: the first below 1 %."""
    height = 0.005 * RADIUS * 1e5 / (MASS * GRAVITY) * 2 * RADIUS
    text = said(written(tmp_path, with_gravity("lammps")), "lammps", "-height", str(height))
    beds = text[text.index("dense beds at rest"):text.index("  flows")]
    assert re.search(r"impulse +5 ", beds) and not re.search(r"impulse +[13] ", beds)


def test_a_larger_step_of_the_deck(tmp_path):
    deck = written(tmp_path, DECKS["lammps"].replace("run 10", "run 10\ntimestep 2e-5\nrun 10"))
    text = said(deck, "lammps")
    assert "of 2 setups of the deck this is the last; dt is 1e-05 to 2e-05 in them" in text
    assert pairs(text)[2] == pytest.approx(pairs(text)[1] / 2e-5, rel=1e-3)


def test_poured_particles():
    """They come in the first step. Two spheres of the deck's diameter 1 and density 1, kn = 2000."""
    if not POURED.exists():
        pytest.skip(f"no {POURED}")
    radius, tc, *_ = pairs(said(POURED, "lammps"))
    assert radius == 0.5 and tc == pytest.approx(pi * sqrt(pi / 6 / 2 / 2000), rel=1e-3)


def test_a_tutorial():
    """3 mm spheres of 2500 kg/m^3, Y = 5e6 Pa, nu = 0.45, Hertz, timed at the deck's characteristic velocity 2 m/s."""
    if not TUTORIAL.exists():
        pytest.skip(f"no {TUTORIAL}")
    text = said(TUTORIAL, "liggghts")
    kn = 4 / 3 * 5e6 / 2 / (1 - 0.45**2) * sqrt(0.0015 / 2)
    mass = 2500 * 4 / 3 * pi * 0.0015**3 / 2
    radius, tc, nt, *_ = pairs(text)
    assert "sizes are those that the deck's templates will insert" in text
    assert radius == 0.0015 and tc == pytest.approx(3.218 * (mass / kn) ** 0.4 * 2**-0.2, rel=2e-3)


def test_a_method_that_the_plugin_refuses():
    if not WITHOUT_IMPULSES.exists():
        pytest.skip(f"no {WITHOUT_IMPULSES}")
    text = said(WITHOUT_IMPULSES, "lammps")
    assert "impulse is refused: fix deform (id 3): changes the box" in text
    assert not re.search(r"predict impulse", text) and recommended(text, "flows")[0] == "exact"


def test_refused_decks(tmp_path):
    plastic = "MaxElasticStiffness 2", "AdhesionStiffness 0.5", "PlasticityDepth 0.1"
    names = [line.split()[0] for line in plastic]
    lines = [f"fix {n} all property/global coefficient{n} peratomtypepair 1 {line.split()[1]}\n"
             for n, line in zip(names, plastic)]
    deck = DECKS["liggghts"].replace("model hooke", "model hooke/hysteresis")
    deck = deck.replace("pair_style gran", "".join(lines) + "pair_style gran")
    message = refused(written(tmp_path, deck), "liggghts")
    assert "refused with -suffix cfpm: pair_style gran/cfpm: unknown model 'hooke/hysteresis'" in message
    deck = DECKS["lammps"].replace("fix integrate all nve/sphere", "fix integrate all rigid single")
    message = refused(written(tmp_path, deck), "lammps")
    assert "fix rigid" in message


@pytest.mark.parametrize("host", DECKS)
def test_a_deck_that_does_not_run_in_stock(tmp_path, host):
    message = refused(written(tmp_path, DECKS[host].replace("run 10", "fix nothing all no/such/fix\nrun 10")), host)
    assert "the deck does not run without the plugin either: " in message and "no/such/fix" in message


def test_a_deck_without_particles(tmp_path):
    empty = re.sub(r"(create_atoms|set group|velocity) .*\n", "", two_spheres("lammps"))
    empty = empty.replace("group left id 1\n", "")
    deck = written(tmp_path, DECKS["lammps"].replace(two_spheres("lammps"), empty))
    assert "no particles at the start of any of its runs" in refused(deck, "lammps")


def test_a_deck_without_a_run(tmp_path):
    deck = written(tmp_path, DECKS["lammps"].replace("run 10", ""))
    assert "expected a 'run' with a granular pair style" in refused(deck, "lammps")


@pytest.mark.parametrize("host", DECKS)
def test_leaves_the_folder_of_the_deck_alone(tmp_path, host):
    (tmp_path / "keep").write_text("mine")
    text = DECKS[host].replace("run 10", "dump all all custom 1 keep id x\nrun 1000000000\nwrite_restart left")
    said(written(tmp_path, text), host)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.deck", "keep"]
    assert (tmp_path / "keep").read_text() == "mine"


def test_a_deck_that_waits_for_something(tmp_path, monkeypatch):
    """It would never end, as no time passes."""
    monkeypatch.setattr(setups, "SECONDS", 3)
    deck = written(tmp_path, DECKS["lammps"].replace("run 10", "label again\nrun 10\njump SELF again"))
    found = setups.setups_of(deck, "lammps")
    assert found.with_contacts and found.remark.endswith("its setups take longer than 3 s")


def test_two_ranks(tmp_path):
    deck = written(tmp_path, with_gravity("lammps"))
    assert said(deck, "lammps", "-np", "2") == said(deck, "lammps")


@pytest.mark.parametrize(
    "words, message",
    [
        ((), "advise: expected a deck: ./cfpm advise DECK"),
        (("nowhere",), "advise: cannot read the deck 'nowhere'"),
        (("in.deck",), "advise: no command in 'in.deck' tells whether it is for LIGGGHTS or LAMMPS"),
        (("in.deck", "-np", "0"), "advise: expected a number of ranks after -np, found '0'"),
    ],
)
def test_wrong_words(tmp_path, words, message):
    written(tmp_path, "units si\n")
    done = subprocess.run([ROOT / "cfpm", "advise", *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1 and message in done.stderr, done


def test_the_example_of_the_page_is_of_now():
    page = (ROOT / "docs" / "advise.md").read_text()
    deck = input_deck("lammps", "chute").relative_to(ROOT)
    assert f"    ./cfpm advise {deck} -speed 1\n" in page
    assert page.split("```\n")[1] == said(str(deck), "lammps", "-speed", "1")
