# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere at rest on the floor.

At rest v = 0 and the mean force over the step is the weight: (f + f*)/2 = m g. With overlap d the force now is k d; the
prediction leaves gravity out (it knows the isolated contact only) and so sees the sphere spring back: from (d, 0) it
comes to (A d, C d), A and C the first column of the predictor's map, and predicts f* = k A d + h C d, or 0 where that
is negative (Eq. 36). So

  d = (m g/k) 2/(1 + A + (h/k) C),  at most 2 m g/k,

a fixed point of the step to the last digit, off m g/k by a factor that tends to 1 with the step as 1 + zeta theta
(theta = omega dt). The contact is that of inputs/liggghts/in.packing, gamma = 1.
"""

from math import pi, sqrt

import numpy as np
import pytest
from harness.liggghts import run
from harness.prediction_map import scaled_map
from harness.spheres import PREDICTORS, Law, Sphere, box, dump, read_motion, stiffness_material, write_data

G = 9.81
TC = 2.0e-4  # of a pair
RADIUS, DENSITY = 0.025, 800.0
M = Sphere((0.0, 0.0, 0.0), radius=RADIUS, density=DENSITY).mass
K = M / 2.0 * (pi / TC) ** 2
ETA = sqrt(M * K)
KS = K / (2.0 * (1.0 + 0.32))
LAW = Law(K, ETA, KS, ETA * sqrt(KS / K), 0.3)
YOUNG, POISSON = 5e8, 0.3  # of a Hertz contact
STEPS = 100_000
SAMPLES = 20


def factor(predictor, nt):
    """Overlap at rest over m g/k."""
    omega = sqrt(K / M)  # m* = m at a wall
    zeta = ETA / (2.0 * sqrt(M * K))
    first = scaled_map(predictor, omega * TC / nt, zeta)[:, 0]  # A and C/omega; h/k = 2 zeta/omega
    return 2.0 / (1.0 + max(0.0, first[0] + 2.0 * zeta * first[1]))


@pytest.mark.parametrize("nt", [3, 6, 30])
@pytest.mark.parametrize("predictor", PREDICTORS)
def test_stays_at_its_fixed_point(tmp_path, predictor, nt):
    rests(tmp_path, predictor, nt)


def test_clamped_prediction(tmp_path):
    """At nt = 1.5 the prediction has the sphere gone within the step: only the force now carries it."""
    assert factor("exact", 1.5) == 2.0
    rests(tmp_path, "exact", 1.5)


def rests(folder, predictor, nt):
    """Three spheres start at the fixed point, 1 % above and 1 % below.

    Rounding: z = r - d is stored to an ulp of r, 3.5e-18 m, that is 5e-11 of d = 8e-8 m; half an ulp a step, damped at
    the rate of the contact, accumulates to a few ulp: below 1e-9. The other two spheres converge: the slowest mode of
    the step falls by more than 1 % a step at these nt, so nothing is left of 1 % after the first sample.
    """
    overlap = M * G / K * factor(predictor, nt)
    print(f"{predictor}, nt = {nt}: overlap at rest {factor(predictor, nt):.6f} m g/k")
    starts = overlap * np.array([1.0, 1.01, 0.99])
    spheres = [Sphere((0.1 * i, 0.0, RADIUS - d), radius=RADIUS, density=DENSITY) for i, d in enumerate(starts)]
    write_data(folder / "spheres.data", spheres, types=1)
    model = "model hooke/stiffness tangential history"
    deck = box(TC / nt) + stiffness_material({(1, 1): LAW})
    deck += f"""
pair_style gran/cfpm {model} predict {predictor} absolute_damping on limitForce on
pair_coeff * *
fix floor all wall/gran/cfpm {model} primitive type 1 zplane 0.0 absolute_damping on limitForce on
fix gravity all gravity {G} vector 0 0 -1
fix integrate all nve/cfpm
thermo {STEPS}
"""
    run(deck + dump(STEPS // SAMPLES) + f"run {STEPS}\n", folder)
    steps, motion = read_motion(folder / "motion.dump")
    assert steps[-1] == STEPS and len(steps) == SAMPLES + 1
    measured = RADIUS - motion[:, :, 2]
    error = np.abs(measured / overlap - 1.0)
    print(f"largest deviation at the fixed point {error[:, 0].max():.1e}, after convergence {error[1:].max():.1e}")
    assert error[:, 0].max() <= 1e-9
    assert error[1:, 1:].max() <= 1e-9
    assert (motion[:, :, [1]] == 0.0).all() and (motion[:, :, 0] == motion[0, :, 0]).all()  # not sideways at all
    assert (motion[:, :, 6:] == 0.0).all()
    # a velocity is the rest of a balance between f and m g, both rounded: an ulp of g dt, some steps of it
    assert np.abs(motion[1:, :, 5]).max() <= 1e-9 * G * TC / nt


def test_fixed_point_tends_to_the_weight():
    """factor = 1 + zeta theta + O(theta^2): 2/(1 + 1 - 2 zeta theta), as C = -omega theta and h/k = 2 zeta/omega."""
    for predictor in PREDICTORS:
        for nt in (100, 1000):
            theta = pi / sqrt(2.0) / nt
            assert abs(factor(predictor, nt) - 1.0 - 0.5 * theta) <= theta**2


@pytest.mark.parametrize("rolling", ["off", "cdt", "epsd2"])
@pytest.mark.parametrize("nt", [1, 1.5, 3, 6, 30])
@pytest.mark.parametrize("law", ["hooke/stiffness", "hertz"])
def test_impulses_leave_no_velocity(tmp_path, law, nt, rolling):
    """A single sphere that lands on the floor from its touch, and one that rolls out beside it. Taken as free between
    its impulses, a sphere would rest with up to a third of g dt. tc of the Hertz contact is that of its tangent under
    the weight."""
    hertz = 4.0 / 3.0 * YOUNG / (2.0 * (1.0 - POISSON**2)) * sqrt(RADIUS)
    tangent = K if law == "hooke/stiffness" else 1.5 * hertz * (M * G / hertz) ** (1.0 / 3.0)
    tc = pi * sqrt(M / tangent)
    spheres = [Sphere((0.1 * i, 0.0, RADIUS), v=(0.0, 0.0, 0.0), radius=RADIUS, density=DENSITY) for i in range(2)]
    spheres[1].v, spheres[1].omega = (1e-4, 0.0, 0.0), (0.0, 1e-4 / RADIUS if rolling != "off" else 0.0, 0.0)
    rests_on_floor = slice(0, 1) if rolling == "off" else slice(0, 2)  # without rolling friction the other one rolls on
    write_data(tmp_path / "spheres.data", spheres, types=1)
    model = f"model {law} tangential history rolling_friction {rolling}"
    damping = "absolute_damping on" if law == "hooke/stiffness" else ""
    deck = box(tc / nt) + stiffness_material({(1, 1): LAW})
    deck += f"""
fix young all property/global youngsModulus peratomtype {YOUNG}
fix poisson all property/global poissonsRatio peratomtype {POISSON}
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.3
fix mu_r all property/global coefficientRollingFriction peratomtypepair 1 0.2
pair_style gran/cfpm {model} predict impulse {damping}
pair_coeff * *
fix floor all wall/gran/cfpm {model} primitive type 1 zplane 0.0 {damping}
fix gravity all gravity {G} vector 0 0 -1
fix integrate all nve/cfpm
thermo {STEPS}
"""
    run(deck + dump(STEPS) + f"run {STEPS}\n", tmp_path)
    motion = read_motion(tmp_path / "motion.dump")[1][-1, rests_on_floor]
    speed = np.abs(motion[:, 3:6]).max()
    spin = np.abs(motion[:, 6:]).max() * RADIUS
    print(f"{law}, rolling friction {rolling}, nt = {nt}: {speed / (G * tc):.1e} and {spin / (G * tc):.1e} g tc")
    assert (motion[:, 2] < RADIUS).all()
    assert max(speed, spin) <= 1e-9 * G * tc
