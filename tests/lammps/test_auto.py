# SPDX-License-Identifier: GPL-2.0-or-later
"""What an unmodified deck gets with -suffix cfpm: the host's own step where that is right, to the last digit, and
impulses where it is not; what the log says of it; how it goes through later runs and restarts; other choices."""

import re
from math import log, pi, sqrt

import drum
import numpy as np
import pytest
from harness.lammps import LAUNCHER, PRELOAD, STOCK, run
from harness.output import read_dump
from stock_words import in_stock_words

SUFFIX = ["-suffix", "cfpm"]
MASS = 2500.0 * pi / 6.0 * 0.01**3  # of the spheres of the drum
SHORTEST = pi * sqrt(0.5 * MASS / 2e4)  # contact time of two of them
MANY, FEW = SHORTEST / 35.0, SHORTEST / 2.1  # time steps; right from nt = 30 on, as friction has a dashpot
WALLS = ("zplane 0.0 NULL", "region drum")


def stock(dt=MANY, law="hooke", start=drum.FRESH, pair=True, dampflag=1):
    deck = in_stock_words(drum.deck(start, law, pair=pair, walls=WALLS)).replace("timestep 2e-5", f"timestep {dt!r}")
    return deck.replace(" 0.5 1", f" 0.5 {dampflag}") + "neigh_modify delay 0 every 1\nneighbor 0.002 bin\n"


def steps(name, count=1200):
    return drum.half(name).replace(f"run {drum.HALF}", f"run {count}").replace("custom 500", f"custom {count // 2}")


def same(folder, *names):
    first, second = ((folder / f"{name}.dump").read_text() for name in names)
    return first == second


def choices(output):
    return re.findall(r"gran/cfpm: predict auto \((\w+)\)", output)


@pytest.mark.parametrize("dampflag, nt", [(1, 31), (0, 7)])
@pytest.mark.parametrize("ranks", [1, 2])
def test_is_stock_at_many_steps(tmp_path, ranks, dampflag, nt):
    """With a floor and a region as walls; without a dashpot in friction, dampflag 0, stock is right from nt = 6 on."""
    deck = stock(SHORTEST / nt, dampflag=dampflag)
    run(deck + steps("stock"), tmp_path, program=STOCK, np=ranks)
    output = run(deck + steps("auto"), tmp_path, options=SUFFIX, np=ranks).stdout
    assert choices(output) == ["verlet"] and "WARNING" not in output
    assert same(tmp_path, "stock", "auto")


@pytest.mark.parametrize("dampflag, nt", [(1, 29), (0, 5.5), (1, 2.1)])
def test_gives_impulses_at_few_steps(tmp_path, dampflag, nt):
    deck = stock(SHORTEST / nt, dampflag=dampflag)
    output = run(deck + steps("auto", 200), tmp_path, options=SUFFIX).stdout
    assert choices(output) == ["impulse"]
    run(deck + steps("impulse", 200), tmp_path, options=[*SUFFIX, "-predict", "impulse"])
    assert same(tmp_path, "auto", "impulse")


def test_says_why_and_how_far(tmp_path):
    output = run(stock() + "run 0\n", tmp_path, options=SUFFIX).stdout
    uses = {"dense beds at rest come out right": 30, "flows are right": 10, "agitated grains are right": 6}
    for text, nt in {"cheapest": 30, **uses}.items():
        assert f"{text} up to dt = {SHORTEST / nt:.4g}, nt = {nt}" in output, output


@pytest.mark.parametrize("nt", [31, 4.7])
def test_law_without_measured_impulses_is_stock(tmp_path, nt):
    """With a warning for each use where the step is too large. A Hertz contact at speed 1 lasts 3.218 (m/k)^(2/5)."""
    shortest = 3.218065 * (0.5 * MASS / (1e7 * sqrt(0.0025))) ** 0.4
    deck = stock(shortest / nt, law="hertz")
    run(deck + steps("stock", 300), tmp_path, program=STOCK)
    output = run(deck + steps("auto", 300), tmp_path, options=SUFFIX).stdout
    assert choices(output) == ["verlet"] and same(tmp_path, "stock", "auto")
    warnings = re.findall(r"WARNING: fix nve/cfpm: .* right up to dt = (\S+), nt = (\d+),", output)
    expected = [(f"{shortest / n:.4g}", str(n)) for n in (30, 10, 6)] if nt < 6 else []
    assert [(dt.rstrip(","), n) for dt, n in warnings] == expected


def test_chooses_again_with_another_step(tmp_path):
    """And with the walls: the later run goes on as a bed that is at rest does. With the same step a choice stays.

    At so few steps spheres lie 5.5 times as deep as their load over the stiffness, which is at most that of ten layers.
    Let go, one reaches that overlap times sqrt(k/m).
    """
    let_go = 5.5 * 10 * 9.81 * sqrt(MASS / 2e4)
    deck = stock(FEW) + f"run 3000\nrun 10\ntimestep {MANY!r}\nrun 0\n" + steps("bed")
    output = run(deck + f"timestep {FEW!r}\n" + steps("again", 500), tmp_path, options=SUFFIX).stdout
    assert choices(output) == ["impulse", "verlet", "impulse"]
    for name in ("bed", "again"):
        for _, columns in read_dump(tmp_path / f"{name}.dump"):
            assert len(columns["z"]) == 435 and columns["z"].min() > 0.0 and columns["z"].max() < 0.1
            assert np.abs(columns["vz"]).max() < let_go, "thrown"


@pytest.mark.parametrize("dt", [MANY, FEW], ids=["verlet", "impulse"])
@pytest.mark.parametrize("pair", [True, False], ids=["pair_style", "no_pair_style"])
def test_restart_continues_to_the_last_digit(tmp_path, dt, pair):
    count = round(0.03 / dt)
    first = stock(dt) + f"run {count}\nwrite_restart bed.restart\n" + steps("on", 400)
    before = run(first, tmp_path, options=SUFFIX).stdout
    again = stock(dt, start="read_restart bed.restart", pair=pair) + steps("again", 400)
    after = run(again, tmp_path, options=SUFFIX).stdout
    assert choices(before) == choices(after) != []
    assert same(tmp_path, "on", "again")


@pytest.mark.parametrize("dt, method", [(MANY, "verlet"), (FEW, "impulse")])
def test_choice_for_particles_to_come_stays_also_after_a_restart(tmp_path, dt, method):
    """What fix pour will add is known when the first run begins."""
    box = """region box block -0.05 0.05 -0.05 0.05 -0.01 0.4 units box
create_box 1 box"""
    slab = "region slab block -0.025 0.025 -0.025 0.025 0.15 0.165 units box\n"
    pour = slab + "fix pour all pour 50 1 4767548 vol 0.3 50 diam one 0.01 dens 2500 2500 region slab\n"
    empty = stock(dt, start=box).replace("map array ", "")
    deck = empty + pour + "run 2000\nunfix pour\nrun 0\nwrite_restart bed.restart\n" + steps("on", 400)
    output = run(deck, tmp_path, options=SUFFIX).stdout
    assert set(choices(output)) == {method}
    again = stock(dt, start="read_restart bed.restart", pair=False).replace("map array ", "")
    assert choices(run(again + steps("again", 400), tmp_path, options=SUFFIX).stdout) == [method]
    assert same(tmp_path, "on", "again")


GAS_DENSITY, GAS_E = 1.0, 0.9  # of diameter 1


def energy_left(folder, nt, program, options, seed):
    """Of 512 grains of restitution 0.9 at a solid fraction of 0.34, over a time in which four fifths are lost."""
    reduced = GAS_DENSITY * pi / 12.0
    tc = pi * sqrt(reduced / 2e5)
    gamma = -2.0 * log(GAS_E) / tc
    side = 8 * 1.15
    deck = f"""
units lj
atom_style sphere
newton off
comm_modify vel yes
region box block 0 {side} 0 {side} 0 {side} units box
create_box 1 box
lattice sc {1.15**-3} origin 0.5 0.5 0.5
create_atoms 1 box
set group all diameter 1 density {GAS_DENSITY}
variable kick atom random(-5,5,{seed})
velocity all set v_kick v_kick v_kick units box
velocity all zero linear
pair_style gran/hooke/history 2e5 NULL {gamma} NULL 0.3 1
pair_coeff * *
fix integrate all nve/sphere
neighbor 0.3 bin
neigh_modify every 1 delay 0
timestep {tc / nt}
compute kinetic all ke
compute spin all erotate/sphere
variable energy equal c_kinetic+c_spin
thermo_style custom step c_kinetic c_spin
thermo_modify norm no
run 0
print "ENERGY ${{energy}}"
run {round(0.5 / tc * nt)}
print "ENERGY ${{energy}}"
"""
    output = run(deck, folder, program=program, options=options).stdout
    start, end = map(float, re.findall(r"(?m)^ENERGY (\S+)", output))
    return end / start


@pytest.mark.parametrize("nt", [4, 6, 30])
def test_a_gas_cools_as_it_should(tmp_path, nt):
    """An agitated deck, as which auto has to be right though it knows of none. Against stock at nt = 100, where it has
    converged; 3 % is what counts as right (core/predict/right_from.h), beside three standard errors of 4 starts, of
    which one scatters by 2 % (./cfpm validate agitated). With `exact` 11 % are too much at nt = 10, 35 % at 6."""
    ratios = [
        energy_left(tmp_path, nt, LAUNCHER, SUFFIX, seed) / energy_left(tmp_path, 100, STOCK, [], seed)
        for seed in (10007, 10009, 10037, 10039)
    ]
    assert abs(np.mean(ratios) - 1.0) < 0.03 + 3.0 * 0.02 / sqrt(len(ratios))


@pytest.mark.parametrize("way", ["option", "environment"])
@pytest.mark.parametrize("predictor, found", [("rk2", "rk2"), ("none", "verlet"), ("auto", "auto (verlet)")])
def test_any_predictor_for_an_unmodified_deck(tmp_path, predictor, found, way):
    given = {
        "option": {"options": [*SUFFIX, "-predict", predictor]},
        "environment": {"program": STOCK, "options": SUFFIX, "env": {"LD_PRELOAD": PRELOAD, "CFPM_PREDICT": predictor}},
    }[way]
    assert f"gran/cfpm: predict {found}, dt" in run(stock() + "run 1\n", tmp_path, **given).stdout


@pytest.mark.parametrize(
    "law, predictor, message",
    [
        ("hooke", "euler", "unknown predictor 'euler'; expected one of exact, "),
        ("hertz", "exact", "predictor 'exact' has no form for hertz; expected one of rk2, rk4, impulse, verlet, auto"),
    ],
)
def test_a_predictor_that_there_is_not(tmp_path, law, predictor, message):
    process = run(stock(law=law) + "run 1\n", tmp_path, options=["-predict", predictor, *SUFFIX], check=False)
    assert process.returncode != 0 and f"ERROR: pair_style gran/cfpm: {message}" in process.stdout


def test_a_named_style_keeps_its_default(tmp_path):
    deck = drum.deck(drum.FRESH, "hooke") + "run 0\n"
    assert "gran/cfpm: predict exact, dt" in run(deck, tmp_path).stdout
    assert "gran/cfpm: predict exact, dt" in run(deck, tmp_path, options=SUFFIX).stdout


def test_auto_and_verlet_by_name(tmp_path):
    """Also beside fix nve/cfpm, which does the step that the pair style is made for."""
    deck = stock()
    run(deck + steps("stock", 300), tmp_path, program=STOCK)
    ours = drum.deck(drum.FRESH, "hooke", walls=WALLS).replace("timestep 2e-5", f"timestep {MANY!r}")
    ours += "neigh_modify delay 0 every 1\nneighbor 0.002 bin\n"
    for predictor in ("auto", "verlet", "none"):
        style = f"pair_style gran/cfpm {drum.CONTACT['hooke']}"
        named = ours.replace(style, f"{style} predict {predictor}")
        run(named + steps(predictor, 300), tmp_path)
        assert same(tmp_path, "stock", predictor), predictor


def test_walls_follow_auto(tmp_path):
    deck = drum.deck(drum.FRESH, "hooke").replace("0.5 1 zplane", "0.5 1 predict auto zplane")
    process = run(deck, tmp_path, check=False)
    assert "'predict auto' belongs to the pair style, which walls follow" in process.stdout


def test_frozen_group_stays(tmp_path):
    """Frozen grains act with infinite mass and do not move, whichever step is chosen."""
    freeze = """
group fixed id 1:40
group mobile subtract all fixed
velocity fixed set 0 0 0
fix ice fixed freeze
unfix integrate
fix integrate mobile nve/sphere
"""
    for dt in (MANY, FEW):
        run(stock(dt) + freeze + steps("auto", 400), tmp_path, options=SUFFIX)
        first, *_, last = (columns for _, columns in read_dump(tmp_path / "auto.dump"))
        moved = np.abs(last["z"] - first["z"])
        assert np.all(moved[:40] == 0.0) and np.all(last["fz"][:40] == 0.0) and moved[40:].max() > 1e-3
    run(stock(MANY) + freeze + steps("stock", 400), tmp_path, program=STOCK)
    run(stock(MANY) + freeze + steps("auto", 400), tmp_path, options=SUFFIX)
    assert same(tmp_path, "stock", "auto")
