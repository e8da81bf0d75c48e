# SPDX-License-Identifier: GPL-2.0-or-later
"""Cohesion of the host beside predicted forces.

A pull that grows with the overlap softens the spring: with a linear law it is predicted as a part of it.
"""

from math import ceil, log, pi, sqrt

import numpy as np
import pytest
from harness.liggghts import run
from harness.spheres import Sphere, box, dump, read_motion, write_data

RADIUS, SPEED, E = 0.01, 0.2, 0.9
M = 0.5 * Sphere((0.0, 0.0, 0.0), radius=RADIUS, density=2500.0).mass  # reduced
K = 1.2e4
YOUNG, POISSON = 5e6, 0.3
ETA = 2.0 * -log(E) / sqrt(pi**2 + log(E) ** 2) * sqrt(M * K)
HERTZ = YOUNG / (2.0 * (1.0 - POISSON**2)) * sqrt(RADIUS / 2.0) * 4.0 / 3.0
TC = {"hooke/stiffness": pi * sqrt(M / K), "hertz": 3.218 * (M / HERTZ) ** 0.4 * SPEED**-0.2}
STOCK = None


def collide(folder, law, cohesion, predict, nt, wall=False):
    """Restitutions of 8 head-on collisions that begin at different phases of a step, and what the host said."""
    dt = TC[law] / nt
    spheres = []
    for k in range(8):
        apart = SPEED * dt * (1.0 + k / 8.0)
        spheres += [
            Sphere((side * (RADIUS + apart / 2), 0.1 * k - 0.4, 0), (-side * SPEED / 2, 0, 0), (0, 0, 0), RADIUS, 2500)
            for side in (-1, 1)
        ]
    write_data(folder / "spheres.data", spheres, types=1)
    damping = "absolute_damping on" if law == "hooke/stiffness" else ""
    style = "gran" if predict is STOCK else "gran/cfpm"
    method = "" if predict is STOCK else f"predict {predict}"
    deck = box(dt) + f"""
fix Y all property/global youngsModulus peratomtype {YOUNG}
fix nu all property/global poissonsRatio peratomtype {POISSON}
fix e all property/global coefficientRestitution peratomtypepair 1 {E}
fix kn all property/global kn peratomtypepair 1 {K}
fix kt all property/global kt peratomtypepair 1 {K}
fix gn all property/global gamman_abs peratomtypepair 1 {ETA!r}
fix gt all property/global gammat_abs peratomtypepair 1 {ETA!r}
fix mu all property/global coefficientFriction peratomtypepair 1 0.5
fix ced all property/global cohesionEnergyDensity peratomtypepair 1 1e5
pair_style {style} model {law} tangential history cohesion {cohesion} {method} {damping}
pair_coeff * *
fix integrate all {"nve/sphere" if predict is STOCK else "nve/cfpm"}
"""
    steps = ceil(4.0 * nt) + 4
    process = run(deck + dump(steps) + f"run {steps}\n", folder)
    v = read_motion(folder / "motion.dump")[1][-1, :, 3].reshape(8, 2)
    return (v[:, 1] - v[:, 0]) / SPEED, process.stdout


@pytest.fixture(scope="module")
def right(tmp_path_factory):
    """What the host finds at 400 steps per contact time; at 800 it is the same within 2e-4."""
    pairs = [("hooke/stiffness", "sjkr"), ("hooke/stiffness", "sjkr2"), ("hertz", "sjkr")]
    return {key: collide(tmp_path_factory.mktemp("stock"), *key, STOCK, 400)[0].mean() for key in pairs}


@pytest.mark.parametrize("predict, nt", [*(("impulse", nt) for nt in (1, 3, 6, 20)), ("exact", 20)])
@pytest.mark.parametrize("cohesion", ["sjkr", "sjkr2"])
def test_linear_law(tmp_path, right, cohesion, predict, nt):
    """At its touch the pull has the slope pi R (sjkr) or 2 pi R (sjkr2) times its density, 0.26 and 0.52 of k.
    exact finds contacts late, whatever the law: the mean over the phases is compared."""
    found, output = collide(tmp_path, "hooke/stiffness", cohesion, predict, nt)
    expected = right["hooke/stiffness", cohesion]
    print(f"{cohesion}, {predict}, nt = {nt}: e = {found.mean():.4f} +- {found.std():.4f}, right {expected:.4f}")
    assert "is not predicted" not in output
    assert abs((found if predict == "impulse" else found.mean()) / expected - 1.0).max() <= 0.02


@pytest.mark.parametrize("predict", ["exact", "impulse", "rk4"])
def test_hertz_law_warns(tmp_path, right, predict):
    """Where the pull is not a part of the law it follows the force that acts: right at the nt of the warning."""
    found, output = collide(tmp_path, "hertz", "sjkr", predict, 20)
    expected = right["hertz", "sjkr"]
    print(f"{predict}: e = {found.mean():.4f} +- {found.std():.4f}, right {expected:.4f}")
    assert output.count("this cohesion is not predicted") == 1
    assert abs(found.mean() / expected - 1.0) <= 0.02


@pytest.mark.parametrize("predict", ["exact", "impulse"])
@pytest.mark.parametrize("reduce", ["on", "off"])
def test_friction_counts_the_pull_as_the_host_does(tmp_path, predict, reduce):
    """A sphere that slides on a floor: the host limits friction by the force without the pull, with tangential_reduce
    by what is left. At rest k d = W + c d; so mu times W k/(k - c) or mu W decelerate, W the weight, c = 2 pi R ced at
    a wall, less a half of d/R of it (sjkr), which is 2e-3 here."""
    nt, g, mu = 6, 9.81, 0.1
    mass, k, density = 2.0 * M, 2.0 * K, 1e5
    dt = pi * sqrt(mass / k) / nt
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, RADIUS), (1, 0, 0), (0, 0, 0), RADIUS, 2500)], types=1)
    model = "model hooke/stiffness tangential history cohesion sjkr"
    settings = f"absolute_damping on tangential_reduce {reduce}"
    steps = ceil(0.2 / dt)
    deck = box(dt) + f"""
fix kn all property/global kn peratomtypepair 1 {k}
fix kt all property/global kt peratomtypepair 1 {k}
fix gn all property/global gamman_abs peratomtypepair 1 {0.5 * sqrt(mass * k)!r}
fix gt all property/global gammat_abs peratomtypepair 1 {0.5 * sqrt(mass * k)!r}
fix mu all property/global coefficientFriction peratomtypepair 1 {mu}
fix ced all property/global cohesionEnergyDensity peratomtypepair 1 {density}
pair_style gran/cfpm {model} predict {predict} {settings}
pair_coeff * *
fix floor all wall/gran/cfpm {model} primitive type 1 zplane 0.0 {settings}
fix gravity all gravity {g} vector 0 0 -1
fix integrate all nve/cfpm
"""
    run(deck + dump(steps // 2) + f"run {steps}\n", tmp_path)
    v = read_motion(tmp_path / "motion.dump")[1][:, 0, 3]
    found = (v[1] - v[2]) / (steps // 2 * dt * mu * g)
    pull = 2.0 * pi * RADIUS * density
    expected = 1.0 if reduce == "on" else k / (k - pull)
    print(f"{predict}, tangential_reduce {reduce}: deceleration {found:.4f} mu g, right {expected:.4f}")
    assert abs(found / expected - 1.0) <= 5e-3


def test_stays_in_the_range_of_the_law():
    """What the numbers above rest on: the pull does not overcome the spring."""
    assert np.pi * 2.0 * RADIUS * 1e5 < 0.75 * K
