# SPDX-License-Identifier: GPL-2.0-or-later
"""Momentum and angular momentum of spheres that only touch each other.

Momentum. The two bodies of a contact get f and -f to the last bit (also where each rank computes its own), so the sum
of m v changes by rounding alone.

Angular momentum L = sum (m x cross v + I omega). The step is x' = x + dt v + dt^2 a/2, v' = v + dt a with a = f/m and f
the mean force over the step. Then

  m x' cross v' = m (x + dt v + dt^2 a/2) cross (v + dt a)
                = m [x cross v + dt x cross a + dt^2 v cross a + dt^2/2 a cross v]
                = m x cross v + dt x cross f + dt^2/2 v cross f.

In a contact with normal n the levers are cri and crj with cri + crj = |xi - xj|: the torques -(cri + crj) n cross fs
cancel (xi - xj) cross f, so the sum of dt (x cross f + torque) vanishes and

  L(t + dt) - L(t) = (dt^2/2) sum v cross f   exactly:

the impulse acts at x + dt v/2, while the force was set up at x. For a whole collision that is (dt/2) times the integral
of w cross f, w the relative velocity of the centres: zero head-on, otherwise a drift of first order in dt.
"""

from functools import lru_cache

import numpy as np
import pytest
from harness.cloud import CLOUD, CLOUD_DT, LAW
from harness.liggghts import run
from harness.spheres import (
    FORCES,
    MOTION,
    ROUNDING,
    Sphere,
    box,
    contact_time,
    dump,
    read_motion,
    reduced_mass,
    stiffness_material,
    write_data,
)

STEPS = 120
WINDOW = 60  # steps at the end with a dump each
MODEL = "model hooke/stiffness tangential history"


def law_deck(predict="exact"):
    return stiffness_material({(1, 1): LAW}) + f"""
pair_style gran/cfpm {MODEL} predict {predict} absolute_damping on
pair_coeff * *
fix integrate all nve/cfpm
"""


@pytest.fixture(scope="module", params=[1, 2], ids=["1 rank", "2 ranks"])
def flight(request, tmp_path_factory):
    return fly(tmp_path_factory.mktemp("cloud"), "exact", request.param)


def fly(folder, predict, ranks):
    """Of the cloud: x, v, omega, f, torque, each (snapshots, particles, 3) in long double: the start, then WINDOW."""
    write_data(folder / "spheres.data", CLOUD, low=-2.0, high=2.0, types=1)
    deck = box(CLOUD_DT) + "neigh_modify contact_distance_factor 1.3\n"  # for "predict impulse": soft and fast
    deck += law_deck(predict) + dump(STEPS) + f"run {STEPS}\n"
    run(deck + "undump motion\n" + dump(name="window.dump") + f"run {WINDOW}\n", folder, np=ranks)
    start = read_motion(folder / "motion.dump", MOTION + FORCES)[1][:1]
    window = read_motion(folder / "window.dump", MOTION + FORCES)[1]
    assert len(window) == WINDOW + 1 and window.shape[1] == len(CLOUD)
    return np.split(np.concatenate([start, window]).astype(np.longdouble), 5, axis=2)


def masses():
    m = np.array([s.mass for s in CLOUD], dtype=np.longdouble)
    inertia = 0.4 * m * np.array([s.radius for s in CLOUD], dtype=np.longdouble) ** 2
    return m, inertia


def test_cloud_collides(flight):
    """Ten spheres in contact at any time of the window, and much of the energy lost before it."""
    v, f = flight[1], flight[3]
    touching = np.count_nonzero((f[1:] != 0).any(axis=2), axis=1)
    m = masses()[0]
    energy = [(m[:, None] * v[k] ** 2).sum() for k in (0, 1)]
    assert touching.min() > 10
    assert energy[1] < 0.95 * energy[0]


def test_momentum(flight):
    """Per step and particle v += (dt/m) f rounds the sum (u |v|), the product and the factor (2 u |dv|) and the partial
    sums of f over up to 12 contacts (12 u |dv|, |dv| <= 2 |v| as a force does not more than turn a particle back; a
    longer path through partial sums would need contacts that press from all sides, which a cloud has not): 29 u m |v|.
    """
    assert_momentum(flight[1])


@pytest.mark.parametrize("predict, ranks", [("impulse", 1), ("impulse split 0.5", 2), ("exact onset on", 2)])
def test_momentum_of_impulses(tmp_path, predict, ranks):
    """Those of a contact are opposite too; and so is what shifts the positions, or the centre of mass would stray: it
    goes on with its velocity, up to the rounding of positions, half an ulp and 3 u |dt v| a step."""
    x, v = fly(tmp_path, predict, ranks)[:2]
    assert_momentum(v)
    m = masses()[0]
    times = np.longdouble(CLOUD_DT) * np.array([0, WINDOW])
    centre = [(m[:, None] * x[k]).sum(axis=0) / m.sum() for k in (1, -1)]
    velocity = (m[:, None] * v[1]).sum(axis=0) / m.sum()
    stray = np.abs(centre[1] - centre[0] - times[1] * velocity).max()
    bound = 4 * ROUNDING * WINDOW * (np.abs(x).max() + CLOUD_DT * np.abs(v).max())
    print(f"centre of mass strays by {stray:.2e}, bound {bound:.2e}")
    assert stray <= bound


def assert_momentum(v):
    m = masses()[0]
    size = max((m[:, None] * np.abs(v[k])).sum() for k in range(len(v)))
    momentum = [(m[:, None] * v[k]).sum(axis=0) for k in (0, 1, -1)]
    drift = max(np.abs(p - momentum[0]).max() for p in momentum)
    bound = 29 * ROUNDING * size * (STEPS + WINDOW)
    print(f"momentum {np.abs(momentum[0]).max():.3g}, drift {drift:.2e}, bound {bound:.2e}")
    assert drift <= bound
    assert np.abs(momentum[0]).max() > 1e6 * bound


def test_angular_momentum_of_every_step(flight):
    """The identity above, to rounding. x' and v' round by u |x| + 3 u |dt v| and u |v| + 14 u |dv| as above, the torque
    balance of a contact by the roundings of n, of the levers and of the sums, 20 u |x| |dt f|, the masses of the data
    file by a few u: in all 30 u (m |x| |v| + |x| |dt f| + I |omega|) summed over the particles.
    """
    x, v, omega, f, torque = (a[1:] for a in flight)
    m, inertia = masses()
    dt = np.longdouble(CLOUD_DT)

    def angular(k):
        return (m[:, None] * np.cross(x[k], v[k]) + inertia[:, None] * omega[k]).sum(axis=0)

    def length(a):
        return np.sqrt((a**2).sum(axis=1))

    worst, drift, total = 0.0, 0.0, angular(0)
    for k in range(WINDOW):
        expected = 0.5 * dt**2 * np.cross(v[k], f[k]).sum(axis=0)
        error = np.abs(angular(k + 1) - angular(k) - expected).max()
        size = (m * length(x[k]) * length(v[k]) + length(x[k]) * length(dt * f[k]) + inertia * length(omega[k])).sum()
        worst = max(worst, error / (30 * ROUNDING * size))
        drift = max(drift, np.abs(expected).max() / (30 * ROUNDING * size))
    print(f"L {np.abs(total).max():.3g}; worst step {worst:.3f} of the bound, drift term up to {drift:.2e} of it")
    assert worst <= 1.0
    assert drift > 1e3  # or the identity would say no more than L = const


# Drift over one oblique collision. The same two spheres meet with the same velocities in a row of places; the distance
# at the start differs by fractions of what they approach in a step, so the mean is over the phase of the detection.
RADIUS = 0.01
PHASES = 16
NT = (20, 40, 80, 160, 320)
TC = contact_time(LAW, reduced_mass(Sphere((0, 0, 0), radius=RADIUS), Sphere((0, 0, 0), radius=RADIUS)))


@lru_cache(maxsize=None)
def place(phase, approach):
    """Two spheres that will touch after TC/4 and some fraction of a step. approach: way of the step."""
    impact = 0.6 * RADIUS  # offset of the centres
    distance = np.sqrt((2 * RADIUS) ** 2 - impact**2) + 2.0 * 0.25 * TC + (phase + 0.5) / PHASES * approach
    y = 0.05 * (phase - PHASES / 2)
    a = Sphere((-0.5 * distance, y - 0.5 * impact, 0.0), v=(1.0, 0.0, 0.1), omega=(0.0, 0.0, 50.0), radius=RADIUS)
    b = Sphere((0.5 * distance, y + 0.5 * impact, 0.0), v=(-1.0, 0.0, -0.1), omega=(10.0, 0.0, -20.0), radius=RADIUS)
    return a, b


def spin_and_orbit(state, spheres):
    """L of two spheres about the middle of the place. state: (2, 9)."""
    middle = np.array([0.0, spheres[0].x[1] + spheres[1].x[1], 0.0]) / 2.0
    total = np.zeros(3)
    for s, row in zip(spheres, state):
        x, v, omega = row[:3] - middle, row[3:6], row[6:9]
        total += s.mass * np.cross(x, v) + 0.4 * s.mass * s.radius**2 * omega
    return total


def mean_drift(folder, nt, ranks):
    """Mean over the phases of L(end) - L(start), its components."""
    dt = TC / nt
    places = [place(phase, 2.0 * dt) for phase in range(PHASES)]
    folder.mkdir()
    write_data(folder / "spheres.data", [s for pair in places for s in pair], types=1)
    steps = 3 * nt
    run(box(dt) + law_deck() + dump(steps) + f"run {steps}\n", folder, np=ranks)
    motion = read_motion(folder / "motion.dump")[1]
    drifts = []
    for k, spheres in enumerate(places):
        start, end = motion[0, 2 * k : 2 * k + 2], motion[-1, 2 * k : 2 * k + 2]
        assert end[1, 3] - end[0, 3] > 0.1  # they have parted
        drifts.append(spin_and_orbit(end, spheres) - spin_and_orbit(start, spheres))
    return np.mean(drifts, axis=0)


@pytest.mark.parametrize("ranks", [1, 2])
def test_drift_is_of_first_order(tmp_path, ranks):
    """drift = c dt + O(dt^2) with c = (1/2) integral of w cross f: halving dt halves it.

    The mean over phases leaves relative corrections of the order of dt/tc = 1/nt (the ends of the contact are resolved
    to a step); a least-squares slope over log2 of dt weighs the coarsest ratio, 1 + O(1/20), with 2/10.
    """
    drifts = np.array([mean_drift(tmp_path / str(nt), nt, ranks) for nt in NT])
    size = np.linalg.norm(drifts, axis=1)
    slopes = np.log2(size[:-1] / size[1:])
    fit = np.polyfit(np.log2(1.0 / np.array(NT)), np.log2(size), 1)[0]
    initial = np.linalg.norm(spin_and_orbit(np.array([[*s.x, *s.v, *s.omega] for s in place(0, 0.0)]), place(0, 0.0)))
    print(f"drift/L {size / initial}, slopes {slopes}, fit {fit:.4f}")
    for slope, nt in zip(slopes, NT):
        assert abs(slope - 1.0) <= 2.0 / nt
    assert abs(fit - 1.0) <= 1.0 / NT[0]
