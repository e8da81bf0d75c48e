# SPDX-License-Identifier: GPL-2.0-or-later
"""Single collisions through the host against the reference scheme (tests/core/reference_scheme.cpp), step by step.

One deck holds all collisions, far apart: pairs of spheres head-on and oblique, with spin, of equal and unequal size;
spheres on a primitive wall, on a mesh wall and on a moving mesh. The host finds the contacts, keeps their history and
moves the particles; the reference does all that with code of its own.

Tolerance. The two differ by the rounding of coordinates up to 0.5 m, delta = 2^-54, in every overlap, some dozen
times a step with random signs. A force error k delta in each of the N = 20 steps of a contact changes the velocity by
N^(1/2) (k delta/m*) (tc/N), relative to the impact speed v = (pi/tc) d_max that is pi N^(-1/2) delta/d_max. With
d_max = 7e-4 m and 12^(1/2) roundings: 2e-13. A Hertz contact at its stiffest is 1.6 times as stiff as Eq. 17 makes
of its duration: 3e-13. 1e-12 is three times that.
"""

from dataclasses import replace
from functools import lru_cache
from math import log, pi, sqrt

import numpy as np
import pytest
from liggghts import run
from spheres import (
    PREDICTORS,
    Law,
    Plane,
    Sphere,
    box,
    digits,
    dump,
    largest_error,
    read_motion,
    reduced_mass,
    reference,
    write_data,
    write_stl,
)

DT = 1.0e-4
STEPS = 100
GRAVITY = (0.0, 0.0, -9.81)
SPEED = 1.0  # of impact, about
TOLERANCE = 1.0e-12
WALL_TYPE = 2

# a tilted wall at rest, and one that moves; their rectangles reach 0.1 m to every side
TILTED = Plane((-0.3, 0.0, 0.1), (0.6, 0.0, 0.8))
MOVING = Plane((-0.3, 0.3, 0.1), (0.0, -0.6, 0.8), (0.05, 0.1, 0.3))
SEAM = (0.8 / 2**0.5, -1.0 / 2**0.5, -0.6 / 2**0.5)  # in the plane of the tilted wall, normal to its diagonal
FLOOR = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def along(a, b):
    return np.asarray(a) + np.asarray(b)


def pair(centre, axis, gap, first, second, offset=(0.0, 0.0, 0.0), va=(0.0, 0.0, 0.0), vb=(0.0, 0.0, 0.0), **spins):
    """Two spheres that approach along axis (unit) with the surfaces gap apart. first, second: keywords of Sphere."""
    a, b = Sphere(centre, **first), Sphere(centre, **second)
    distance = a.radius + b.radius + gap
    along_axis, offset = np.asarray(axis), np.asarray(offset)
    separation = along_axis * sqrt(distance**2 - offset @ offset) + offset  # offset is normal to axis
    a.x = tuple(along(centre, -0.5 * separation))
    b.x = tuple(along(centre, 0.5 * separation))
    a.v, b.v = tuple(along(va, 0.5 * SPEED * along_axis)), tuple(along(vb, -0.5 * SPEED * along_axis))
    a.omega, b.omega = spins.get("wa", a.omega), spins.get("wb", b.omega)
    return [a, b]


def on_wall(wall, gap, shift=(0.0, 0.0, 0.0), slip=(0.0, 0.0, 0.0), omega=(0.0, 0.0, 0.0), **kind):
    """A sphere that approaches a wall. shift, slip: in the plane of the wall."""
    sphere = Sphere((0.0, 0.0, 0.0), omega=omega, **kind)
    n = np.asarray(wall.normal)
    sphere.x = tuple(along(along(wall.x, shift), (sphere.radius + gap) * n))
    sphere.v = tuple(along(along(wall.v, slip), -SPEED * n))
    return [sphere, wall]


SMALL = {"radius": 0.015, "density": 2500.0, "type": 2}
CASES = {
    "head_on": pair((0.1, -0.3, 0.3), (1 / 3, 2 / 3, 2 / 3), 3e-4, {}, {}),
    "head_on_unequal": pair((0.1, -0.2, 0.3), (2 / 3, 1 / 3, -2 / 3), 3e-4, {}, SMALL),
    "touching_at_start": pair((0.1, -0.1, 0.3), (0.6, 0.8, 0.0), -2e-4, {}, SMALL, wa=(3.0, 5.0, -7.0)),
    # a small impact parameter sticks, spin beyond Coulomb's limit slides
    "oblique_sticking": pair((0.1, 0.0, 0.3), (1.0, 0.0, 0.0), 3e-4, {}, {}, offset=(0.0, 0.003, -0.002)),
    "oblique_sliding": pair(
        (0.1, 0.1, 0.3),
        (0.0, 1.0, 0.0),
        3e-4,
        {},
        {},
        offset=(0.02, 0.0, 0.015),
        wa=(60.0, 0.0, -90.0),
        wb=(40.0, 9.0, -80.0),
    ),
    "oblique_unequal": pair(
        (0.1, 0.2, 0.3),
        (0.0, 0.0, 1.0),
        3e-4,
        SMALL,
        {},
        offset=(0.01, -0.005, 0.0),
        wa=(10.0, -70.0, 30.0),
        vb=(0.3, 0.0, 0.1),
    ),
    "floor_head_on": on_wall(FLOOR, 3e-4, shift=(0.1, -0.3, 0.0)),
    "floor_sticking": on_wall(FLOOR, 3e-4, shift=(0.1, -0.2, 0.0), slip=(0.05, 0.02, 0.0), omega=(0.0, 1.0, 2.0)),
    "floor_sliding": on_wall(
        FLOOR, 3e-4, shift=(0.1, 0.0, 0.0), slip=(0.9, -0.6, 0.0), omega=(-50.0, 30.0, 9.0), **SMALL
    ),
    "floor_touching_at_start": on_wall(FLOOR, -2e-4, shift=(0.1, 0.2, 0.0), slip=(0.1, 0.2, 0.0)),
    "mesh_head_on": on_wall(TILTED, 3e-4, shift=(0.04, -0.06, -0.03)),
    "mesh_sticking": on_wall(TILTED, 3e-4, shift=(-0.04, 0.05, 0.03), slip=(0.04, 0.02, -0.03), omega=(5.0, 1.0, 2.0)),
    # rolls over the common edge of the two triangles in the middle of the contact: still one contact
    "mesh_over_seam": on_wall(
        TILTED, 3e-4, shift=1.1e-3 * np.array(SEAM), slip=-0.8 * np.array(SEAM), omega=(5.0, 1.0, 2.0)
    ),
    "moving_mesh": on_wall(
        MOVING, 3e-4, shift=(0.03, -0.04, -0.03), slip=(0.9, 0.16, 0.12), omega=(-50.0, 30.0, 9.0), **SMALL
    ),
}


def spheres_of(bodies):
    return [b for b in bodies if isinstance(b, Sphere)]


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


def deck(predictor, model, tangential, settings="", steps=(STEPS,), output=""):
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
    every = [s for bodies in CASES.values() for s in spheres_of(bodies)]
    write_data(folder / "spheres.data", every, low=-0.5, high=0.5)
    for name, wall, sides in (
        ("tilted", TILTED, ((0.08, 0.0, -0.06), (0.0, 0.1, 0.0))),
        ("moving", MOVING, ((0.1, 0.0, 0.0), (0.0, 0.08, 0.06))),
    ):
        x, a, b = np.asarray(wall.x), np.asarray(sides[0]), np.asarray(sides[1])
        write_stl(folder / f"{name}.stl", (x - a - b, x + a - b, x + a + b, x - a + b))


def by_case(motion):
    """The host's motion, (snapshots, particles, 9), by name of case."""
    result, first = {}, 0
    for name, bodies in CASES.items():
        count = len(spheres_of(bodies))
        result[name] = motion[:, first : first + count]
        first += count
    return result


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    @lru_cache(maxsize=None)
    def motion(predictor, model, tangential):
        folder = tmp_path_factory.mktemp("collisions")
        write_scene(folder)
        run(deck(predictor, MODELS[model], tangential), folder)
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


def expected_motion(predictor, model, tangential, case):
    bodies = CASES[case]
    return reference(predictor, expected_law(model, tangential, bodies), bodies, [(DT, STEPS)], GRAVITY)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("tangential", TANGENTIAL)
@pytest.mark.parametrize("predictor, model", PREDICTIONS)
def test_host_moves_as_the_reference(host, predictor, model, tangential, case):
    expected = expected_motion(predictor, model, tangential, case)
    error = largest_error(host(predictor, model, tangential)[case], expected, CASES[case], SPEED)
    print(f"largest error {error:.1e}")
    assert error <= TOLERANCE


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
        assert rough > 0.05 * SPEED
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


def test_limit_force_changes_nothing(tmp_path):
    """The method never pulls (Eq. 36), whatever the host's setting."""
    on = run_text(tmp_path / "on", "exact", MODELS["stiffness_abs"], "history", "limitForce on")
    off = run_text(tmp_path / "off", "exact", MODELS["stiffness_abs"], "history", "limitForce off")
    assert on == off


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
    run(deck("exact", MODELS["stiffness_abs"], "history", "tangential_damping off"), tmp_path)
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
