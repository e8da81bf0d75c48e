# SPDX-License-Identifier: GPL-2.0-or-later
"""fix nve/cfpm with what else acts on particles: gravity, added forces, freezing, groups, insertion, new time steps."""

import re
from dataclasses import replace

import numpy as np
import pytest
from harness.liggghts import run
from harness.output import read_dump, vectors
from harness.spheres import (
    FORCES,
    MOTION,
    PREDICTORS,
    ROUNDING,
    Law,
    Plane,
    Sphere,
    box,
    dump,
    largest_error,
    read_motion,
    reference,
    stiffness_material,
    write_data,
    write_stl,
)

DT = 1.0e-4
G = 9.81
RADIUS = 0.025
LAW = Law(kn=1.2e5, hn=12.0, ks=4.0e4, hs=5.0, mu=0.3)
MODEL = "model hooke/stiffness tangential history"
FLOOR = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
TOLERANCE = 1.0e-12  # against the reference scheme: see test_collisions.py; the setups are of the same size


def pair_deck(dt=DT, predictor="exact", **options):
    return box(dt, **options) + stiffness_material({(1, 1): LAW}) + f"""
pair_style gran/cfpm {MODEL} predict {predictor} absolute_damping on limitForce on
pair_coeff * *
"""


FLOOR_DECK = f"fix floor all wall/gran/cfpm {MODEL} primitive type 1 zplane 0.0 absolute_damping on limitForce on\n"
GRAVITY_DECK = f"fix gravity all gravity {G} vector 0 0 -1\n"
INTEGRATE = "fix integrate all nve/cfpm\n"


def move(folder, deck, spheres):
    """Runs the deck; the motion (snapshots, particles, 15) with forces."""
    write_data(folder / "spheres.data", spheres, types=1)
    run(deck, folder)
    return read_motion(folder / "motion.dump", MOTION + FORCES)[1]


def parabola(x0, v0, a, t):
    """x and v of uniform acceleration, t (steps,)."""
    t = t[:, None]
    return x0 + t * v0 + t**2 / 2.0 * a, v0 + t * a


def assert_parabola(motion, sphere, a, dt):
    """Every step is exact: x + dt v + dt^2 a/2. Each of n steps rounds v by 5 u |v|max (the sum, and four in dt a)
    and x by 2 u |x|max (the sum and its smaller increment); the errors of v add up in x.
    """
    steps = len(motion) - 1
    x, v = parabola(np.array(sphere.x), np.array(sphere.v), np.array(a), dt * np.arange(steps + 1))
    fastest, farthest = np.abs(v).max(), np.abs(x).max()
    assert np.abs(motion[:, 3:6] - v).max() <= 5 * steps * ROUNDING * fastest
    assert np.abs(motion[:, :3] - x).max() <= steps * ROUNDING * (2 * farthest + 5 * steps * dt * fastest)


def test_free_fall(tmp_path):
    sphere = Sphere((0.1, -0.2, 0.5), v=(0.3, -0.4, 2.0), omega=(1.0, 2.0, 3.0), radius=RADIUS)
    motion = move(tmp_path, pair_deck() + GRAVITY_DECK + INTEGRATE + dump() + "run 2000\n", [sphere])
    assert_parabola(motion[:, 0], sphere, (0.0, 0.0, -G), DT)
    assert (motion[:, 0, 6:9] == (1.0, 2.0, 3.0)).all()


def test_addforce(tmp_path):
    """On a group only, and together with gravity."""
    force = np.array([0.3, -0.2, 0.5])
    spheres = [Sphere((x, 0.0, 0.0), v=(0.0, 0.1, 0.2), radius=RADIUS) for x in (-0.3, 0.3)]
    deck = pair_deck() + GRAVITY_DECK + "group one id 1\nfix push one addforce 0.3 -0.2 0.5\n" + INTEGRATE
    motion = move(tmp_path, deck + dump() + "run 500\n", spheres)
    weight = np.array([0.0, 0.0, -G])
    assert_parabola(motion[:, 0], spheres[0], weight + force / spheres[0].mass, DT)
    assert_parabola(motion[:, 1], spheres[1], weight, DT)


@pytest.mark.parametrize("side", [1, -1], ids=["above", "below"])
@pytest.mark.parametrize("predictor", PREDICTORS)
def test_frozen_spheres(tmp_path, predictor, side):
    """fix freeze: the frozen sphere stays, and counts as infinitely heavy in the reduced masses, as the host has it.

    From above and from below, because the host sorts its particles by place: either may be the first of the pair.
    """
    free = Sphere((0.0, 0.0, 0.2), v=(0.5, 0.0, -1.0 * side), omega=(20.0, 5.0, 0.0), radius=RADIUS)
    frozen = Sphere((0.012, 0.01, 0.2 - 0.0478 * side), radius=RADIUS, held=True)
    deck = pair_deck(predictor=predictor) + "group ice id 2\n" + GRAVITY_DECK + INTEGRATE + "fix freeze ice freeze\n"
    motion = move(tmp_path, deck + dump() + "run 100\n", [free, frozen])
    assert (motion[:, 1, :9] == motion[0, 1, :9]).all()
    expected = reference(predictor, LAW, [free, frozen], [(DT, 100)], (0.0, 0.0, -G))
    assert largest_error(motion[..., :9], expected, [free, frozen], 1.0) <= TOLERANCE
    heavier = replace(free, density=free.density * 2.0)
    other = reference(predictor, LAW, [heavier, frozen], [(DT, 100)], (0.0, 0.0, -G))
    assert largest_error(motion[..., :9], other, [free, frozen], 1.0) > 0.01  # the mass matters


def test_frozen_and_merely_fixed_are_not_the_same(tmp_path):
    """A sphere left out of the integration stands still too, but its own mass counts in the prediction."""
    free = Sphere((0.0, 0.0, 0.2), v=(0.5, 0.0, -1.0), radius=RADIUS)
    other = Sphere((0.012, 0.01, 0.2 - 0.0478), radius=RADIUS)
    deck = pair_deck() + "group free id 1\nfix integrate free nve/cfpm\n"
    motion = move(tmp_path, deck + dump() + "run 100\n", [free, other])
    assert (motion[:, 1, :9] == motion[0, 1, :9]).all()
    held = reference("exact", LAW, [free, replace(other, held=True)], [(DT, 100)])
    error = largest_error(motion[:, :1, :9], held[:, :1], [free], 1.0)
    assert 1e-6 < error < 0.1


def test_group_of_the_integrator(tmp_path):
    """Spheres outside it do not move, though they are pushed."""
    spheres = [
        Sphere((0.0, 0.0, 0.3), v=(0.0, 0.0, -1.0), radius=RADIUS),
        Sphere((0.001, 0.0, 0.3 - 0.0502), v=(0.7, 0.8, 0.9), omega=(1.0, 2.0, 3.0), radius=RADIUS),
        Sphere((0.3, 0.0, 0.3), v=(0.7, 0.8, 0.9), radius=RADIUS),
    ]
    deck = pair_deck() + GRAVITY_DECK + "group free id 1\nfix integrate free nve/cfpm\n"
    motion = move(tmp_path, deck + dump() + "run 60\n", spheres)
    assert (motion[:, 1:, :9] == motion[0, 1:, :9]).all()
    assert np.abs(motion[:, 1, 9:12]).max() > 10.0
    assert motion[-1, 0, 5] > 0.0  # the free one came back


@pytest.mark.parametrize("floor", ["primitive", "mesh"])
def test_bouncing_to_rest(tmp_path, floor):
    """Many bounces, each with a spring of its own, and the rest after them, all of it as the reference.

    A bounce amplifies errors: where between two steps the contact begins changes the velocity after it. What rounding
    can do is measured with the reference itself: a start 1e-15 m higher, 17 roundings of coordinates up to 0.5 m, which
    are 12 a step in the 25 steps of a contact, in quadrature.
    """
    sphere = Sphere((0.1, 0.2, 0.028), v=(0.4, -0.3, 0.0), omega=(10.0, 0.0, 5.0), radius=RADIUS)
    steps = 4000
    write_stl(tmp_path / "floor.stl", [(x, y, 0.0) for x, y in ((-0.5, -0.4), (0.6, -0.4), (0.6, 0.5), (-0.5, 0.5))])
    mesh_deck = f"""
fix mesh all mesh/surface file floor.stl type 1
fix floor all wall/gran/cfpm {MODEL} mesh n_meshes 1 meshes mesh absolute_damping on limitForce on
"""
    deck = pair_deck() + (mesh_deck if floor == "mesh" else FLOOR_DECK) + GRAVITY_DECK + INTEGRATE
    motion = move(tmp_path, deck + dump() + f"run {steps}\n", [sphere])
    expected = reference("exact", LAW, [sphere, FLOOR], [(DT, steps)], (0.0, 0.0, -G))
    contacts = np.flatnonzero(np.diff((motion[:, 0, 2] < RADIUS).astype(int)) > 0)
    assert len(contacts) > 3
    higher = replace(sphere, x=(0.1, 0.2, 0.028 + 1e-15))
    shifted = reference("exact", LAW, [higher, FLOOR], [(DT, steps)], (0.0, 0.0, -G))
    tolerance = largest_error(shifted, expected, [sphere], 0.2)
    error = largest_error(motion[..., :9], expected, [sphere], 0.2)
    print(f"{len(contacts)} contacts, largest error {error:.1e}, tolerance {tolerance:.1e}")
    assert error <= tolerance < 1e-6


@pytest.mark.parametrize("ranks", [1, 2])
def test_insertion_during_a_run(tmp_path, ranks):
    """fix insert/pack adds spheres in flight; those before it keep their momentum but for contacts among all."""
    spheres = [Sphere((x, 0.0, -0.2), v=(0.0, 0.0, 0.4), radius=RADIUS) for x in (-0.3, -0.1, 0.1, 0.3)]
    write_data(tmp_path / "spheres.data", spheres, types=1)
    steps, every, batch = 200, 50, 10
    deck = pair_deck() + f"""
region above block -0.4 0.4 -0.4 0.4 0.1 0.4 units box
fix sphere all particletemplate/sphere 49979693 atom_type 1 density constant 1000 radius constant {RADIUS}
fix spheres all particledistribution/discrete 86028157 1 sphere 1.0
fix fill all insert/pack seed 15485863 distributiontemplate spheres maxattempt 100 insert_every {every} &
    overlapcheck yes all_in yes vel constant 0.1 0.0 -0.5 region above particles_in_region {batch}
{INTEGRATE}
thermo 10
thermo_style custom step atoms
"""
    process = run(deck + dump(every) + f"run {steps}\n", tmp_path, np=ranks)
    counts = dict(re.findall(r"^ +(\d+) +(\d+) *$", process.stdout, re.M))
    assert int(counts["0"]) == 4 and int(counts[str(steps)]) > 4 + batch - 1
    before, last = (vectors(columns, *MOTION) for _, columns in read_dump(tmp_path / "motion.dump")[-2:])
    assert len(last) == int(counts[str(steps)])
    # no sphere of the first ones has met another: those above fall 0.01 m and stay 0.2 m away
    expected = np.array([[*s.x, *s.v] for s in spheres])
    expected[:, :3] += DT * steps * expected[:, 3:]
    assert np.abs(last[:4, :6] - expected).max() <= 2 * steps * ROUNDING
    # nor have the new ones: they fly as inserted
    assert (last[4:, 3:6] == (0.1, 0.0, -0.5)).all()
    flown = last[4 : len(before), :3] - before[4:, :3]
    assert len(flown) >= batch
    assert np.abs(flown - DT * every * np.array([0.1, 0.0, -0.5])).max() <= 2 * every * ROUNDING


def test_time_step_changed_between_runs_without_slip(tmp_path):
    """Head-on at a floor: the new step holds from the first force of the second run."""
    sphere = Sphere((0.1, 0.2, RADIUS + 3e-4), v=(0.0, 0.0, -1.0), radius=RADIUS)
    runs = [(DT, 8), (DT / 2, 16), (3 * DT, 20)]
    deck = pair_deck() + FLOOR_DECK + GRAVITY_DECK + INTEGRATE + dump()
    motion = move(tmp_path, deck + "".join(f"timestep {float(dt)!r}\nrun {n}\n" for dt, n in runs), [sphere])
    expected = reference("exact", LAW, [sphere, FLOOR], runs, (0.0, 0.0, -G))
    assert RADIUS - expected[8, 0, 2] > 1e-4 and RADIUS - expected[24, 0, 2] > 1e-4  # changed in the contact
    assert largest_error(motion[..., :9], expected, [sphere], 1.0) <= TOLERANCE


def test_time_step_changed_between_runs_with_slip(tmp_path):
    """The slip accumulated so far is a length and does not depend on the next step."""
    sphere = Sphere((0.1, 0.2, RADIUS + 3e-4), v=(0.05, 0.0, -1.0), omega=(0.0, 3.0, 0.0), radius=RADIUS)
    runs = [(DT, 8), (DT / 4, 60)]
    deck = pair_deck() + FLOOR_DECK + GRAVITY_DECK + INTEGRATE + dump()
    motion = move(tmp_path, deck + "".join(f"timestep {float(dt)!r}\nrun {n}\n" for dt, n in runs), [sphere])
    expected = reference("exact", LAW, [sphere, FLOOR], runs, (0.0, 0.0, -G))
    error = largest_error(motion[..., :9], expected, [sphere], 1.0)
    print(f"error {error:.2e}")
    assert error <= TOLERANCE
