# SPDX-License-Identifier: GPL-2.0-or-later
"""Every wrong input stops with one error line that names the command, the argument and what was expected.

No crash, no hang, no message lost in a pipe, on one and on two ranks. Valid combinations that look similar run,
and the report on the time step is right.
"""

import math
import re
from itertools import product

import pytest
from liggghts import run
from spheres import write_stl

QUICK = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}  # no grace period for the other rank after an error

PAIR_VALUES = {
    "kn": 1e5,
    "kt": 3e4,
    "gamman": 1.0,
    "gammat": 1.0,
    "gamman_abs": 1.0,
    "gammat_abs": 1.0,
    "coefficientFriction": 0.3,
    "coefficientRestitution": 0.5,
}
TYPE_VALUES = {"youngsModulus": 1e7, "poissonsRatio": 0.3}
VELOCITY = 1.0


def property_lines(without=""):
    lines = [f"{name} peratomtypepair 2 " + " ".join([str(value)] * 4) for name, value in PAIR_VALUES.items()]
    lines += [f"{name} peratomtype {value} {value}" for name, value in TYPE_VALUES.items()]
    lines += [f"characteristicVelocity scalar {VELOCITY}"]
    names = [line.split()[0] for line in lines]
    return "\n".join(f"fix {n} all property/global {line}" for n, line in zip(names, lines) if n != without)


MODEL = "model hooke/stiffness tangential history"
PAIR = "pair_style gran/cfpm "
WALL = "fix floor all wall/gran/cfpm "
PLANE = " primitive type 1 zplane 0.0"
STOCK_WALL = f"fix floor all wall/gran {MODEL}{PLANE}"
STOCK_INTEGRATOR = "fix integrate all nve/sphere"

DECK = {
    "units": "units si",
    "style": "atom_style granular",
    "map": "atom_modify map array sort 0 0",
    "boundary": "boundary f f f",
    "newton": "newton off",
    "communicate": "communicate single vel yes",
    "region": "region box block -1 1 -1 1 -1 1 units box",
    "box": "create_box 2 box",
    "neighbor": "neighbor 0.01 bin\nneigh_modify delay 0",
    "timestep": "timestep 1e-5",
    "properties": property_lines(),
    "pair": PAIR + MODEL,
    "coefficients": "pair_coeff * *",
    "particles": """create_atoms 1 single -0.3 0 0.3 units box
create_atoms 2 single 0.3 0 0.5 units box
create_atoms 2 single 0.3 0 0.65 units box
set type 1 diameter 0.05 density 800
set type 2 diameter 0.1 density 1000""",
    "groups": "group one type 1\ngroup two type 2",
    "wall": WALL + MODEL + PLANE,
    "integrator": "fix integrate all nve/cfpm",
    "extra": "",
    "run": "run 2",
}


def write(**changes):
    assert set(changes) <= set(DECK)
    return "\n".join({**DECK, **changes}.values()) + "\n"


def attempt(folder, ranks, changes):
    return run(write(**changes), folder, np=ranks, check=False, env=QUICK, timeout=20)


def assert_refused(process, fragments):
    output = process.stdout
    assert process.returncode > 0, output[-2000:]
    assert "Signal:" not in output and "exited on signal" not in output, output[-2000:]
    errors = [line for line in output.splitlines() if line.startswith("ERROR")]
    assert errors, "no error message:\n" + output[-2000:]
    for fragment in fragments:
        assert fragment in errors[0], errors[0]


# --- arguments of both commands ---------------------------------------------------------------------------------------

SETTINGS = "expected one of absolute_damping, "
HERTZ = "expected one of rk2, rk4, none"

# what is wrong: models, settings, what the message says
ARGUMENTS = {
    "no_arguments": ("", "", ["expected 'model' first", "hooke, hooke/stiffness"]),
    "no_model": ("tangential history", "", ["expected 'model' first", "hooke, hooke/stiffness", "'tangential'"]),
    "only_predict": ("predict exact", "", ["expected 'model' first", "hooke, hooke/stiffness"]),
    "only_settings": ("limitForce on", "", ["expected 'model' first", "'limitForce'"]),
    "model_value": ("model", "", ["missing value after 'model'", "expected one of hooke, hooke/stiffness"]),
    "model_xyz": ("model xyz", "", ["unknown model 'xyz'", "hooke, hooke/stiffness, hertz, hertz/stiffness"]),
    "model_unpredicted": ("model luding", "", ["unknown model 'luding'", "expected one of hooke, hooke/stiffness"]),
    "model_internal": ("model hooke/cfpm", "", ["unknown model 'hooke/cfpm'", "expected one of hooke"]),
    "tangential": ("model hooke tangential xyz", "", ["unknown tangential 'xyz'", "off, no_history, history"]),
    "tangential_value": ("model hooke tangential", "", ["missing value after 'tangential'", "no_history, history"]),
    "cohesion": (f"{MODEL} cohesion xyz", "", ["unknown cohesion 'xyz'", "expected one of off", "sjkr"]),
    "cohesion_value": (f"{MODEL} cohesion", "", ["missing value after 'cohesion'", "sjkr"]),
    "rolling": (f"{MODEL} rolling_friction xyz", "", ["unknown rolling_friction 'xyz'", "epsd2"]),
    "rolling_value": (f"{MODEL} rolling_friction", "", ["missing value after 'rolling_friction'", "epsd2"]),
    "surface": (f"{MODEL} surface xyz", "", ["unknown surface 'xyz'", "expected one of default"]),
    "surface_value": (f"{MODEL} surface", "", ["missing value after 'surface'", "expected one of default"]),
    "order": ("model hooke cohesion off tangential history", "", ["keyword 'tangential' out of place", "the order is"]),
    "order_settings": ("model hooke", "limitForce on tangential history", ["'tangential' out of place"]),
    "model_twice": ("model hooke model hooke", "", ["keyword 'model' out of place", "the order is"]),
    "predictor": (f"{MODEL} predict euler", "", ["unknown predictor 'euler'", "expected one of exact, ", ", none"]),
    "predictor_of_linear_laws": (
        "model hertz predict trapezoid",
        "",
        ["'trapezoid' has no form for model 'hertz'", "expected one of exact, rk2, rk4, impulse, none"],
    ),
    "impulse_of_other_damping": (
        "model hertz/stiffness predict impulse",
        "",
        ["'impulse' has no form for model 'hertz/stiffness'", HERTZ],
    ),
    "implicit_predictor": ("model hertz/stiffness", "predict trapezoid", ["'trapezoid' has no form", HERTZ]),
    "predictor_value": (f"{MODEL} predict", "", ["missing value after 'predict'", "exact", ", none"]),
    "predictor_last": (MODEL, "limitForce on predict", ["missing value after 'predict'", "exact", ", none"]),
    "predictor_twice": (f"{MODEL} predict exact", "predict rk2", ["'predict' given twice"]),
    "setting": (MODEL, "xyz on", ["unknown setting 'xyz'", SETTINGS]),
    "setting_number": (MODEL, "5", ["unknown setting '5'", SETTINGS]),
    "setting_of_other_model": (MODEL, "ktToKnUser on", ["unknown setting 'ktToKnUser'", SETTINGS]),
    "setting_behind": (MODEL, "limitForce on xyz on", ["unknown setting 'xyz'", SETTINGS]),
    "setting_value": (MODEL, "limitForce", ["missing value after setting 'limitForce'", "on or off"]),
    "setting_bad_value": (MODEL, "limitForce maybe", ["'limitForce' is 'maybe'", "expected on or off"]),
    "setting_two_values": (MODEL, "limitForce on off", ["unknown setting 'off'", SETTINGS]),
}

UNPREDICTED = {
    "viscous": "model hooke",
    "heating_normal_hooke": "model hooke",
    "heating_normal_hertz": "model hertz",
    "heating_tracking": "model hooke",
    "heating_tangential_history": MODEL,
    "computeElasticPotential": MODEL,
    "computeDissipatedEnergy": MODEL,
    "disableNormalWhenBonded": "model hooke",
    "disableTangentialWhenBonded": "model hooke tangential no_history",
}
for setting, models in UNPREDICTED.items():
    ARGUMENTS[setting] = (models, f"{setting} on", [f"'{setting}' has no predicted form", "'predict none'"])


def with_arguments(command, models, settings):
    if command == "pair":
        return {"pair": f"{PAIR}{models} {settings}"}
    return {"wall": f"{WALL}{models}{PLANE if settings else ''} {settings}"}


@pytest.mark.parametrize("command", ["pair", "wall"])
@pytest.mark.parametrize("case", ARGUMENTS)
def test_arguments(tmp_path, case, command):
    models, settings, fragments = ARGUMENTS[case]
    named = ["pair_style gran/cfpm:"] if command == "pair" else ["ix wall/gran/cfpm (id floor)"]
    process = attempt(tmp_path, 1, with_arguments(command, models, settings))
    assert_refused(process, named + fragments)


# of the pair style, which its walls follow: predictor and options, what the message says
IMPULSE = {
    "split_of_forces": ("exact split 0.5", "'split' goes with 'predict impulse' only"),
    "onset_of_forces": ("exact onset on", "'onset' goes with 'predict impulse' only"),
    "split_value": ("impulse split", "missing value after 'split'; expected a number from 0 to 1"),
    "split_word": ("impulse split half", "split is 'half'; expected a number from 0 to 1"),
    "split_range": ("impulse split 1.5", "split is '1.5'; expected a number from 0 to 1"),
    "onset_value": ("impulse onset 1", "onset is '1'; expected on or off"),
    "onset_twice": ("impulse onset on onset off", "'onset' given twice"),
}


@pytest.mark.parametrize("case", IMPULSE)
def test_options_of_impulses(tmp_path, case):
    options, message = IMPULSE[case]
    process = attempt(tmp_path, 1, {"pair": f"{PAIR}{MODEL} predict {options}"})
    assert_refused(process, ["pair_style gran/cfpm:", message])


def test_options_of_impulses_at_a_wall(tmp_path):
    process = attempt(tmp_path, 1, {"wall": f"{WALL}{MODEL} predict impulse onset on{PLANE}"})
    assert_refused(process, ["fix wall/gran/cfpm (id floor): 'onset' belongs to the pair style, which walls follow"])


DRIVEN = "fix integrate one nve/cfpm\nfix drive two move linear 0 0 600"
MOVING_MESH = f"""fix plate all mesh/surface file plate.stl type 1
fix drive all move/mesh mesh plate linear 0 0 300
{WALL}{MODEL} mesh n_meshes 1 meshes plate"""

# contacts that begin inside a step are sought no farther than 10 % of a radius, at planes than half the skin
TOO_FAST = {
    "pairs": ({}, "contact_distance_factor"),
    "driven": ({"wall": "", "integrator": DRIVEN}, "contact_distance_factor"),
    "mesh": ({"wall": MOVING_MESH}, ", a mesh by 0.12; contacts"),
    "planes": ({"neighbor": "neighbor 0.001 bin\nneigh_modify delay 0"}, "larger skin of 'neighbor'"),
}


@pytest.mark.parametrize("case", TOO_FAST)
def test_moves_too_far_for_onset(tmp_path, case):
    changes, expected = TOO_FAST[case]
    speed = {"pairs": 600, "driven": 0, "mesh": 0, "planes": 100}[case]  # a radius of 25 mm and a step of 10 us
    write_stl(tmp_path / "plate.stl", [(-0.9, -0.9, -0.5), (0.9, -0.9, -0.5), (0.9, 0.9, -0.5), (-0.9, 0.9, -0.5)])
    start = {"pair": f"{PAIR}{MODEL} predict impulse", "run": f"velocity one set 0 0 {speed} units box\nrun 3"}
    process = attempt(tmp_path, 1, {**start, **changes})
    assert_refused(process, ["fix nve/cfpm: particle ", " of its radius in a step", expected])


@pytest.mark.parametrize("late", ["delay 10", "delay 0 every 2"])
def test_late_lists_for_onset(tmp_path, late):
    changes = {"pair": f"{PAIR}{MODEL} predict impulse", "neighbor": f"neighbor 0.01 bin\nneigh_modify {late}"}
    process = attempt(tmp_path, 1, changes)
    assert_refused(process, ["pair_style gran/cfpm: ", "expected 'neigh_modify delay 0 every 1', or 'onset off'"])
    run(write(**{**changes, "pair": f"{PAIR}{MODEL} predict impulse onset off"}), tmp_path, env=QUICK)


def test_wall_made_before_impulses(tmp_path):
    """Its history has no room for them; given again it has."""
    pair = f"{PAIR}{MODEL} predict impulse\npair_coeff * *"
    process = attempt(tmp_path, 1, {"run": f"run 2\n{pair}\nrun 2"})
    assert_refused(process, ["fix wall/gran/cfpm: its contact history was made without 'predict impulse'", "unfix"])
    run(write(run=f"run 2\nunfix floor\n{pair}\n{DECK['wall']}\nrun 2"), tmp_path, env=QUICK)


def test_wall_given_twice(tmp_path):
    """The host would crash."""
    process = attempt(tmp_path, 1, {"run": DECK["wall"] + "\nrun 2"})
    assert_refused(process, ["fix wall/gran/cfpm (id floor): there is a fix with this id; expected 'unfix floor' first"])


@pytest.mark.parametrize("command", ["pair", "wall"])
@pytest.mark.parametrize("case", ["no_arguments", "predictor", "setting", "viscous"])
def test_arguments_on_two_ranks(tmp_path, case, command):
    models, settings, fragments = ARGUMENTS[case]
    process = attempt(tmp_path, 2, with_arguments(command, models, settings))
    assert_refused(process, ["gran/cfpm", *fragments])


# --- material properties ----------------------------------------------------------------------------------------------

NEEDED = {
    "model hooke/stiffness": ["kn", "kt", "gamman", "gammat"],
    "model hooke/stiffness absolute_damping on": ["kn", "kt", "gamman_abs", "gammat_abs"],
    "model hooke": ["youngsModulus", "poissonsRatio", "coefficientRestitution", "characteristicVelocity"],
    "model hertz": ["youngsModulus", "poissonsRatio", "coefficientRestitution"],
    "model hertz/stiffness": ["kn", "kt", "gamman", "gammat"],
    "model hooke tangential no_history": ["coefficientFriction"],
    "model hooke/stiffness tangential history": ["coefficientFriction"],
}


def wanted_line(name):
    if name in PAIR_VALUES:
        return f"'fix ID all property/global {name} peratomtypepair 2 <4 values>'"
    if name in TYPE_VALUES:
        return f"'fix ID all property/global {name} peratomtype <2 values>'"
    return f"'fix ID all property/global {name} scalar <value>'"


def using(command, arguments):
    """The arguments in that command, while the other one needs other properties, or is not there."""
    if command == "pair":
        return {"pair": PAIR + arguments, "wall": ""}
    models, _, settings = arguments.partition(" absolute")
    other = "model hooke" if "stiffness" in arguments else "model hooke/stiffness"
    return {"pair": PAIR + other, "wall": WALL + models + PLANE + (settings and " absolute" + settings)}


@pytest.mark.parametrize("command", ["pair", "wall"])
@pytest.mark.parametrize("arguments, name", [(a, name) for a, names in NEEDED.items() for name in names])
def test_missing_property(tmp_path, arguments, name, command):
    process = attempt(tmp_path, 1, {"properties": property_lines(without=name), **using(command, arguments)})
    full = "pair_style gran/cfpm:" if command == "pair" else "fix wall/gran/cfpm"
    assert_refused(process, [full, f"missing material property '{name}'", "expected a line " + wanted_line(name)])


BAD_VALUES = {
    "shape": ("kn peratomtype 1 1", ["'kn'", "expected a line " + wanted_line("kn")]),
    "count": ("kn peratomtypepair 1 1e5", ["'kn' has 1 values", "expected a line " + wanted_line("kn")]),
    "stiffness": ("kn peratomtypepair 2 1 1 1 -1", ["'kn' is -1", "expected no negative value"]),
    "damping": ("gamman peratomtypepair 2 -1 1 1 1", ["'gamman' is -1", "expected no negative value"]),
    "friction": ("coefficientFriction peratomtypepair 2 1 -1 -1 1", ["'coefficientFriction' is -1", "expected no neg"]),
}


@pytest.mark.parametrize("case", BAD_VALUES)
def test_bad_property(tmp_path, case):
    line, fragments = BAD_VALUES[case]
    name = line.split()[0]
    process = attempt(tmp_path, 1, {"properties": property_lines(without=name) + f"\nfix k all property/global {line}"})
    assert_refused(process, ["pair_style gran/cfpm:", *fragments])


# --- walls ------------------------------------------------------------------------------------------------------------

MESH_WALL = WALL + MODEL + " mesh "
WALLS = {
    "neither": (WALL + MODEL, ["'mesh' or 'primitive'"]),
    "primitive_alone": (WALL + MODEL + " primitive", ["'type'"]),
    "primitive_type": (WALL + MODEL + " primitive type", ["type"]),
    "primitive_type_3": (WALL + MODEL + " primitive type 3 zplane 0.0", ["1 <= type <= max type"]),
    "primitive_nothing": (WALL + MODEL + " primitive type 1", ["not enough arguments for primitive"]),
    "primitive_unknown": (WALL + MODEL + " primitive type 1 wplane 0.0", ["'wplane'", "expected one of xplane, "]),
    "primitive_position": (WALL + MODEL + " primitive type 1 zplane", ["not enough arguments for primitive"]),
    "cylinder": (WALL + MODEL + " primitive type 1 zcylinder 0.1 0.0", ["not enough arguments for primitive"]),
    "settings_first": (WALL + MODEL + " limitForce on" + PLANE, ["'primitive'", "settings last"]),
    "mesh_alone": (MESH_WALL, ["'n_meshes' and 'meshes'"]),
    "mesh_number": (MESH_WALL + "n_meshes", ["not enough arguments"]),
    "mesh_list": (MESH_WALL + "n_meshes 1", ["'n_meshes' and 'meshes'"]),
    "mesh_ids": (MESH_WALL + "n_meshes 1 meshes", ["not enough arguments"]),
    "mesh_absent": (MESH_WALL + "n_meshes 1 meshes absent", ["could not find fix mesh id"]),
    "mesh_no_mesh": (MESH_WALL + "n_meshes 1 meshes kn", ["not of type mesh"]),
}


@pytest.mark.parametrize("case", WALLS)
def test_wall(tmp_path, case):
    line, fragments = WALLS[case]
    assert_refused(attempt(tmp_path, 1, {"wall": line}), ["ix wall/gran/cfpm (id floor)", *fragments])


@pytest.mark.parametrize("ranks", [1, 2])
def test_absent_mesh_file(tmp_path, ranks):
    wall = "fix mesh all mesh/surface file absent.stl type 1\n" + MESH_WALL + "n_meshes 1 meshes mesh"
    assert_refused(attempt(tmp_path, ranks, {"wall": wall}), ["mesh file absent.stl"])


@pytest.mark.parametrize("ranks", [1, 2])
def test_absent_deck(tmp_path, ranks):
    assert_refused(run(tmp_path / "in.absent", tmp_path, np=ranks, check=False, env=QUICK, timeout=20), ["in.absent"])


# --- companions -------------------------------------------------------------------------------------------------------

TEMPLATE = """fix small all particletemplate/sphere 15485863 atom_type 1 density constant 800 radius constant 0.02
fix large all particletemplate/sphere 32452843 atom_type 2 density constant 1000 radius constant 0.05
fix mix all particledistribution/discrete 49979687 2 small 0.5 large 0.5
region top block -0.5 0.5 -0.5 0.5 0.5 0.9 units box
"""
INSERTION = "fix fill all insert/pack seed 86028157 distributiontemplate mix insert_every once overlapcheck yes &\n"
INSERTION += "  vel constant 0 0 0 region top particles_in_region 8\n"
MULTISPHERE = """fix clump all particletemplate/multisphere 15485863 atom_type 1 density constant 800 &
  nspheres 2 ntry 100000 spheres 0 0 0 0.02 0.02 0 0 0.02 type 1
fix mix all particledistribution/discrete 49979687 1 clump 1.0
region top block -0.5 0.5 -0.5 0.5 0.5 0.9 units box
"""
ATOMIC = {"style": "atom_style atomic", "particles": "create_atoms 1 single 0 0 0.3 units box\nmass * 1"}
INSTANT = "would integrate step-mean forces as forces of one instant"
NOT_BESIDE = ["(id other)", INSTANT, "expected fix nve/cfpm"]

COMPANIONS = {
    "no_integrator": ({"integrator": ""}, ["pair_style gran/cfpm:", "expected 'fix ID group nve/cfpm'"]),
    "integrator_removed": ({"run": "run 1\nunfix integrate\nrun 1"}, ["expected 'fix ID group nve/cfpm'"]),
    "only_nve_sphere": ({"integrator": STOCK_INTEGRATOR}, ["expected 'fix ID group nve/cfpm'", "nve/sphere"]),
    "nve_sphere": ({"extra": "fix other all nve/sphere"}, ["fix nve/sphere", *NOT_BESIDE]),
    "nve": ({"extra": "fix other two nve"}, ["fix nve ", *NOT_BESIDE]),
    "rigid": ({"extra": "fix other two rigid single"}, ["fix rigid", *NOT_BESIDE]),
    "rigid_disjoint": (
        {"integrator": "fix integrate one nve/cfpm", "extra": "fix other two rigid single"},
        ["fix rigid", *NOT_BESIDE],
    ),
    "multisphere": ({"extra": MULTISPHERE + INSERTION + "fix other all multisphere"}, ["fix multisphere", *NOT_BESIDE]),
    "stock_wall": (
        {"extra": STOCK_WALL.replace("floor", "other")},
        ["fix wall/gran (id other)", "not predicted", "expected fix wall/gran/cfpm"],
    ),
    "nve_cfpm_twice": (
        {"extra": "fix other two nve/cfpm"},
        ["fix nve/cfpm (id other)", "fix nve/cfpm (id integrate)", "expected disjoint groups"],
    ),
    "nve_cfpm_twice_before_insertion": (
        {"particles": "", "extra": TEMPLATE + INSERTION + "fix other all nve/cfpm"},
        ["fix nve/cfpm (id other)", "fix nve/cfpm (id integrate)", "expected disjoint groups"],
    ),
    "move_same_group": (
        {"extra": "fix other two move linear 0 0 0.1"},
        ["fix move (id other)", "fix nve/cfpm (id integrate)", "expected disjoint groups"],
    ),
    "dt_reset": (
        {"extra": "fix other all dt/reset 1 1e-7 1e-5 0.01 units box"},
        ["fix dt/reset (id other)", "changes the time step", "cannot be used with pair_style gran/cfpm"],
    ),
    "integrator_beside_stock_pair": (
        {"pair": "pair_style gran " + MODEL, "wall": STOCK_WALL},
        ["fix nve/cfpm", "needs 'pair_style gran/cfpm'", "found pair_style gran"],
    ),
    "wall_beside_stock_pair": (
        {"pair": "pair_style gran " + MODEL, "integrator": STOCK_INTEGRATOR},
        ["fix wall/gran/cfpm", "needs 'pair_style gran/cfpm'", "found pair_style gran"],
    ),
    "wall_without_pair": (
        {"pair": "", "coefficients": "", "integrator": STOCK_INTEGRATOR},
        ["fix wall/gran/cfpm", "needs 'pair_style gran/cfpm'", "found pair_style none"],
    ),
    "model_under_stock_style": (
        {"pair": "pair_style gran model hooke/cfpm", "wall": "", "integrator": STOCK_INTEGRATOR},
        ["this contact model belongs to pair_style gran/cfpm"],
    ),
    "integrator_with_predict_none": (
        {"pair": PAIR + MODEL + " predict none"},
        ["fix nve/cfpm (id integrate)", "'predict none'", "expected fix nve/sphere"],
    ),
    "wall_predicted_pair_not": (
        {
            "pair": PAIR + MODEL + " predict none",
            "wall": DECK["wall"] + " predict exact",
            "integrator": STOCK_INTEGRATOR,
        },
        ["fix wall/gran/cfpm (id floor)", "'predict none'", "use the same for both"],
    ),
    "pair_predicted_wall_not": (
        {"wall": DECK["wall"] + " predict none"},
        ["fix wall/gran/cfpm (id floor)", "'predict none'", "use the same for both"],
    ),
    "wall_setting_when_pair_changes": (
        {
            "pair": PAIR + "model hooke predict none",
            "wall": WALL + "model hooke" + PLANE + " computeElasticPotential on",
            "extra": PAIR + "model hooke predict exact\npair_coeff * *",
        },
        ["wall/gran/cfpm (id floor)", "'computeElasticPotential' has no predicted form"],
    ),
    "respa": ({"extra": "run_style respa 2 2 pair 1"}, ["run_style respa", "expected 'run_style verlet'"]),
    "newton": ({"newton": "newton on"}, ["pair_style gran/cfpm:", "'newton off'"]),
    "atomic_pair": (
        {**ATOMIC, "wall": "", "integrator": ""},
        ["pair_style gran/cfpm:", "no radius", "expected 'atom_style sphere'"],
    ),
    "atomic_wall": ({**ATOMIC, "integrator": ""}, ["wall/gran/cfpm (id floor)", "radius"]),
    "atomic_integrator": (
        {**ATOMIC, "wall": ""},
        ["fix nve/cfpm", "no radius", "expected 'atom_style sphere'"],
    ),
    "point_particle": (
        {"particles": DECK["particles"] + "\nset type 1 diameter 0 density 1"},
        ["fix nve/cfpm", "radius 0", "expected spheres"],
    ),
    "hybrid": (
        {"pair": "pair_style hybrid gran/cfpm " + MODEL, "coefficients": "pair_coeff * * gran/cfpm"},
        ["pair_style gran/cfpm:", "sub-style of pair_style hybrid", "expected 'pair_style gran/cfpm' alone"],
    ),
    "hybrid_overlay": (
        {"pair": "pair_style hybrid/overlay gran/cfpm " + MODEL, "coefficients": "pair_coeff * * gran/cfpm"},
        ["pair_style gran/cfpm:", "sub-style of pair_style hybrid/overlay", "expected 'pair_style gran/cfpm' alone"],
    ),
    "integrator_argument": (
        {"integrator": DECK["integrator"] + " xyz"},
        ["fix nve/cfpm", "unknown argument 'xyz'", "expected only 'fix ID group nve/cfpm'"],
    ),
    "timestep_without_setup": (
        {"run": "run 2\ntimestep 2e-5\nrun 2 pre no"},
        ["fix nve/cfpm", "the time step or the pair style changed", "between runs"],
    ),
    "pair_style_without_setup": (
        {"run": f"run 2\n{PAIR}{MODEL} predict rk4\npair_coeff * *\nrun 2 pre no"},
        ["fix nve/cfpm", "the time step or the pair style changed", "between runs"],
    ),
}
ON_TWO_RANKS = ["multisphere", "nve_cfpm_twice", "stock_wall", "point_particle", "timestep_without_setup", "hybrid"]


@pytest.mark.parametrize("case", COMPANIONS)
def test_companion(tmp_path, case):
    changes, fragments = COMPANIONS[case]
    assert_refused(attempt(tmp_path, 1, changes), fragments)


@pytest.mark.parametrize("case", ON_TWO_RANKS)
def test_companion_on_two_ranks(tmp_path, case):
    changes, fragments = COMPANIONS[case]
    assert_refused(attempt(tmp_path, 2, changes), fragments)


# --- what is allowed --------------------------------------------------------------------------------------------------

ONE = "fix integrate one nve/cfpm"
VALID = {
    "plain": {},
    "move": {"integrator": ONE, "extra": "fix other two move linear 0 0 0.1"},
    "noforce": {"integrator": ONE, "extra": "fix other two nve/noforce"},
    "freeze": {"integrator": ONE, "extra": "fix other two freeze"},
    "freeze_integrated": {"extra": "fix other two freeze"},
    "two_integrators": {"integrator": ONE, "extra": "fix other two nve/cfpm"},
    "predict_none": {
        "pair": PAIR + MODEL + " predict none",
        "wall": STOCK_WALL,
        "integrator": STOCK_INTEGRATOR,
    },
    "predict_none_followed": {"pair": PAIR + MODEL + " predict none", "integrator": STOCK_INTEGRATOR},
    "predictors_differ": {"pair": PAIR + MODEL + " predict rk2", "wall": DECK["wall"] + " predict trapezoid"},
    "hertz": {"pair": PAIR + "model hertz tangential history", "wall": WALL + "model hertz tangential history" + PLANE},
    # the default of the pairs has no form for the wall's law, which then has its own
    "hertz_at_wall": {"wall": WALL + "model hertz tangential history" + PLANE},
    "hertz_without_impact_speed": {
        "pair": PAIR + "model hertz",
        "wall": WALL + "model hertz" + PLANE,
        "properties": property_lines(without="characteristicVelocity"),
    },
    "predict_first": {"pair": PAIR + "predict rk4 " + MODEL},
    "predict_between": {"pair": PAIR + "model hooke predict exact tangential history"},
    "settings": {"pair": PAIR + MODEL + " absolute_damping on tangential_damping off limitForce on"},
    "setting_off": {"pair": PAIR + "model hooke viscous off", "wall": WALL + "model hooke" + PLANE + " viscous off"},
    "unpredicted_setting": {
        "pair": PAIR + MODEL + " predict none computeElasticPotential on",
        "wall": DECK["wall"] + " computeElasticPotential on",
        "integrator": STOCK_INTEGRATOR,
    },
    "pair_after_wall": {"pair": "", "coefficients": "", "extra": PAIR + MODEL + "\npair_coeff * *"},
    "timestep_between_runs": {"run": "run 1\ntimestep 2e-5\nrun 1"},
    "other_predictor_between_runs": {"run": f"run 1\n{PAIR}{MODEL} predict rk4\npair_coeff * *\nrun 1"},
    "insertion": {"particles": "", "extra": TEMPLATE + INSERTION},
}


@pytest.mark.parametrize("case", VALID)
def test_valid(tmp_path, case):
    run(write(**VALID[case]), tmp_path, env=QUICK, timeout=20)


@pytest.mark.parametrize("case", ["move", "predict_none", "predictors_differ", "insertion"])
def test_valid_on_two_ranks(tmp_path, case):
    run(write(**VALID[case]), tmp_path, np=2, env=QUICK, timeout=20)


# --- report on the time step ------------------------------------------------------------------------------------------

NUMBER = r"([-+.\de]+)"
ROW = re.compile(rf"  (\S.*): +tc = {NUMBER} to {NUMBER}, nt = tc/dt = {NUMBER} to {NUMBER}(.*)")


def report(output):
    """Lines of the report as {who: (shortest tc, longest tc, least nt, most nt)}, and what follows the numbers."""
    rows = {}
    remarks = {}
    for who, *numbers, remark in (match.groups() for match in map(ROW.fullmatch, output.splitlines()) if match):
        assert who not in rows, "reported twice: " + who
        rows[who] = tuple(map(float, numbers))
        remarks[who] = remark
    return rows, remarks


def stiffness(model, mass, radius):
    if model == "hooke/stiffness":
        return PAIR_VALUES["kn"]
    if model == "hertz/stiffness":
        return PAIR_VALUES["kn"] * math.sqrt(radius)
    modulus = TYPE_VALUES["youngsModulus"] / (2.0 * (1.0 - TYPE_VALUES["poissonsRatio"] ** 2))
    if model == "hertz":
        return 4.0 / 3.0 * math.sqrt(radius) * modulus
    root = 16.0 / 15.0 * math.sqrt(radius) * modulus
    return root * (mass * VELOCITY**2 / root) ** 0.2


def contact_time(model, mass, radius, speed=VELOCITY):
    if "hertz" in model:  # T = 3.218 (m/k)^(2/5) u^(-1/5)
        return 3.218065 * (mass / stiffness(model, mass, radius)) ** 0.4 * speed**-0.2
    return math.pi * math.sqrt(mass / stiffness(model, mass, radius))


def expected_rows(model, sizes, dt):
    """sizes: {type: [(radius, density), ...]}"""
    bodies = {t: [(r, 4.0 / 3.0 * math.pi * r**3 * density) for r, density in of] for t, of in sizes.items()}
    times = {}
    for i, j in [(1, 1), (1, 2), (2, 2)]:
        times[f"types {i}-{j}"] = [
            contact_time(model, mi * mj / (mi + mj), ri * rj / (ri + rj))
            for (ri, mi), (rj, mj) in product(bodies[i], bodies[j])
        ]
    for i in (1, 2):
        times[f"type {i}-wall floor"] = [contact_time(model, m, r) for r, m in bodies[i]]
    return {
        who: pytest.approx((min(tc), max(tc), min(tc) / dt, max(tc) / dt), rel=1e-3) for who, tc in times.items()
    }


TWO_SIZES = {1: [(0.025, 800.0), (0.05, 800.0)], 2: [(0.04, 1000.0), (0.1, 1000.0)]}
CREATE_TWO_SIZES = "\n".join(
    f"create_atoms {t} single {0.2 * n} {0.4 * t - 0.6} 0.3 units box\n"
    f"set atom {2 * t - 1 + n} diameter {2 * r} density {density}"
    for t, sizes in TWO_SIZES.items()
    for n, (r, density) in enumerate(sizes)
)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("model", ["hooke", "hooke/stiffness", "hertz", "hertz/stiffness"])
def test_report_of_two_types_and_sizes(tmp_path, model, ranks):
    deck = write(
        particles=CREATE_TWO_SIZES,
        pair=f"{PAIR}model {model} tangential history",
        wall=f"{WALL}model {model} tangential history{PLANE}",
    )
    output = run(deck, tmp_path, np=ranks, env=QUICK).stdout
    linear = "gran/cfpm: predict exact, dt = 1e-05; one contact is stable for nt > 1\n"
    hertz = (
        "gran/cfpm: predict rk4, dt = 1e-05; one contact is stable for nt > 2.015; "
        "Hertz: tc of an impact at speed 1, tc ~ speed^(-1/5)\n"
    )
    assert (hertz if "hertz" in model else linear) in output
    assert report(output)[0] == expected_rows(model, TWO_SIZES, 1e-5)
    assert "WARNING: fix nve/cfpm" not in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_report_of_particles_to_come(tmp_path, ranks):
    """A run of no step: nothing is inserted yet."""
    output = run(write(particles="", extra=TEMPLATE + INSERTION, run="run 0"), tmp_path, np=ranks, env=QUICK).stdout
    sizes = {1: [(0.02, 800.0)], 2: [(0.05, 1000.0)]}
    assert report(output)[0] == expected_rows("hooke/stiffness", sizes, 1e-5)


def test_report_without_particles(tmp_path):
    output = run(write(particles=""), tmp_path, env=QUICK).stdout
    assert "no particles yet" in output
    assert report(output)[0] == {}


@pytest.mark.parametrize("integrator", ["fix integrate all nve/cfpm", ONE + "\nfix other two nve/cfpm"])
def test_report_once_in_many_runs(tmp_path, integrator):
    output = run(write(integrator=integrator, run="run 1\nrun 0\nrun 1\nrun 1"), tmp_path, env=QUICK).stdout
    assert output.count("gran/cfpm: predict ") == 1
    assert len(report(output)[0]) == 5


def test_report_is_in_the_log_file(tmp_path):
    output = run(write(), tmp_path, env=QUICK).stdout
    assert report((tmp_path / "log.liggghts").read_text())[0] == report(output)[0] != {}


@pytest.mark.parametrize("predict, nt", [("exact", 6), ("impulse", 3)])
def test_advice(tmp_path, predict, nt):
    """The time step that the shortest contact supports, and the Rayleigh time of its particle."""
    output = run(write(pair=f"{PAIR}{MODEL} predict {predict}"), tmp_path, env=QUICK).stdout
    shortest = min(tc for tc, *_ in report(output)[0].values())
    found = re.search(r"packings come out right up to dt = (\S+), nt = (\S+); Rayleigh time .* (\S+)\n", output)
    assert float(found[1]) == pytest.approx(shortest / nt, rel=1e-3) and float(found[2]) == nt
    young, poisson = TYPE_VALUES["youngsModulus"], TYPE_VALUES["poissonsRatio"]
    shear = young / (2.0 * (1.0 + poisson))
    rayleigh = math.pi * 0.025 * math.sqrt(800.0 / shear) / (0.1631 * poisson + 0.8766)
    assert float(found[3]) == pytest.approx(rayleigh, rel=1e-3)


def test_new_time_step_is_reported(tmp_path):
    output = run(write(run="run 1\ntimestep 2e-5\nrun 1"), tmp_path, env=QUICK).stdout
    assert re.findall(r"gran/cfpm: predict exact, dt = (\S+);", output) == ["1e-05", "2e-05"]


LIMITS = {"exact": 1.0, "rk2": math.pi / 2, "rk4": math.pi / 2, "trapezoid": None, "impulse": None}
SHORTEST = contact_time("hooke/stiffness", 4.0 / 3.0 * math.pi * 0.025**3 * 800.0 / 2.0, 0.0125)


@pytest.mark.parametrize("predictor", LIMITS)
@pytest.mark.parametrize("over", [0.99, 1.01])
def test_warning_of_a_large_step(tmp_path, predictor, over):
    """The time step around the limit of the stiffest contact, two particles of type 1."""
    limit = LIMITS[predictor]
    changes = {"pair": f"{PAIR}{MODEL} predict {predictor}", "timestep": f"timestep {over * SHORTEST / (limit or 0.5)}"}
    output = run(write(**changes), tmp_path, env=QUICK).stdout
    said = "no stability limit on one contact" if limit is None else f"one contact is stable for nt > {limit:.4g}"
    assert re.search(rf"gran/cfpm: predict {predictor}, dt = \S+; {re.escape(said)}\n", output)
    assert ("WARNING: fix nve/cfpm: time step too large" in output) == (limit is not None and over > 1.0)


@pytest.mark.parametrize("over", [0.99, 1.01])
def test_warning_of_a_large_step_for_hertz(tmp_path, over):
    """At the impact speed of the deck; a Hertz contact is stiffer in its middle than its duration says."""
    speed = 4.0
    mass = 4.0 / 3.0 * math.pi * 0.025**3 * 800.0 / 2.0
    middle = math.pi / math.sqrt(1.5 * 1.25**0.2) / 3.218065
    limit = math.pi / 2 / middle
    model = "model hertz tangential history"
    changes = {
        "pair": PAIR + model,
        "wall": WALL + model + PLANE,
        "timestep": f"timestep {over * contact_time('hertz', mass, 0.0125, speed) / limit}",
        "properties": property_lines().replace(f"Velocity scalar {VELOCITY}", f"Velocity scalar {speed}"),
    }
    output = run(write(**changes), tmp_path, env=QUICK).stdout
    assert f"one contact is stable for nt > {limit:.4g}; Hertz: tc of an impact at speed 4," in output
    assert ("WARNING: fix nve/cfpm: time step too large" in output) == (over > 1.0)


def test_hertz_wall_beside_linear_pairs(tmp_path):
    """The row of the wall says which predictor it has and what that can take."""
    output = run(write(wall=WALL + "model hertz" + PLANE), tmp_path, env=QUICK).stdout
    remarks = report(output)[1]
    for who, remark in remarks.items():
        assert remark == ("; predict exact, one contact is stable for nt > 1.283" if "wall" in who else "")
    assert "Hertz: tc of an impact at speed 1," in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_warning_names_the_limit_of_a_wall(tmp_path, ranks):
    """A wall with its own predictor has its own limit; no row of a pair has one here."""
    changes = {"pair": f"{PAIR}{MODEL} predict trapezoid", "wall": DECK["wall"] + " predict rk4"}
    output = run(write(timestep="timestep 0.002", **changes), tmp_path, np=ranks, env=QUICK).stdout
    assert output.count("WARNING: fix nve/cfpm: time step too large") == 1
    remarks = report(output)[1]
    for who, remark in remarks.items():
        assert remark == ("; predict rk4, one contact is stable for nt > 1.571" if "wall" in who else "")
