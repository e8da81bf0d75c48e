# SPDX-License-Identifier: GPL-2.0-or-later
"""What an unmodified deck gets with -suffix cfpm: the host's own step where that is right, to the last digit, and
impulses where it is not; what the log says of it; how it goes through later runs and restarts; other choices."""

import re

import falling_bed as bed
import numpy as np
import pytest
from harness.liggghts import PRELOAD, STOCK, run
from harness.output import read_dump

SUFFIX = ("-suffix", "cfpm")
SHORTEST = 0.001149  # contact time of two of the smaller spheres, see test_time_step_report.py [s]
MANY, FEW = SHORTEST / 20.0, SHORTEST / 5.0  # right from nt = 6 on
MODELS = {"hooke": bed.HOOKE, "hertz": "model hertz tangential history"}
# what a particle may move by in a step in which its contacts begin
REACH = "neighbor 0.002 bin\nneigh_modify delay 0 contact_distance_factor 1.5\n"


@pytest.fixture
def folder(tmp_path):
    bed.write(tmp_path)
    return tmp_path


def deck(dt=MANY, model=bed.HOOKE, wall="plane", styles=bed.STOCK, particles="read_data bed.data", **options):
    settings = options.get("settings", "")
    pair = bed.pair(styles, model, settings) if options.get("pair", True) else ""
    return bed.box(particles) + REACH + f"timestep {dt!r}\n" + pair + bed.fixes(styles, model, settings, wall)


def steps(name, count=800):
    return bed.dump_particles(f"{name}.dump", every=count // 2) + f"run {count}\nundump bed\n"


def choices(output):
    return re.findall(r"gran/cfpm: predict auto \((\w+)\)", output)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("wall", ["plane", "mesh"])
@pytest.mark.parametrize("model", MODELS)
def test_is_stock_at_many_steps(folder, model, wall, ranks):
    text = deck(model=MODELS[model], wall=wall)
    run(text + steps("stock"), folder, program=STOCK, np=ranks)
    output = run(text + steps("auto"), folder, options=SUFFIX, np=ranks).stdout
    assert choices(output) == ["verlet"]
    bed.assert_same_text(folder / "auto.dump", folder / "stock.dump", "auto at many steps")


@pytest.mark.parametrize("wall", ["plane", "mesh"])
def test_gives_impulses_at_few_steps(folder, wall):
    text = deck(FEW, wall=wall)
    assert choices(run(text + steps("auto", 200), folder, options=SUFFIX).stdout) == ["impulse"]
    run(text + steps("impulse", 200), folder, options=(*SUFFIX, "-predict", "impulse"))
    bed.assert_same_text(folder / "auto.dump", folder / "impulse.dump", "auto at few steps")


def test_says_why_and_how_far(folder):
    output = run(deck(FEW) + "run 0\n", folder, options=SUFFIX).stdout
    uses = {"dense beds at rest come out right": 1, "flows are right": 2, "agitated grains are right": 4}
    for text, nt in {"cheapest": 6, **uses}.items():
        found = re.search(rf"{text} up to dt = (\S+), nt = {nt}\b", output)
        assert float(found[1]) == pytest.approx(SHORTEST / nt, rel=1e-3)
    assert "impulse at fewer steps" in output and "WARNING: fix nve/cfpm" not in output


@pytest.mark.parametrize("nt", [60, 3])
def test_law_without_impulses_is_stock(folder, nt):
    """With a warning for each use where the step is too large."""
    model = "model hertz/stiffness tangential history"
    time = re.search(r"types 1-1: +tc = (\S+)", run(deck(1e-6, model) + "run 0\n", folder, options=SUFFIX).stdout)
    text = deck(float(time[1]) / nt, model)
    run(text + steps("stock", 200), folder, program=STOCK)
    output = run(text + steps("auto", 200), folder, options=SUFFIX).stdout
    assert choices(output) == ["verlet"] and output.count("WARNING: fix nve/cfpm: ") == (3 if nt < 6 else 0)
    bed.assert_same_text(folder / "auto.dump", folder / "stock.dump", "law without impulses")


@pytest.mark.parametrize("wall", ["plane", "mesh"])
def test_chooses_again_with_another_step(folder, wall):
    text = deck(FEW, wall=wall) + f"run 2000\nrun 10\ntimestep {MANY!r}\n" + steps("bed") + f"timestep {FEW!r}\n"
    output = run(text + steps("again", 400), folder, options=SUFFIX).stdout
    assert choices(output) == ["impulse", "verlet", "impulse"]
    for name in ("bed", "again"):
        for _, columns in read_dump(folder / f"{name}.dump"):
            assert len(columns["z"]) == bed.COUNT and columns["z"].min() > 0.0 and columns["z"].max() < 0.1
            assert np.abs(columns["vz"]).max() < 0.5  # nothing is thrown


@pytest.mark.parametrize("dt", [MANY, FEW], ids=["verlet", "impulse"])
@pytest.mark.parametrize("pair", [True, False], ids=["pair_style", "no_pair_style"])
@pytest.mark.parametrize("wall", ["plane", "mesh"])
def test_restart_continues_to_the_last_digit(folder, dt, pair, wall):
    text = deck(dt, wall=wall) + f"run {round(0.05 / dt)}\nwrite_restart bed.restart\n" + steps("on", 400)
    before = run(text, folder, options=SUFFIX).stdout
    text = deck(dt, wall=wall, particles="read_restart bed.restart", pair=pair) + steps("again", 400)
    after = run(text, folder, options=SUFFIX).stdout
    assert choices(before) == choices(after) != []
    bed.assert_same_text(folder / "again.dump", folder / "on.dump", "restarted")


TEMPLATES = """
fix small all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.004
fix mixture all particledistribution/discrete 32452843 1 small 1.0
region fill block 0 0.08 0 0.08 0.03 0.1 units box
fix insert all insert/pack seed 49979687 distributiontemplate mixture insert_every once overlapcheck yes &
    all_in yes particles_in_region 30 region fill
"""


def empty_box(dt):
    create = f"region box block 0 {bed.SIDE} 0 {bed.SIDE} -0.01 {bed.HEIGHT} units box\ncreate_box 2 box"
    # the host sorts particles by their size, and stops where there is none
    return deck(dt, particles=create).replace("atom_modify map array", "atom_modify map array sort 0 0")


@pytest.mark.parametrize("dt, choice", [(MANY, "verlet"), (FEW, "impulse")])
def test_knows_particles_that_are_to_come(folder, dt, choice):
    output = run(empty_box(dt) + TEMPLATES + "run 0\nrun 200\n", folder, options=SUFFIX).stdout
    assert choices(output)[0] == choice and set(choices(output)) == {choice}


def test_begins_with_impulses_where_nothing_is_known(folder):
    """And keeps them while the step is the same: the choice is in the restart file."""
    sphere = "create_atoms 1 single 0.04 0.04 0.02 units box\nset group all diameter 0.008 density 2500\n"
    first = empty_box(MANY) + "run 0\n" + sphere + "run 100\nwrite_restart bed.restart\n" + steps("on", 200)
    output = run(first, folder, options=SUFFIX).stdout
    assert set(choices(output)) == {"impulse"}
    assert "from nt = 6 on, looked at when a run begins with particles" in output
    again = deck(particles="read_restart bed.restart", pair=False) + steps("again", 200)
    assert choices(run(again, folder, options=SUFFIX).stdout) == ["impulse"]
    bed.assert_same_text(folder / "again.dump", folder / "on.dump", "restarted")


@pytest.mark.parametrize("way", ["option", "environment"])
@pytest.mark.parametrize("predictor, found", [("rk2", "rk2"), ("none", "verlet"), ("auto", "auto (verlet)")])
def test_any_predictor_for_an_unmodified_deck(folder, predictor, found, way):
    given = {
        "option": {"options": (*SUFFIX, "-predict", predictor)},
        "environment": {"program": STOCK, "options": SUFFIX, "env": {"LD_PRELOAD": PRELOAD, "CFPM_PREDICT": predictor}},
    }[way]
    assert f"gran/cfpm: predict {found}, dt" in run(deck() + "run 1\n", folder, **given).stdout


def test_a_predictor_that_there_is_not(folder):
    process = run(deck() + "run 1\n", folder, options=("-predict", "euler", *SUFFIX), check=False)
    assert process.returncode != 0
    assert "ERROR: pair_style gran/cfpm: unknown predictor 'euler'; expected one of exact, " in process.stdout


@pytest.mark.parametrize("options", [(), SUFFIX])
def test_a_named_style_keeps_its_default(folder, options):
    named = {**bed.PREDICTED}
    del named["predict"]
    assert "gran/cfpm: predict exact, dt" in run(deck(styles=named) + "run 0\n", folder, options=options).stdout


@pytest.mark.parametrize("predictor", ["auto", "verlet", "none"])
def test_auto_and_verlet_by_name(folder, predictor):
    """Beside fix nve/cfpm, which does the step that the pair style is made for."""
    run(deck() + steps("stock", 400), folder, program=STOCK)
    text = deck(styles={**bed.PREDICTED, "predict": predictor})
    run(text + steps("named", 400), folder)
    bed.assert_same_text(folder / "named.dump", folder / "stock.dump", predictor)


def test_walls_follow_auto(folder):
    process = run(deck(styles={**bed.PREDICTED, "wall": "wall/gran/cfpm predict auto"}), folder, check=False)
    assert "(id floor): 'predict auto' belongs to the pair style, which walls follow" in process.stdout


@pytest.mark.parametrize("dt, refused", [(MANY, False), (FEW, True)])
def test_setting_without_prediction(folder, dt, refused):
    """What the host's step can do and a prediction cannot is the host's at many steps, and refused at few."""
    text = deck(dt, settings="computeElasticPotential on") + "run 1\n"
    process = run(text, folder, options=SUFFIX, check=False)
    assert ("has no predicted form" in process.stdout) == refused, process.stdout[-1500:]


def test_frozen_group_stays(folder):
    freeze = """
group fixed id 1:40
group mobile subtract all fixed
velocity fixed set 0 0 0
fix ice fixed freeze
unfix integrate
fix integrate mobile nve/sphere
"""
    for dt in (MANY, FEW):
        run(deck(dt) + freeze + steps("auto", 400), folder, options=SUFFIX)
        first, *_, last = (columns for _, columns in read_dump(folder / "auto.dump"))
        moved = np.abs(last["z"] - first["z"])
        assert np.all(moved[:40] == 0.0) and np.all(last["fz"][:40] == 0.0) and moved[40:].max() > 1e-3
        if dt == MANY:
            run(deck(dt) + freeze + steps("stock", 400), folder, program=STOCK)
            bed.assert_same_text(folder / "auto.dump", folder / "stock.dump", "with a frozen group")
