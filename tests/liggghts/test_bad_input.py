# SPDX-License-Identifier: GPL-2.0-or-later
"""Every wrong input stops with one error line that names the command, the argument and what was expected.

No crash, no hang, no message lost in a pipe, on one and on two ranks. Valid combinations that look similar run.
"""

import pytest
from harness.liggghts import run
from small_deck import (
    DECK,
    INSERTION,
    MODEL,
    PAIR,
    PAIR_VALUES,
    PLANE,
    STOCK_INTEGRATOR,
    STOCK_WALL,
    TEMPLATE,
    TYPE_VALUES,
    WALL,
    assert_refused,
    attempt,
    property_lines,
    write,
)


# --- arguments of both commands ---------------------------------------------------------------------------------------

SETTINGS = "expected one of absolute_damping, "
HERTZ = "expected one of rk2, rk4, impulse, verlet"

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
    "predictor": (f"{MODEL} predict euler", "", ["unknown predictor 'euler'", "expected one of exact, ", ", verlet"]),
    "predictor_of_linear_laws": (
        "model hertz predict trapezoid",
        "",
        ["'trapezoid' has no form for model 'hertz'", "expected one of exact, rk2, rk4, impulse, verlet"],
    ),
    "implicit_predictor": ("model hertz/stiffness", "predict trapezoid", ["'trapezoid' has no form", HERTZ]),
    "predictor_value": (f"{MODEL} predict", "", ["missing value after 'predict'", "exact", ", verlet"]),
    "predictor_last": (MODEL, "limitForce on predict", ["missing value after 'predict'", "exact", ", verlet"]),
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


@pytest.mark.parametrize("command", ["pair", "wall"])
@pytest.mark.parametrize("case", ["no_arguments", "predictor", "setting", "viscous"])
def test_arguments_on_two_ranks(tmp_path, case, command):
    models, settings, fragments = ARGUMENTS[case]
    process = attempt(tmp_path, 2, with_arguments(command, models, settings))
    assert_refused(process, ["gran/cfpm", *fragments])


# --- impulses ---------------------------------------------------------------------------------------------------------

# of the pair style, which its walls follow: predictor and options, what the message says
IMPULSE = {
    "split_of_forces": ("exact split 0.5", "'split' goes with 'predict impulse' only"),
    "onset_of_instants": ("none onset on", "'onset' goes with predicted contacts, not with 'predict verlet'"),
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


def test_wall_made_before_impulses(tmp_path):
    """Its history has no room for them; given again it has."""
    pair = f"{PAIR}{MODEL} predict impulse\npair_coeff * *"
    process = attempt(tmp_path, 1, {"run": f"run 2\n{pair}\nrun 2"})
    assert_refused(process, ["fix wall/gran/cfpm: its contact history was made without 'predict impulse'", "unfix"])
    run(write(run=f"run 2\nunfix floor\n{pair}\n{DECK['wall']}\nrun 2"), tmp_path)


def test_wall_given_twice(tmp_path):
    """The host would crash."""
    process = attempt(tmp_path, 1, {"run": DECK["wall"] + "\nrun 2"})
    fragments = ["fix wall/gran/cfpm (id floor): there is a fix with this id", "expected 'unfix floor' first"]
    assert_refused(process, fragments)


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
    assert_refused(run(tmp_path / "in.absent", tmp_path, np=ranks, check=False, timeout=20), ["in.absent"])


# --- companions -------------------------------------------------------------------------------------------------------

MULTISPHERE = """fix clump all particletemplate/multisphere 15485863 atom_type 1 density constant 800 &
  nspheres 2 ntry 100000 spheres 0 0 0 0.02 0.02 0 0 0.02 type 1
fix mix all particledistribution/discrete 49979687 1 clump 1.0
region top block -0.5 0.5 -0.5 0.5 0.5 0.9 units box
"""
ATOMIC = {"style": "atom_style atomic", "particles": "create_atoms 1 single 0 0 0.3 units box\nmass * 1"}
INSTANT = "would integrate step-mean forces as forces of one instant"
NOT_BESIDE = ["(id other)", INSTANT, "expected fix nve/cfpm"]
BODIES = ["(id other): moves bodies of several particles, which have no predicted form", "expected single particles"]

COMPANIONS = {
    "no_integrator": ({"integrator": ""}, ["pair_style gran/cfpm:", "expected 'fix ID group nve/cfpm'"]),
    "integrator_removed": ({"run": "run 1\nunfix integrate\nrun 1"}, ["expected 'fix ID group nve/cfpm'"]),
    "only_nve_sphere": (
        {"integrator": STOCK_INTEGRATOR},
        ["fix nve/sphere (id integrate)", INSTANT, "expected fix nve/cfpm"],
    ),
    "nve_sphere": ({"extra": "fix other all nve/sphere"}, ["fix nve/sphere", *NOT_BESIDE]),
    "nve": ({"extra": "fix other two nve"}, ["fix nve ", *NOT_BESIDE]),
    "rigid": ({"extra": "fix other two rigid single"}, ["fix rigid", *BODIES]),
    "rigid_disjoint": (
        {"integrator": "fix integrate one nve/cfpm", "extra": "fix other two rigid single"},
        ["fix rigid", *BODIES],
    ),
    "multisphere": ({"extra": MULTISPHERE + INSERTION + "fix other all multisphere"}, ["fix multisphere", *BODIES]),
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
        ["fix nve/cfpm", "unknown argument 'xyz'", "expected 'fix ID group nve/cfpm' with nothing or energy yes|no"],
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
    run(write(**VALID[case]), tmp_path, timeout=20)


@pytest.mark.parametrize("case", ["move", "predict_none", "predictors_differ", "insertion"])
def test_valid_on_two_ranks(tmp_path, case):
    run(write(**VALID[case]), tmp_path, np=2, timeout=20)
