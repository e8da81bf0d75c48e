# SPDX-License-Identifier: GPL-2.0-or-later
"""Predicted contacts with the sub-models of pair_style granular: single contacts (see granular_contacts.py), beds, and
what has no predicted form."""

import re

import numpy as np
import pytest
from granular_bed import IS_NEWER, granular_bed
from granular_contacts import CONTACTS, DENSITY, RADIUS, SPEED, START, TIME, TWO_SPHERES, closing_speed
from harness.instruction_sets import SETS
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import first_error, read_dump, vectors
from test_granular import GRANULAR, small


def deck(models, predict, steps, slip, style="granular/cfpm", integrator="nve/cfpm"):
    at = RADIUS - START / 2
    return f"""
clear
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
create_atoms 1 single -{at!r} 0 0 units box
create_atoms 1 single {at!r} 0 0 units box
set group all diameter {2 * RADIUS} density {DENSITY}
set atom 1 vx {SPEED / 2} vy {slip / 2}
set atom 2 vx -{SPEED / 2} vy -{slip / 2}
pair_style {style} {predict}
pair_coeff * * {models}
fix integrate all {integrator}
timestep {TIME / steps!r}
run {steps}
write_dump all custom {steps}.dump id vx vy vz omegax omegay omegaz modify sort id format float %.17g
"""


def velocities(folder, program, models, predict, steps, slip=0.0, **words):
    """Of the first sphere after T, for each number of steps: vx, vy, and what the spin moves the surface by."""
    text = "".join(deck(models, predict, n, slip, **words) for n in steps)
    run(text, folder, program=program)
    found = []
    for n in steps:
        sphere = read_dump(folder / f"{n}.dump")[0][1]
        found.append(np.array([sphere["vx"][0], sphere["vy"][0], RADIUS * sphere["omegaz"][0]]))
    return found


@pytest.mark.parametrize("name", CONTACTS)
def test_head_on(tmp_path, name):
    models, predict, force = CONTACTS[name]
    coarse, fine = velocities(tmp_path, LAUNCHER, models, f"predict {predict}", (16, 32))
    expected = closing_speed(force, TWO_SPHERES) / 2
    assert abs(fine[0] - expected) <= abs(fine[0] - coarse[0])
    assert abs(fine[0] - coarse[0]) < 0.05 * SPEED
    assert abs(expected - SPEED / 2) > 0.1 * SPEED, "the contact has done nothing"


@pytest.mark.parametrize("name", CONTACTS)
def test_oblique(tmp_path, name):
    """Against the host's own style at small steps, whose error is of first order. The slip of its contacts is that of
    points at the radius, here it is that of the middle of the overlap: a part of half of that over the radius."""
    models, predict, _ = CONTACTS[name]
    coarse, fine = velocities(tmp_path, LAUNCHER, models, f"predict {predict}", (16, 32), SPEED)
    host = {"style": "granular", "integrator": "nve/sphere"}
    host_coarse, host_fine = velocities(tmp_path, STOCK, models, "", (1024, 2048), SPEED, **host)
    overlap = START + SPEED * TIME
    allowed = np.abs(fine - coarse) + np.abs(host_fine - host_coarse) + overlap / RADIUS * SPEED
    assert np.all(np.abs(fine - host_fine) <= allowed), (fine, host_fine, allowed)
    assert abs(fine[2]) > 0.01 * SPEED, "nothing has begun to turn"


MIXED = {
    "* *": "hertz/material 1e7 0.4 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji",
    "1 1": "hooke 2e4 100 tangential linear_history 8e3 0.5 0.5 damping mass_velocity",
    "2 2": "hertz 1e7 5e4 tangential linear_nohistory 0.5 0.4 limit_damping",
}
SOFT = "hertz 1e7 5e4 tangential"
AREA_SPRINGS = {
    "* *": f"{SOFT} mindlin_rescale/force 6e6 0.5 0.4",
    "1 1": f"{SOFT} mindlin/force 6e6 0.5 0.4",
    "2 2": f"{SOFT} mindlin_rescale 6e6 0.5 0.4",
}
TURNS = {  # resisted
    "* *": MIXED["* *"] + " rolling sds 2e3 1 0.1 twisting marshall",
    "1 1": MIXED["1 1"] + " rolling sds 1e3 0 0.05",
    "2 2": AREA_SPRINGS["* *"] + " twisting sds 1e-2 1e-7 2e-4",
}
ADHESIVE = {  # the pull is about the weight of a grain
    "* *": "dmt 1e7 5e4 0.3 0.1 tangential mindlin_rescale NULL 1.0 0.5 rolling sds 2e3 1 0.1 twisting marshall",
    "1 1": MIXED["1 1"],
    "2 2": "dmt 1e7 {} 0.3 0.1 tangential linear_nohistory 0.5 0.4 damping {}".format(
        *((5e4, "viscoelastic") if IS_NEWER else (0.4, "tsuji"))  # which newer hosts refuse beside adhesion
    ),
}
BEDS = {
    "mixed": (MIXED, "rk4"),
    "similar": ({"* *": MIXED["* *"]}, "exact"),
    "linear": ({"* *": MIXED["1 1"]}, "exact"),
    "area springs": (AREA_SPRINGS, "rk4"),
    "turns": (TURNS, "rk2"),
    "adhesive": (ADHESIVE, "rk4"),
    "linear turns": ({"* *": TURNS["1 1"] + " twisting marshall"}, "exact"),
    "turns with onset": ({"* *": TURNS["* *"]}, "exact onset on"),
    "linear impulse": ({"* *": MIXED["1 1"]}, "impulse split 0.5"),
    "similar impulse": ({"* *": MIXED["* *"]}, "impulse"),
    "viscoelastic impulse": ({"* *": "hertz 1e7 5e4 tangential mindlin 1e7 0.5 0.4"}, "impulse"),
}
COLUMNS = "id x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"


def predicted_bed(name, start=None, after="", pair=True):
    models, predict = BEDS[name]
    text = granular_bed("hooke", "off", after="")
    lines = text.splitlines()
    first, last = (k for k, line in enumerate(lines) if line.startswith("pair_"))
    coefficients = [f"pair_coeff {types} {words}" for types, words in models.items()]
    pair_lines = [f"pair_style granular/cfpm predict {predict}", *coefficients] if pair else []
    lines = lines[:first] + pair_lines + lines[last + 1:]
    text = "\n".join(lines).replace("fix integrate all nve/sphere", "fix integrate all nve/cfpm")
    floor = f"fix floor all wall/gran/cfpm granular {next(iter(models.values()))}"
    text = re.sub(r"fix floor .* zplane", f"{floor} zplane", text)
    text = re.sub(r"^dump.*\n", "", text, flags=re.MULTILINE)
    text = text.replace("atom_style sphere", "atom_style sphere\natom_modify map array sort 0 0")
    if start:
        text = re.sub(r"region box .*?(?=^neighbor)", start + "\n", text, flags=re.MULTILINE | re.DOTALL)
    return text + after + "\n"


def state(name):
    return f"write_dump all custom {name}.dump {COLUMNS} modify sort id format float %.17g\n"


@pytest.mark.parametrize("name", [name for name in BEDS if "onset" not in name])
def test_same_bits(tmp_path, name):
    """Whether contacts are computed one by one or several at a time."""
    found = []
    for instructions in SETS:
        text = predicted_bed(name, after="run 500\n" + state("last"))
        output = run(text, tmp_path, env={"CFPM_SIMD": instructions}).stdout
        assert (instructions == "scalar") == ("at a time" not in output)
        found.append((tmp_path / "last.dump").read_text())
    assert all(other == found[0] for other in found[1:])
    last = read_dump(tmp_path / "last.dump")[0][1]
    assert np.count_nonzero(last["tqx"]) > 20, "hardly any contact"


@pytest.mark.parametrize("name", ["mixed", "turns", "adhesive", "linear impulse"])
@pytest.mark.parametrize("style", ["hybrid", "hybrid/overlay"])
def test_under_another_style(tmp_path, name, style):
    """The same contacts, and beside them a style whose forces are none."""
    other = " zero 0.005" if style == "hybrid/overlay" else ""
    found = []
    for nested in (False, True):
        text = predicted_bed(name, after="run 500\n" + state("last"))
        if nested:
            text = text.replace("pair_style granular/cfpm", f"pair_style {style} granular/cfpm")
            text = re.sub(r"pair_coeff (\S+ \S+)", r"pair_coeff \1 granular/cfpm", text)
            if other:
                text = re.sub(r"(pair_style .*)", rf"\1{other}\npair_coeff * * zero", text)
        run(text, tmp_path)
        found.append((tmp_path / "last.dump").read_text())
    same = found[0] == found[1]
    assert same
    assert np.count_nonzero(read_dump(tmp_path / "last.dump")[0][1]["tqx"]) > 20, "hardly any contact"


@pytest.mark.parametrize(
    "name, pair",
    [
        ("mixed", True),
        ("mixed", False),
        ("turns", True),
        ("turns", False),
        ("adhesive", True),
        ("adhesive", False),
        ("turns with onset", False),
        ("linear impulse", False),
        ("similar impulse", True),
    ],
)
def test_continues_to_the_last_digit(tmp_path, name, pair):
    run(predicted_bed(name, after="run 800\nwrite_restart bed.restart\nrun 200\n" + state("on")), tmp_path)
    start = "read_restart bed.restart"
    run(predicted_bed(name, start, "run 200\n" + state("again"), pair), tmp_path)
    same = (tmp_path / "on.dump").read_text() == (tmp_path / "again.dump").read_text()
    assert same


@pytest.mark.parametrize(
    "name", ["mixed", "turns", "adhesive", "linear impulse", "similar impulse", "viscoelastic impulse"]
)
def test_on_two_ranks(tmp_path, name):
    """Forces from the same positions and springs differ by the rounding of sums in another order."""
    run(predicted_bed(name, after="run 800\nrun 0\nwrite_restart bed.restart\n"), tmp_path)
    forces = []
    for ranks in (1, 2):
        run(predicted_bed(name, "read_restart bed.restart", "run 0\n" + state("first")), tmp_path, np=ranks)
        forces.append(vectors(read_dump(tmp_path / "first.dump")[0][1], "fx", "fy", "fz"))
    scale = np.abs(forces[0]).max()
    assert scale > 0.1
    assert np.abs(forces[0] - forces[1]).max() < 50 * np.finfo(float).eps * scale


def test_pairs_in_the_other_order(tmp_path):
    """Between ranks and with newton on a pair is listed by either of its particles in turn, and what it keeps goes over
    from one to the other: spring, twist, what has rolled, the area before. So the beds stay the same but for rounding,
    which collisions make larger; a wrong sign would turn contacts otherwise at once."""
    spins = []
    run(predicted_bed("turns", after="run 0\nwrite_restart bed.restart\n"), tmp_path)
    for newton, ranks in (("off", 1), ("on", 1), ("on", 2), ("off", 2)):
        text = predicted_bed("turns", "read_restart bed.restart", "run 600\n" + state("last"))
        run(text.replace("newton off", f"newton {newton}"), tmp_path, np=ranks)
        spins.append(vectors(read_dump(tmp_path / "last.dump")[0][1], "omegax", "omegay", "omegaz"))
    scale = np.abs(spins[0]).max()
    differences = [np.abs(other - spins[0]).max() / scale for other in spins[1:]]
    print(f"off by {differences} of {scale}")
    assert scale > 10.0 and max(differences) < 1e-7


def test_another_history_is_not_taken_over(tmp_path):
    """Of a restart file: the host would take one for the other. Behind a first run it begins anew."""
    run(predicted_bed("similar", after="run 800\nwrite_restart bed.restart\n"), tmp_path)
    again = predicted_bed("similar impulse", "read_restart bed.restart", "run 200\n" + state("again"))
    error = first_error(run(again, tmp_path, check=False))
    assert "granular/cfpm: the contact history of 'predict exact' in the restart file has another size" in error
    first, _, impulse = again.partition("pair_style granular/cfpm predict impulse")
    exact = "pair_style granular/cfpm predict exact\npair_coeff * * " + MIXED["* *"] + "\n"
    lines = impulse.replace("run 200", "", 1).splitlines()
    then = "run 0\npair_style granular/cfpm predict impulse\nrun 200\n" + state("again")
    run(first + exact + "\n".join(lines[2:-1]) + "\n" + then, tmp_path)
    assert np.isfinite(read_dump(tmp_path / "again.dump")[0][1]["fz"]).all()


def test_impulses_want_one_kind_of_law(tmp_path):
    BEDS["given"] = ({**MIXED, "2 2": MIXED["* *"]}, "impulse")
    error = first_error(run(predicted_bed("given", after="run 1"), tmp_path, check=False))
    del BEDS["given"]
    assert "'impulse' has no form for these sub-models: types 1 and 1 are linear, types 1 and 2 are as in Tsu" in error
    assert "expected for all types hooke" in error and "or one of rk2, rk4, verlet, auto" in error


def test_mixes_pairs_of_types_that_are_not_given(tmp_path):
    """As LAMMPS does since 2023 (in 2021 it reads what it has not set), which of one material is that itself."""
    same = MIXED["* *"]
    found = []
    for models in ({"* *": same}, {"1 1": same, "2 2": same}):
        BEDS["given"] = (models, "rk4")
        run(predicted_bed("given", after="run 400\n" + state("last")), tmp_path)
        found.append(vectors(read_dump(tmp_path / "last.dump")[0][1], "x", "y", "z"))
    del BEDS["given"]
    assert np.abs(found[0] - found[1]).max() < 1e-9  # the mean of equal numbers is off by a rounding


def given(models, predict):
    return {
        "pair": f"pair_style granular/cfpm predict {predict}",
        "coefficients": f"pair_coeff * * {models}",
        "integrator": "fix i all nve/cfpm",
    }


PLAIN = "hooke 1e5 50 tangential linear_history 1e5 0.5 0.1"
REFUSED = {
    "exact of any law": (given(PLAIN, "exact"), ["predictor 'exact' has no form for these sub-models", "rk2, rk4"]),
    "trapezoid of Hertz": (
        given("hertz 1e5 0.5 tangential mindlin 1e5 0.5 0.1 damping tsuji", "trapezoid"),
        ["predictor 'trapezoid' has no form for these sub-models"],
    ),
    "rolling by impulses": (
        given(PLAIN + " rolling sds 1e3 1 0.1", "impulse"),
        ["'rolling sds' of types 1 and 1 has no form with 'predict impulse'; expected one of exact, trapezoid, rk2"],
    ),
    "twisting by impulses": (
        given(PLAIN + " twisting marshall", "impulse"),
        ["'twisting marshall' of types 1 and 1 has no form with 'predict impulse'"],
    ),
    "area springs by impulses": (
        given("hertz 1e5 50 tangential mindlin/force 1e5 0.5 0.1", "impulse"),
        ["'tangential mindlin/force' of types 1 and 1 has no form with 'predict impulse'; expected one of rk2, rk4, v"],
    ),
    "exact area springs": (
        given("hertz 1e5 0.5 tangential mindlin_rescale 1e5 0.5 0.1 damping tsuji", "exact"),
        ["'tangential mindlin_rescale' of types 1 and 1 has no form with 'predict exact'; expected one of rk2, rk4, v"],
    ),
    "twisting of a negative stiffness": (
        given(PLAIN + " twisting sds -1 0 0", "rk4"),
        ["Illegal SDS twisting model" if IS_NEWER else "'a coefficient out of its"],
    ),
    "unknown rolling": (given(PLAIN + " rolling cdt 1", "rk4"), ["ERROR"]),
    "exact dmt": (
        given("dmt 1e5 50 0.3 10 tangential linear_nohistory 0.5 0.1", "exact"),
        ["'dmt' of types 1 and 1 has no form with 'predict exact'; expected one of rk2, rk4, verlet, auto"],
    ),
    "dmt by impulses": (
        given("dmt 1e5 50 0.3 10 tangential linear_nohistory 0.5 0.1", "impulse"),
        ["'dmt' of types 1 and 1 has no form with 'predict impulse'; expected one of rk2, rk4, verlet, auto"],
    ),
    "dmt that pushes": (
        given("dmt 1e5 50 0.3 -10 tangential linear_nohistory 0.5 0.1", "rk2"),
        ["'a coefficient out of its range' of types 1 and 1 has no predicted form"],
    ),
    "jkr": (given("jkr 1e5 50 0.3 10 tangential linear_nohistory 0.5 0.1", "rk2"), ["'jkr' of types 1 and 1"]),
    "negative": (
        given("hooke 1e5 -50 tangential linear_nohistory 0.5 0.1", "rk4"),
        ["Illegal Hooke normal model" if IS_NEWER else "'a coefficient out of its"],  # of the host or here
    ),
    "restitution": (
        given("hooke 1e5 1.5 tangential linear_nohistory 0.5 0.1 damping tsuji", "rk4"),
        ["'a coefficient out of its range' of types 1 and 1 has no predicted form"],
    ),
    "impulse of any law": (
        given(PLAIN, "impulse"),
        ["'impulse' has no form for these sub-models: types 1 and 1 are none of these; expected for all types hooke"],
    ),
    "split": (given(PLAIN, "rk4 split 0.5"), ["'split' goes with 'predict impulse' only"]),
    "integrator": ({**given(PLAIN, "rk4"), "integrator": "fix i all nve/sphere"}, ["fix nve/sphere (id i)"]),
}


@pytest.mark.parametrize("case", REFUSED)
def test_is_refused(tmp_path, case):
    changes, fragments = REFUSED[case]
    error = first_error(small(tmp_path, options=(), check=False, **{**GRANULAR, **changes}))
    for fragment in fragments:
        assert fragment in error, error


def test_cutoff(tmp_path):
    """It makes the host's ghosts more, and nothing else."""
    found = []
    for cutoff in ("", " cutoff 0.02"):
        BEDS["given"] = ({"* *": MIXED["* *"] + cutoff}, "rk4")
        text = predicted_bed("given", after="run 400\n" + state("last"))
        text = text.replace(f"granular {MIXED['* *']} cutoff 0.02", f"granular {MIXED['* *']}")
        output = run(text, tmp_path).stdout
        found.append(vectors(read_dump(tmp_path / "last.dump")[0][1], "x", "y", "z"))
        reach = float(re.search(r"ghost atom cutoff = (\S+)", output)[1])
        assert (reach > 0.02) == bool(cutoff)
    del BEDS["given"]
    assert np.abs(found[0] - found[1]).max() < 1e-9


def test_coefficients_given_again(tmp_path):
    """What rolling friction needed of the history before is not there any more when it is given without."""
    first = f"pair_coeff * * {PLAIN} rolling sds 1e3 1 0.1 twisting marshall"
    changes = given(PLAIN, "rk4")
    forces = "\nwrite_dump all custom forces.dump id fx fy fz tqx tqy tqz modify format float %.17g"
    move = {"run": "velocity all ramp vy -0.1 0.1 x -0.02 0.02 units box\nrun 20" + forces}
    small(tmp_path, options=(), **{**changes, **move})
    expected = (tmp_path / "forces.dump").read_text()
    changes["coefficients"] = first + "\n" + changes["coefficients"]
    small(tmp_path, options=(), **{**changes, **move})
    assert expected == (tmp_path / "forces.dump").read_text()
