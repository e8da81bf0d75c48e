# SPDX-License-Identifier: GPL-2.0-or-later
"""The damping coeff_restitution of newer hosts: pairs and spheres at walls part with the restitution that is given.

It is the one of a contact that lasts until the bodies part, as without limit_damping: e = exp(-pi zeta/(1 -
zeta^2)^(1/2)) of hooke, and the same of hertz with 2 zeta/5^(1/2) of the damping of Tsuji in place of zeta.
"""

from math import log, pi, sqrt

import numpy as np
import pytest
from granular_bed import IS_NEWER
from harness.impacts import PAIR_MASS, RADIUS, RATE, STIFFNESS, linear_restitution, touching_rebounds
from normal_impacts import ROUNDING, gaps, restitutions_of
from test_impulse_of_models import BY_TABLE

pytestmark = pytest.mark.skipif(not IS_NEWER, reason="this LAMMPS has no damping coeff_restitution")

GIVEN = (0.9, 0.4)


def zeta_of(e):
    return -log(e) / sqrt(pi**2 + log(e) ** 2)


def models(normal, e, mass, radius):
    """Of bodies with this reduced mass and radius; hertz: of contacts that last TC undamped."""
    if normal == "hooke":
        stiffness, tangential = STIFFNESS, "linear_history 8e5"
    else:
        stiffness = RATE**2 * mass / sqrt(radius)
        tangential = f"mindlin {stiffness!r}"
    return f"{normal} {stiffness!r} {e} tangential {tangential} 0.5 0.3 damping coeff_restitution"


def found(folder, normal, e, predict, nts):
    pair, wall = ((PAIR_MASS, RADIUS / 2), (2 * PAIR_MASS, RADIUS))
    style = f"pair_style granular/cfpm predict {predict}\npair_coeff * * {models(normal, e, *pair)}"
    return restitutions_of(folder, style, f"granular {models(normal, e, *wall)}", nts=nts)


@pytest.mark.parametrize("e", GIVEN)
@pytest.mark.parametrize("normal", ["hooke", "hertz"])
def test_impulse(tmp_path, normal, e):
    tolerance = ROUNDING if normal == "hooke" else BY_TABLE
    for nt, restitution in found(tmp_path, normal, e, "impulse", (20, 3, 1, 1 / 3)).items():
        assert np.abs(restitution - e).max() <= tolerance, nt


@pytest.mark.parametrize("e", GIVEN)
def test_predicted(tmp_path, e):
    """Those of the method, see harness/impacts.py."""
    assert linear_restitution(zeta_of(e), tension=True) == pytest.approx(e, rel=1e-14)
    for nt, restitution in found(tmp_path, "hooke", e, "exact onset on", (20, 3)).items():
        steps = [nt, *3 * [sqrt(2.0) * nt]]  # at a wall the mass is twice as large
        expected = [touching_rebounds(zeta_of(e), n, ahead, tension=True) for n, ahead in zip(steps, gaps())]
        assert np.abs(restitution - expected).max() <= ROUNDING, nt


@pytest.mark.parametrize("predict", ["exact onset on", "rk4 onset on"])
@pytest.mark.parametrize("e", GIVEN)
def test_predicted_hertz(tmp_path, e, predict):
    """Of second order or, as the damping grows with the fourth root of the overlap, less, but at least of first: the
    error at half the step is no larger than the difference to the whole."""
    coarse, fine = found(tmp_path, "hertz", e, predict, (20, 40)).values()
    off = np.sqrt(np.mean((fine - e) ** 2, axis=1))
    assert np.all(off <= np.sqrt(np.mean((fine - coarse) ** 2, axis=1)))
    assert off.max() < 0.01


@pytest.mark.parametrize("e", GIVEN)
@pytest.mark.parametrize("normal", ["hooke", "hertz"])
def test_verlet(tmp_path, normal, e):
    """The contact begins and ends late by a step at most, in which its damping changes the speed by 2 zeta pi/n of n
    steps per contact, of hertz, where it begins with 0, by less; all else is of second order."""
    n = 1000
    (restitution,) = found(tmp_path, normal, e, "verlet", (n,)).values()
    assert np.abs(restitution - e).max() <= 2 * 2 * zeta_of(e) * pi / n + (pi / n) ** 2
