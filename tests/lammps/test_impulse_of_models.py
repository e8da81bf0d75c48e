# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse with Hertz' law and with the sub-models of pair_style granular: restitution, oblique impacts, beds.

Restitutions of Hertz contacts: with the damping of tsuji it has a closed form, see tests/core/test_hertz.cpp; with
damping that grows with the area of contact it depends on the speed and is integrated, see harness/impacts.py.
"""

from math import atan, exp, pi, sqrt

import numpy as np
import pytest
from harness.impacts import LENGTH, PAIR_MASS, RADIUS, RATE, SPEED, TC, linear_restitution, viscoelastic_restitution
from harness.lammps import STOCK, run
from harness.spheres import Sphere, read_motion, write_data
from normal_impacts import ROUNDING, head, motion, restitutions_of


def of_area(alpha, mass, radius, limit):
    """hertz Kn ... of bodies with this reduced mass and radius."""
    kn, gamma = RATE**2 * mass / sqrt(radius), alpha * RATE / LENGTH / sqrt(radius)
    return f"hertz {kn!r} NULL {gamma!r} NULL 0.3 0 {limit}"


PAIR = (PAIR_MASS, RADIUS / 2)
WALL = (2.0 * PAIR_MASS, RADIUS)


def restitution_of_tsuji(alpha, tension):
    w = sqrt(5.0 - alpha * alpha)
    end = -0.5 * pi if tension else atan((2.0 * alpha - 5.0 / alpha) / (2.0 * w))
    return exp(-alpha / w * (0.5 * pi - end))


# of both, and what the series and the tables leave of it: see viscoelastic_motion.h, tests/liggghts/test_impulse.py
BY_SERIES = 5e-6
BY_TABLE = 1e-6


def check(found, expected, tolerance):
    for nt, restitution in found.items():
        error = np.abs(restitution.T - expected).max(axis=0)
        print(f"nt = {nt:.2f}: e = {restitution.mean(axis=1)}, exact {expected}, off {error}")
        assert np.all(error <= tolerance)


@pytest.mark.parametrize("limit", ["", "limit_damping"])
@pytest.mark.parametrize("alpha", [0.0085, 0.1, 0.5, 1.0, 1.95])  # restitutions of 0.99 to 0.1, with limit to 0.22
def test_hertz_at_any_step(tmp_path, alpha, limit):
    pair = f"pair_style gran/cfpm {of_area(alpha, *PAIR, limit)} predict impulse\npair_coeff * *"
    found = restitutions_of(tmp_path, pair, of_area(alpha, *WALL, limit))
    check(found, viscoelastic_restitution(alpha, not limit) * np.ones(4), BY_SERIES)


@pytest.mark.parametrize("alpha", [0.5])
def test_hertz_at_any_speed(tmp_path, alpha):
    """Pairs that meet faster are damped more: alpha goes as the fifth root of the speed."""
    dt, speeds = TC, SPEED * np.geomspace(0.01, 30.0, 40)
    spheres = []
    for k, speed in enumerate(speeds):
        x, y = 0.06 * (k % 7) - 0.2, 0.06 * (k // 7) - 0.2
        for side in (-1, 1):
            spheres.append(Sphere((x + side * (RADIUS + 1e-6), y, 0.0), v=(-0.5 * side * speed, 0, 0), radius=RADIUS))
    write_data(tmp_path / "spheres.data", spheres, low=-0.3, high=0.3, types=1)
    deck = head(dt, skin=0.02) + f"pair_style gran/cfpm {of_area(alpha, *PAIR, '')} predict impulse\npair_coeff * *\n"
    run(deck + "fix i all nve/cfpm\n" + motion(12) + "run 12\n", tmp_path)
    v = read_motion(tmp_path / "motion.dump")[1][-1, :, 3].reshape(-1, 2)
    expected = [viscoelastic_restitution(alpha * (speed / SPEED) ** 0.2, True) for speed in speeds]
    assert np.abs((v[:, 1] - v[:, 0]) / speeds - expected).max() <= BY_SERIES
    assert max(expected) - min(expected) > 0.4


TSUJI = np.polyval([4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728], 0.5)


def stiffness(mass, radius):
    """Of Hertz contacts that last TC undamped at SPEED."""
    return RATE**2 * mass / sqrt(radius)


def hertz_of_tsuji(mass, radius):
    kn = stiffness(mass, radius)
    return f"hertz {kn!r} 0.5 tangential mindlin {kn!r} 0.5 0.3 damping tsuji"


def viscoelastic(mass, radius):
    kn, gamma = stiffness(mass, radius), 0.5 * RATE / LENGTH / sqrt(radius)
    return f"hertz {kn!r} {gamma!r} tangential mindlin {kn!r} 0.5 0.3 limit_damping"


MODELS = {  # sub-models of bodies with this reduced mass and radius, restitution, tolerance
    "velocity": (
        lambda mass, _: f"hooke 2.3e6 {2 * 0.3 * sqrt(2.3e6 * mass)!r} tangential linear_history 8e5 0.5 0.3 "
        "damping velocity",
        linear_restitution(0.3, True),
        ROUNDING,
    ),
    "mass_velocity": (
        lambda mass, _: f"hooke 2.3e6 {2 * 0.1 * sqrt(2.3e6 / mass)!r} tangential linear_nohistory 0.5 0.3 "
        "damping mass_velocity limit_damping",
        linear_restitution(0.1),
        ROUNDING,
    ),
    "hooke, tsuji": (
        lambda *_: "hooke 2.3e6 0.5 tangential linear_history 8e5 0.5 0.3 damping tsuji rolling none",
        linear_restitution(TSUJI / 2, True),
        ROUNDING,
    ),
    "hertz, tsuji": (hertz_of_tsuji, restitution_of_tsuji(TSUJI, True), BY_TABLE),
    "hertz, undamped": (
        lambda *body: hertz_of_tsuji(*body).replace("0.5 tangential", "0 tangential").replace("tsuji", "velocity"),
        1.0,
        BY_TABLE,
    ),
    "viscoelastic": (viscoelastic, viscoelastic_restitution(0.5, False), BY_SERIES),
}


@pytest.mark.parametrize("name", MODELS)
def test_granular_at_any_step(tmp_path, name):
    """Pairs, and the walls beside them."""
    models, expected, tolerance = MODELS[name]
    pair = f"pair_style granular/cfpm predict impulse\npair_coeff * * {models(*PAIR)}"
    found = restitutions_of(tmp_path, pair, f"granular {models(*WALL)}", nts=(20, 3, 1, 1 / 3))
    check(found, expected * np.ones(4), tolerance)


@pytest.mark.parametrize("law", ["gran", "granular", "viscoelastic"])
def test_oblique(tmp_path, law):
    """Pairs at 6 to 76 degrees, that slide, stick and turn, against the host's own styles at small steps, whose error
    is of first order, without the tangential dashpot, whose share of the spring is another there. The tangential
    stiffness of a part of the contact is that of its mean overlap: with Tsuji's damping the error was at most 0.005 of
    the impact speed ("./cfpm validate oblique")."""
    models = {"granular": "hertz, tsuji", "viscoelastic": "viscoelastic"}
    coefficients = MODELS[models[law]][0](*PAIR).replace("0.5 0.3", "0 0.3") if law in models else ""
    words = of_area(0.5, *PAIR, "limit_damping").replace("hertz ", "")
    slips = np.linspace(0.1, 4.0, 8)
    spheres = []
    for k, slip in enumerate(slips):
        for side in (-1, 1):
            v = (-0.5 * side * SPEED, 0.5 * side * slip, 0.0)
            spheres.append(Sphere((side * (RADIUS + 1e-7), 0.05 * k - 0.2, 0.0), v=v, radius=RADIUS))
    write_data(tmp_path / "spheres.data", spheres, low=-0.3, high=0.3, types=1)

    def after(style, integrator, dt, program=None):
        steps = round(2.0 * TC / dt)
        text = f"{head(dt, skin=0.02)}\npair_style {style}\npair_coeff * * {coefficients}\n"
        text += f"fix i all {integrator}\n{motion(steps)}run {steps}\n"
        run(text, tmp_path, **({"program": program} if program else {}))
        v = read_motion(tmp_path / "motion.dump")[1][-1]
        return np.column_stack([v[:, 3:5], RADIUS * v[:, 8]])

    stock, cfpm = {
        "gran": (f"gran/hertz/history {words}", f"gran/cfpm hertz {words}"),
    }.get(law, ("granular", "granular/cfpm"))
    coarse, fine = (after(stock, "nve/sphere", TC / n, STOCK) for n in (2500, 5000))
    speeds = np.repeat(np.hypot(SPEED, slips), 2)[:, None]
    assert np.all(np.abs(fine - coarse) < 0.001 * speeds)
    allowed = 0.005 * speeds + np.abs(fine - coarse)
    for nt in (10, 3, 1):
        error = np.abs(after(f"{cfpm} predict impulse", "nve/cfpm", TC / nt) - fine)
        print(f"nt = {nt}: off by {(error / speeds).max(axis=0)} of the speeds")
        assert np.all(error <= allowed)
    assert np.abs(fine[:, 2]).max() > 0.1, "nothing has begun to turn"
