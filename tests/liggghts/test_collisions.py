# SPDX-License-Identifier: GPL-2.0-or-later
"""Single collisions through the host against the reference scheme (tests/core/reference_scheme.cpp), step by step.

One deck holds all collisions of harness/collisions.py, where the tolerance is derived; the floor is a primitive wall,
the others are meshes. The host finds the contacts, keeps their history and moves the particles; the reference does all
that with code of its own.
"""

from dataclasses import replace
from functools import lru_cache
from math import log, pi, sqrt

import numpy as np
import pytest
from harness.collisions import CASES, DT, GRAVITY, MOVING, SPEED, STEPS, TILTED, TOLERANCE
from harness.collisions import by_case, spheres_of, write_spheres
from harness.liggghts import run
from harness.spheres import (
    PREDICTORS,
    Law,
    box,
    digits,
    dump,
    largest_error,
    read_motion,
    reduced_mass,
    reference,
    write_stl,
)

WALL_TYPE = 2


# Contact laws: what the deck says, and what that means for two bodies.
FRICTION = {(1, 1): 0.4, (1, 2): 0.3, (2, 2): 0.5}


def types_of(bodies):
    types = [s.type for s in spheres_of(bodies)] + [WALL_TYPE]
    return tuple(sorted(types[:2]))


def matrix(of):
    return digits([of[i, j] for i, j in ((1, 1), (1, 2), (1, 2), (2, 2))])


FRICTION_DECK = f"fix mu all property/global coefficientFriction peratomtypepair 2 {matrix(FRICTION)}\n"


class Stiffness:
    """model hooke/stiffness with absolute_damping on: the values of the deck; off: gamma times reduced mass."""

    KN = {(1, 1): 1.2e5, (1, 2): 0.9e5, (2, 2): 0.8e5}
    KT = {(1, 1): 4.0e4, (1, 2): 3.5e4, (2, 2): 3.0e4}

    def __init__(self, absolute):
        self.absolute = absolute
        unit = 1.0 if absolute else 40.0  # kg/s, or 1/s
        self.gn = {pair: g * unit for pair, g in {(1, 1): 12.0, (1, 2): 9.0, (2, 2): 7.0}.items()}
        self.gt = {pair: g * unit for pair, g in {(1, 1): 5.0, (1, 2): 4.0, (2, 2): 3.0}.items()}
        self.settings = "absolute_damping " + ("on" if absolute else "off")
        self.model = "hooke/stiffness"

    @property
    def deck(self):
        return self.properties("_abs" if self.absolute else "")

    def properties(self, suffix):
        return (
            f"fix kn all property/global kn peratomtypepair 2 {matrix(self.KN)}\n"
            f"fix kt all property/global kt peratomtypepair 2 {matrix(self.KT)}\n"
            f"fix gn all property/global gamman{suffix} peratomtypepair 2 {matrix(self.gn)}\n"
            f"fix gt all property/global gammat{suffix} peratomtypepair 2 {matrix(self.gt)}\n"
        )

    def law(self, bodies):
        pair = types_of(bodies)
        unit = 1.0 if self.absolute else reduced_mass(*spheres_of(bodies))
        return Law(self.KN[pair], unit * self.gn[pair], self.KT[pair], unit * self.gt[pair], FRICTION[pair])


class Hooke:
    """model hooke, from the formulas of the host's manual page gran_model_hooke."""

    Y = {1: 5.0e7, 2: 8.0e7}
    NU = {1: 0.3, 2: 0.25}
    E = {(1, 1): 0.6, (1, 2): 0.8, (2, 2): 0.7}
    V = 1.0
    model = "hooke"
    settings = ""
    deck = (
        f"fix Y all property/global youngsModulus peratomtype {Y[1]} {Y[2]}\n"
        f"fix nu all property/global poissonsRatio peratomtype {NU[1]} {NU[2]}\n"
        f"fix e all property/global coefficientRestitution peratomtypepair 2 {matrix(E)}\n"
        f"fix V all property/global characteristicVelocity scalar {V}\n"
    )

    def law(self, bodies):
        i, j = types_of(bodies)
        spheres = spheres_of(bodies)
        per_radius = sum(1.0 / s.radius for s in spheres)  # a wall is flat
        root, m = sqrt(1.0 / per_radius), reduced_mass(*spheres)
        y = 1.0 / ((1.0 - self.NU[i] ** 2) / self.Y[i] + (1.0 - self.NU[j] ** 2) / self.Y[j])
        kn = 16.0 / 15.0 * root * y * (15.0 * m * self.V**2 / (16.0 * root * y)) ** 0.2
        gamma = sqrt(4.0 * m * kn / (1.0 + (pi / log(self.E[i, j])) ** 2))
        return Law(kn, gamma, kn, gamma, FRICTION[i, j])


class Hertz(Hooke):
    """model hertz, from the formulas of the host's manual page gran_model_hertz."""

    model = "hertz"

    def law(self, bodies):
        i, j = types_of(bodies)
        spheres = spheres_of(bodies)
        root, m = sqrt(1.0 / sum(1.0 / s.radius for s in spheres)), reduced_mass(*spheres)
        y = 1.0 / ((1.0 - self.NU[i] ** 2) / self.Y[i] + (1.0 - self.NU[j] ** 2) / self.Y[j])
        g = 1.0 / sum(2.0 * (2.0 - self.NU[t]) * (1.0 + self.NU[t]) / self.Y[t] for t in (i, j))
        log_e = log(self.E[i, j])
        damping = -2.0 * sqrt(5.0 / 6.0) * log_e / sqrt(log_e**2 + pi**2)
        kn, ks = 4.0 / 3.0 * y * root, 8.0 * g * root
        return Law(kn, damping * sqrt(1.5 * kn * m), ks, damping * sqrt(ks * m), FRICTION[i, j], "hertz")


class HertzStiffness(Stiffness):
    """model hertz/stiffness: all that of hooke/stiffness, per area of contact, (R d)^(1/2)."""

    KN = {(1, 1): 3.5e7, (1, 2): 3.0e7, (2, 2): 2.5e7}
    KT = {(1, 1): 1.2e7, (1, 2): 1.1e7, (2, 2): 0.9e7}

    def __init__(self):
        super().__init__(absolute=False)
        self.gn = {pair: g * 1.0e4 for pair, g in {(1, 1): 12.0, (1, 2): 9.0, (2, 2): 7.0}.items()}
        self.gt = {pair: g * 1.0e4 for pair, g in {(1, 1): 5.0, (1, 2): 4.0, (2, 2): 3.0}.items()}
        self.model = "hertz/stiffness"
        self.settings = ""

    def law(self, bodies):
        pair = types_of(bodies)
        spheres = spheres_of(bodies)
        root, m = sqrt(1.0 / sum(1.0 / s.radius for s in spheres)), reduced_mass(*spheres)
        values = (self.KN[pair], m * self.gn[pair], self.KT[pair], m * self.gt[pair])
        return Law(*(root * value for value in values), FRICTION[pair], self.model)


MODELS = {
    "stiffness_abs": Stiffness(True),
    "stiffness": Stiffness(False),
    "hooke": Hooke(),
    "hertz": Hertz(),
    "hertz_stiffness": HertzStiffness(),
}
PREDICTIONS = [(p, m) for m in MODELS for p in (("rk2", "rk4") if "hertz" in m else PREDICTORS)]
TANGENTIAL = ("history", "no_history", "off")


def deck(predictor, model, tangential, settings="limitForce on", steps=(STEPS,), output=""):
    law = f"model {model.model} tangential {tangential}"
    settings = f"{model.settings} {settings}"
    return (
        box(DT)
        + model.deck
        + FRICTION_DECK
        + f"""
pair_style gran/cfpm {law} predict {predictor} {settings}
pair_coeff * *
fix tilted all mesh/surface file tilted.stl type {WALL_TYPE}
fix moving all mesh/surface file moving.stl type {WALL_TYPE}
fix move all move/mesh mesh moving linear {digits(MOVING.v)}
fix floor all wall/gran/cfpm {law} primitive type {WALL_TYPE} zplane 0.0 {settings}
fix meshes all wall/gran/cfpm {law} mesh n_meshes 2 meshes tilted moving {settings}
fix gravity all gravity {np.linalg.norm(GRAVITY)} vector {digits(GRAVITY)}
fix integrate all nve/cfpm
"""
        + output
        + dump()
        + "".join(f"run {n}\n" for n in steps)
    )


def write_scene(folder):
    write_spheres(folder)
    for name, wall, sides in (
        ("tilted", TILTED, ((0.08, 0.0, -0.06), (0.0, 0.1, 0.0))),
        ("moving", MOVING, ((0.1, 0.0, 0.0), (0.0, 0.08, 0.06))),
    ):
        x, a, b = np.asarray(wall.x), np.asarray(sides[0]), np.asarray(sides[1])
        write_stl(folder / f"{name}.stl", (x - a - b, x + a - b, x + a + b, x - a + b))


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    @lru_cache(maxsize=None)
    def motion(predictor, model, tangential, limit_force="on"):
        folder = tmp_path_factory.mktemp("collisions")
        write_scene(folder)
        run(deck(predictor, MODELS[model], tangential, f"limitForce {limit_force}"), folder)
        steps, all_motion = read_motion(folder / "motion.dump")
        assert list(steps) == list(range(STEPS + 1))
        return by_case(all_motion)

    return motion


def expected_law(model, tangential, bodies):
    law = MODELS[model].law(bodies)
    if tangential != "history":
        law.ks = 0.0
    if tangential == "off":
        law.hs = law.mu = 0.0
    return law


def expected_motion(predictor, model, tangential, case, tension=False):
    bodies = CASES[case]
    law = replace(expected_law(model, tangential, bodies), tension=tension)
    return reference(predictor, law, bodies, [(DT, STEPS)], GRAVITY)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("tangential", TANGENTIAL)
@pytest.mark.parametrize("predictor, model", PREDICTIONS)
def test_host_moves_as_the_reference(host, predictor, model, tangential, case):
    expected = expected_motion(predictor, model, tangential, case)
    error = largest_error(host(predictor, model, tangential)[case], expected, CASES[case], SPEED)
    print(f"largest error {error:.1e}")
    assert error <= TOLERANCE


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("predictor, model", PREDICTIONS)
def test_without_limit_force_contacts_pull_until_the_bodies_part(host, predictor, model, case):
    """As the host's law does, and its coefficient of restitution counts on that."""
    expected = expected_motion(predictor, model, "history", case, tension=True)
    motion = host(predictor, model, "history", "off")[case]
    assert largest_error(motion, expected, CASES[case], SPEED) <= TOLERANCE


def test_limit_force_matters(host):
    for model in MODELS:
        with_limit, without = (host("rk2", model, "history", word) for word in ("on", "off"))
        assert any(largest_error(without[case], with_limit[case], CASES[case], SPEED) > 1e-3 for case in CASES), model


@pytest.mark.parametrize("case", CASES)
def test_cases_are_what_they_are_called(case):
    """Every case rebounds; those that slide do so because of Coulomb's limit, and friction matters to all with slip."""
    bodies = CASES[case]
    law = expected_law("stiffness_abs", "history", bodies)
    end = expected_motion("exact", "stiffness_abs", "history", case)[-1, 0]

    def end_with(**change):
        return reference("exact", replace(law, **change), bodies, [(DT, STEPS)], GRAVITY)[-1, 0]

    assert np.linalg.norm(end_with(kn=1e-9, hn=0.0)[3:6] - end[3:6]) > 0.5 * SPEED
    frictionless = np.linalg.norm(end_with(mu=0.0)[3:6] - end[3:6])
    rough = np.linalg.norm(end_with(mu=10.0)[3:6] - end[3:6])
    if "sliding" in case or case == "oblique_unequal":
        assert rough > 0.01 * SPEED
    if "head_on" not in case:
        assert frictionless > 0.01 * SPEED
    if "sticking" in case:  # the limit matters only at the end, where the normal force vanishes
        assert rough < 0.1 * frictionless


def run_text(folder, *arguments, **options):
    """Text of the motion of one run."""
    folder.mkdir()
    write_scene(folder)
    run(deck(*arguments, **options), folder)
    return (folder / "motion.dump").read_text()


@pytest.mark.parametrize("tangential", TANGENTIAL)
@pytest.mark.parametrize("predictor, model", [("exact", "stiffness_abs"), ("rk2", "hertz"), ("rk4", "hertz_stiffness")])
def test_host_loop_does_the_same(tmp_path, host, predictor, model, tangential):
    """The pressure of every step is asked for to make the pair style take the host's loop instead of its own."""
    write_scene(tmp_path)
    pressure = "compute motion all temp\ncompute p all pressure motion\nthermo_style custom step c_p\nthermo 1\n"
    run(deck(predictor, MODELS[model], tangential, output=pressure), tmp_path)
    motion = by_case(read_motion(tmp_path / "motion.dump")[1])
    for case in CASES:
        assert (motion[case] == host(predictor, model, tangential)[case]).all(), case


def test_without_tangential_damping(tmp_path):
    write_scene(tmp_path)
    run(deck("exact", MODELS["stiffness_abs"], "history", "tangential_damping off limitForce on"), tmp_path)
    motion = by_case(read_motion(tmp_path / "motion.dump")[1])
    for case, bodies in CASES.items():
        law = replace(expected_law("stiffness_abs", "history", bodies), hs=0.0)
        expected = reference("exact", law, bodies, [(DT, STEPS)], GRAVITY)
        assert largest_error(motion[case], expected, bodies, SPEED) <= TOLERANCE, case


@pytest.mark.parametrize("tangential", ["history", "no_history"])
def test_runs_in_pieces(tmp_path, tangential):
    """A new "run" in the middle of the contacts evaluates the forces again and must find the same ones.

    Not for the moving mesh: the host's fix move/mesh sets the velocity of its mesh to zero in every setup.
    """
    write_scene(tmp_path)
    run(deck("exact", MODELS["stiffness_abs"], tangential, steps=(9, 4, 5, STEPS - 18)), tmp_path)
    steps, motion = read_motion(tmp_path / "motion.dump")
    assert list(steps) == list(range(STEPS + 1))
    for case, bodies in CASES.items():
        if case == "moving_mesh":
            continue
        expected = expected_motion("exact", "stiffness_abs", tangential, case)
        assert largest_error(by_case(motion)[case], expected, bodies, SPEED) <= TOLERANCE, case
