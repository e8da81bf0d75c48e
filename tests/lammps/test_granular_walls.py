# SPDX-License-Identifier: GPL-2.0-or-later
"""Predicted contacts with the sub-models of fix wall/gran granular. Single contacts: see granular_contacts.py."""

import re

import drum
import numpy as np
import pytest
from granular_contacts import CONTACTS, DENSITY, MASS, POISSON, RADIUS, SPEED, START, TIME, YOUNG, Bodies, closing_speed
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import first_error, read_dump
from host_walls import skip_if_removed
from test_granular import GRANULAR, small
from test_granular_predicted import PLAIN, given

CURVED = 3 * RADIUS  # radius of walls around the sphere
PAIRS = "pair_style granular/cfpm predict rk4\npair_coeff * * hooke 1e5 50 tangential linear_nohistory 0.5 0.1"
STOCK_PAIRS = PAIRS.replace("/cfpm predict rk4", "")
HEAD = """
clear
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
"""


def impact(
    wall, steps, slip=0.0, before="", place=(0, 0, RADIUS - START), towards=(0, 0, -1), pairs=PAIRS, move="nve/cfpm"
):
    """A sphere that moves towards the wall and slips along y."""
    velocity = SPEED * np.array(towards) + [0, slip, 0]
    return f"""{HEAD}
create_atoms 1 single {" ".join(repr(float(x)) for x in place)} units box
set group all diameter {2 * RADIUS} density {DENSITY}
velocity all set {" ".join(repr(float(v)) for v in velocity)} units box
{pairs}
{before}
fix wall all {wall}
fix integrate all {move}
timestep {TIME / steps!r}
run {steps}
write_dump all custom {steps}.dump id vx vy vz omegax omegay omegaz modify sort id format float %.17g
"""


def velocities(folder, program, wall, steps, **words):
    """After T, for each number of steps: of the sphere, and what its spin moves its surface by."""
    run("".join(impact(wall, n, **words) for n in steps), folder, program=program)
    found = []
    for n in steps:
        sphere = read_dump(folder / f"{n}.dump")[0][1]
        found.append(np.array([sphere[c][0] * (RADIUS if c[0] == "o" else 1) for c in list(sphere) if c != "id"]))
    return found


def against_stock(folder, law, predict, shape, **words):
    """The velocities, those of the host's wall, and by how much both may differ: by what half the step changes, and as
    the host's lever is the radius, where here it ends in the middle of the overlap."""
    wall, region = f"{law} {shape}", "/region" if shape.startswith("region") else ""
    coarse, fine = velocities(folder, LAUNCHER, f"wall/gran/cfpm {wall} predict {predict}", (16, 32), **words)
    host = {**words, "pairs": STOCK_PAIRS, "move": "nve/sphere"}
    stock = wall.replace("hertz", "hertz/history") if law.startswith("hertz ") else wall
    host_coarse, host_fine = velocities(folder, STOCK, f"wall/gran{region} {stock}", (1024, 2048), **host)
    lever = (START + SPEED * TIME) / RADIUS * np.abs(host_fine).max()
    return fine, host_fine, np.abs(fine - coarse) + np.abs(host_fine - host_coarse) + lever


def of_wall(folder):
    """A sphere and a wall, whose moduli the host mixes as those of two spheres, but not in 2021."""
    bodies = Bodies(MASS, RADIUS)
    if "LAMMPS (29 Sep 2021" in run("", folder, program=STOCK).stdout:
        bodies.e_star = YOUNG / (2 * (1 - POISSON))
    return bodies


@pytest.mark.parametrize("name", CONTACTS)
def test_head_on(tmp_path, name):
    models, predict, force = CONTACTS[name]
    wall = f"wall/gran/cfpm granular {models} zplane 0 NULL predict {predict}"
    coarse, fine = (-v[2] for v in velocities(tmp_path, LAUNCHER, wall, (16, 32)))
    expected = closing_speed(force, of_wall(tmp_path))
    assert abs(fine - expected) <= abs(fine - coarse)
    assert abs(fine - coarse) < 0.05 * SPEED
    assert abs(expected - SPEED) > 0.1 * SPEED, "the contact has done nothing"


@pytest.mark.parametrize("name", CONTACTS)
def test_oblique(tmp_path, name):
    models, predict, _ = CONTACTS[name]
    found, expected, allowed = against_stock(tmp_path, f"granular {models}", predict, "zplane 0 NULL", slip=SPEED)
    assert np.all(np.abs(found - expected) <= allowed), (found, expected, allowed)
    assert abs(found[3]) > 0.01 * SPEED, "nothing has begun to turn"


LAWS = {
    "granular": f"granular {CONTACTS['material'][0]}",
    "hertz": "hertz 1e8 2e7 5e5 0 0.5 0 limit_damping",
}
SHAPES = {
    "zcylinder": (f"zcylinder {CURVED}", ""),
    "cylinder": ("region w", f"region w cylinder z 0 0 {CURVED} -1 1 units box"),
    "sphere": ("region w", f"region w sphere 0 0 0 {CURVED} units box"),
}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("law", LAWS)
def test_curved_wall(tmp_path, law, shape):
    """Around the sphere, with a reduced radius that is larger than its own, by which it leaves the wall later."""
    words = {"place": (CURVED - RADIUS + START, 0, 0), "towards": (1, 0, 0), "slip": SPEED}
    shape, region = SHAPES[shape]
    skip_if_removed(shape)
    found, expected, allowed = against_stock(tmp_path, LAWS[law], "rk4", shape, before=region, **words)
    assert np.all(np.abs(found - expected) <= allowed), (found, expected, allowed)
    flat = velocities(tmp_path, LAUNCHER, f"wall/gran/cfpm {LAWS[law]} xplane NULL {CURVED}", (32,), **words)[0]
    assert abs(flat[0] - found[0]) > 3 * allowed[0], "the curvature does not count"


def test_restitution(tmp_path):
    """Of a whole impact, a linear one that ends where its force is 0 (Schwager and Poeschel 2007). It converges,
    from nearer by where contacts begin and end inside a step."""
    stiffness, damping = 1e5, 500.0
    decay, frequency = damping / 2, np.sqrt(stiffness / MASS - damping**2 / 4)
    lasts = (np.pi - np.arctan2(2 * frequency * decay, frequency**2 - decay**2)) / frequency
    expected = np.exp(-decay * lasts)
    contact = float(np.pi * np.sqrt(MASS / stiffness))
    law = f"granular hooke {stiffness} {damping} damping mass_velocity tangential linear_nohistory 0 0 limit_damping"
    start = (0, 0, RADIUS + 0.37 * SPEED * contact / 20)
    errors = {}
    for onset in ("on", "off"):
        pairs = PAIRS.replace("rk4", f"rk4 onset {onset}")
        found = []
        for steps in (20, 40):
            deck = impact(f"wall/gran/cfpm {law} zplane 0 NULL predict exact", steps, place=start, pairs=pairs)
            deck = deck.replace(repr(TIME / steps), repr(contact / steps)).replace(f"run {steps}", f"run {2 * steps}")
            run(deck, tmp_path)
            found.append(read_dump(tmp_path / f"{steps}.dump")[0][1]["vz"][0] / SPEED)
        errors[onset] = abs(found[1] - expected)
        assert errors[onset] <= abs(found[1] - found[0]) < 0.05, (found, expected)
    assert errors["on"] < 0.5 * errors["off"], errors


def test_is_the_law_of_hooke(tmp_path):
    """Where the host has it under both names."""
    names = (
        "hooke 1e5 4e4 100 50 0.3 1",
        "granular hooke 1e5 100 damping mass_velocity tangential linear_history 4e4 0.5 0.3",
    )
    found = [
        velocities(tmp_path, LAUNCHER, f"wall/gran/cfpm {name} zplane 0 NULL predict exact", (32,), slip=2 * SPEED)[0]
        for name in names
    ]
    assert np.abs(found[0] - found[1]).max() < 1e-12 * SPEED
    assert abs(found[0][3]) > 0.01 * SPEED, "nothing has begun to turn"


def test_moving_region(tmp_path):
    """A plate that rises towards a sphere is one at rest that the sphere falls on; its speed is known from the second
    step on, when they do not touch yet."""
    speed = 0.5 * SPEED
    law = f"wall/gran/cfpm granular {CONTACTS['viscoelastic'][0]} region plate"
    steps, found = 64, []
    for rise in (0.0, speed):
        start = RADIUS + 3.5 * SPEED * TIME / steps
        move = f"variable no equal 0.0\nvariable up equal {rise!r}*step*{TIME / steps!r}\n"
        move += "region plate plane 0 0 0 0 0 1 units box" + (" move v_no v_no v_up" if rise else "")
        falling = {"place": (0, 0, start), "towards": (0, 0, rise / SPEED - 1), "slip": SPEED, "before": move}
        (end,) = velocities(tmp_path, LAUNCHER, law, (steps,), **falling)
        found.append(end - [0, 0, rise, 0, 0, 0])
    assert np.abs(found[0] - found[1]).max() < 1e-9 * SPEED
    assert abs(found[0][2] + SPEED) > 0.1 * SPEED and abs(found[0][3]) > 0.01 * SPEED, "the contact has done nothing"


@pytest.mark.parametrize("shape", ["zplane 0 NULL", "region plate"])
def test_suffix(tmp_path, shape):
    """A deck of the host's with a predictor: the wall follows, whether it stands before the pair style or behind."""
    wall = f"granular {CONTACTS['viscoelastic'][0]} {shape}"
    plate = "region plate plane 0 0 0 0 0 1 units box"
    steps = 16
    (named,) = velocities(tmp_path, LAUNCHER, f"wall/gran/cfpm {wall} predict rk4", (steps,), slip=SPEED, before=plate)
    kind = "wall/gran/region" if shape.startswith("region") else "wall/gran"
    deck = impact(f"{kind} {wall}", steps, SPEED, plate, pairs=PAIRS.replace("/cfpm", ""), move="nve/sphere")
    lines = deck.replace("clear\n", "").splitlines()
    pair = [line for line in lines if line.startswith("pair_")]
    rest = [line for line in lines if not line.startswith("pair_")]
    at = next(k for k, line in enumerate(rest) if line.startswith("fix integrate"))
    for text in (lines, rest[:at] + pair + rest[at:]):
        run("\n".join(text) + "\n", tmp_path, options=("-suffix", "cfpm"))
        sphere = read_dump(tmp_path / f"{steps}.dump")[0][1]
        assert sphere["vz"][0] == named[2] and sphere["vy"][0] == named[1] != SPEED


def test_follows_the_pair_style(tmp_path):
    """To forces of one instant, of the host's wall, and back, while the sphere flies towards it."""
    wall = f"granular {CONTACTS['viscoelastic'][0]} zplane 0 NULL"
    start = {"place": (0, 0, RADIUS + 10 * SPEED * TIME / 400), "slip": SPEED}

    def end(program, style, move, pairs):
        deck = impact(f"{style} {wall}", 400, pairs=pairs[0], move=move, **start).replace("run 400", "run 3")
        runs = "".join(f"{again}\nrun {steps}\n" for again, steps in zip(pairs[1:], (3, 400)))
        run(deck.replace("write_dump", runs + "write_dump"), tmp_path, program=program)
        return (tmp_path / "400.dump").read_text()

    verlet = PAIRS.replace("rk4", "verlet")
    stock = end(STOCK, "wall/gran", "nve/sphere", 3 * [STOCK_PAIRS])
    predicted = end(LAUNCHER, "wall/gran/cfpm", "nve/cfpm", 3 * [PAIRS])
    assert stock != predicted
    assert end(LAUNCHER, "wall/gran/cfpm", "nve/cfpm", [PAIRS, PAIRS, verlet]) == stock
    assert end(LAUNCHER, "wall/gran/cfpm", "nve/cfpm", [PAIRS, verlet, PAIRS]) == predicted


def test_unpredicted_beside_verlet(tmp_path):
    """Of a wall that stands before the pair style it is not known whether it will be predicted."""
    wall = "granular jkr 1e7 50 0.3 0.01 tangential mindlin NULL 0.5 0.5 zplane 0 NULL"
    found = []
    for program, style, pairs in ((STOCK, "", STOCK_PAIRS), (LAUNCHER, "/cfpm", PAIRS.replace("rk4", "verlet"))):
        lines = impact(f"wall/gran{style} {wall}", 400, SPEED, pairs="", move=f"nve/sphere\n{pairs}")
        run(lines, tmp_path, program=program)
        found.append((tmp_path / "400.dump").read_text())
    assert found[0] == found[1]


DRUM = {  # of a cylinder that turns, and a floor
    "material": "hertz/material 1e7 0.3 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji",
    "hooke": "hooke 2e4 100 tangential linear_history 8e3 0.5 0.5 damping mass_velocity",
}


def drum_deck(start, models, pair=True):
    wall = f"wall/gran/cfpm granular {DRUM[models]}"
    text = re.sub(r"wall/gran/cfpm hooke.*?(?= zplane| region)", wall, drum.deck(start, "hooke", pair))
    turn = "variable angle equal -40*step*2e-5\n"
    return re.sub("^(region drum .*)$", turn + r"\1 rotate v_angle 0 0 0 0 0 1", text, flags=re.MULTILINE)


@pytest.mark.parametrize("models", DRUM)
def test_continues_to_the_last_digit(tmp_path, models):
    first = drum_deck(drum.FRESH, models) + f"run {drum.HALF}\nwrite_restart bed.restart\n"
    run(first + drum.half("on"), tmp_path)
    run(drum_deck("read_restart bed.restart", models, pair=False) + drum.half("again"), tmp_path)
    same = (tmp_path / "on.dump").read_text() == (tmp_path / "again.dump").read_text()
    assert same
    last = read_dump(tmp_path / "on.dump")[-1][1]
    assert (last["x"] * last["vy"] - last["y"] * last["vx"]).mean() < -1e-4, "the drum takes nothing along"


def beside(models, options="", pairs="rk4", shape="zplane -1 NULL"):
    return {**given(PLAIN, pairs), "extra": f"fix w all wall/gran/cfpm granular {models} {shape} {options}"}


REFUSED = {
    "rolling by impulses": (
        beside(PLAIN + " rolling sds 1e3 1 0.1", "predict impulse"),
        ["(id w): 'rolling sds' has no form with 'predict impulse'; expected one of exact", "'predict verlet'"],
    ),
    "twisting by impulses": (
        beside(PLAIN + " twisting marshall", "predict impulse"),
        ["(id w): 'twisting marshall' has no form with 'predict impulse'"],
    ),
    "exact area springs": (
        beside("hertz 1e5 50 tangential mindlin_rescale/force 1e5 0.5 0.1", "predict exact"),
        ["(id w): 'tangential mindlin_rescale/force' has no form with 'predict exact'; expected one of rk2, rk4, or"],
    ),
    "exact dmt": (
        beside("dmt 1e5 50 0.3 10 tangential linear_nohistory 0.5 0.1", "predict exact"),
        ["(id w): 'dmt' has no form with 'predict exact'; expected one of rk2, rk4, or 'predict verlet'"],
    ),
    "jkr": (beside("jkr 1e5 50 0.3 10 tangential linear_nohistory 0.5 0.1"), ["(id w): 'jkr' has no predicted form"]),
    "restitution": (
        beside("hooke 1e5 1.5 tangential linear_nohistory 0.5 0.1 damping tsuji"),
        ["(id w): 'a coefficient out of its range' has no predicted form"],
    ),
    "impulse of any law": (
        beside("hertz 1e7 5e4 tangential linear_history 1e3 0.5 0.1", "predict impulse"),
        ["(id w): predictor 'impulse' has no form for these sub-models; expected one of rk2, rk4, or 'predict verlet'"],
    ),
    "exact of any law": (
        beside(PLAIN, "predict exact"),
        ["(id w): predictor 'exact' has no form for these sub-models; expected one of rk2, rk4, or 'predict verlet'"],
    ),
    "auto": (beside(PLAIN, "predict auto"), ["'predict auto' belongs to the pair style, which walls follow"]),
    "onset": (beside(PLAIN, "onset on"), ["'onset' belongs to the pair style, which walls follow"]),
    "verlet": (beside(PLAIN, "predict verlet"), ["(id w): not predicted, beside pair_style gran/cfpm"]),
    "verlet of pairs": (
        {**beside(PLAIN, "predict rk4", "verlet"), "integrator": "fix i all nve/sphere"},
        ["(id w): predicted beside a pair style with 'predict none'"],
    ),
    "host's": (beside("hooke 1e5"), ["ERROR"]),
    "shape": (beside(PLAIN, shape="wplane 0 1"), ["ERROR"]),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", REFUSED)
def test_is_refused(tmp_path, case, ranks):
    changes, fragments = REFUSED[case]
    error = first_error(small(tmp_path, options=(), check=False, np=ranks, **{**GRANULAR, **changes}))
    for fragment in fragments:
        assert fragment in error, error


def test_report(tmp_path):
    """With the time of a contact, pi (m/k)^(1/2)."""
    output = run(impact(f"wall/gran/cfpm granular {CONTACTS['hooke'][0]} zplane 0 NULL", 16), tmp_path).stdout
    assert re.search(rf"wall wall: +tc = {np.pi * np.sqrt(MASS / 1e5):.4g} to .*; predict rk4", output), output
