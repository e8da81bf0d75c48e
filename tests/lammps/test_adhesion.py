# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts that adhere: the normal model dmt of pair_style granular and of its walls.

A Hertz contact of two materials whose bodies a force P = 4 pi gamma R* pulls together while they touch. Coulomb's limit
and those of rolling and twisting count H + P, the spring's force and the pull, whatever the dashpot does. (The host of
29 Sep 2021 takes P for friction from a variable that it has not set, so nothing is compared with it where that counts.)
Beds are in test_granular_predicted.py.
"""

import math
import re

import numpy as np
import pytest
from granular_bed import IS_NEWER
from granular_contacts import (
    DENSITY,
    FRICTION,
    MASS,
    POISSON,
    RADIUS,
    SPEED,
    START,
    TIME,
    TSUJI,
    TWO_SPHERES,
    YOUNG,
    closing_speed,
    integrated,
)
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import read_dump
from test_granular_predicted import velocities as of_two_spheres
from test_granular_walls import HEAD, PAIRS, impact, of_wall
from test_granular_walls import velocities as at_wall

GRAVITY = 9.81
WEIGHT = MASS * GRAVITY
ENERGY = 8.0  # gamma, so that the pull is of the size of the spring's force in these contacts [J/m^2]
INERTIA = 0.4 * MASS * RADIUS**2
METHODS = ("rk2", "rk4", "rk4 onset on")


def pull(bodies, energy=ENERGY):
    return 4 * math.pi * energy * bodies.radius


def spring(bodies, overlap):
    return bodies.hertz(4 / 3 * bodies.e_star, overlap) * overlap


def viscoelastic(bodies, d, u):
    return bodies.hertz(5e5 * bodies.mass, d) * u


def tsuji(bodies, d, u):
    return TSUJI * math.sqrt(bodies.mass * bodies.hertz(4 / 3 * bodies.e_star, d)) * u


# the coefficient behind dmt, the dashpot's force
DAMPING = {"viscoelastic": (5e5, viscoelastic)}
if not IS_NEWER:  # newer hosts refuse it beside adhesion
    DAMPING["tsuji"] = (0.5, tsuji)


def models(damping, friction=FRICTION, tangential="mindlin NULL 0.5"):
    coefficient, _ = DAMPING[damping]
    normal = f"dmt {YOUNG} {coefficient} {POISSON} {ENERGY}"
    return f"{normal} tangential {tangential} {friction} damping {damping}"


def force_of(damping):
    return lambda b, d, u: spring(b, d) - pull(b) + DAMPING[damping][1](b, d, u)


@pytest.mark.parametrize("predict", ["rk2", "rk4"])
@pytest.mark.parametrize("damping", DAMPING)
def test_head_on(tmp_path, damping, predict):
    coarse, fine = of_two_spheres(tmp_path, LAUNCHER, models(damping), f"predict {predict}", (16, 32))
    expected = closing_speed(force_of(damping), TWO_SPHERES) / 2
    without = closing_speed(lambda b, d, u: force_of(damping)(b, d, u) + pull(b), TWO_SPHERES) / 2
    assert abs(fine[0] - expected) <= abs(fine[0] - coarse[0]) < 0.05 * SPEED
    assert abs(without - expected) > 0.1 * SPEED, "the pull does nothing"


@pytest.mark.parametrize("damping", DAMPING)
def test_head_on_at_a_wall(tmp_path, damping):
    wall = f"wall/gran/cfpm granular {models(damping)} zplane 0 NULL predict rk4"
    coarse, fine = (-v[2] for v in at_wall(tmp_path, LAUNCHER, wall, (16, 32)))
    expected = closing_speed(force_of(damping), of_wall(tmp_path))
    assert abs(fine - expected) <= abs(fine - coarse) < 0.05 * SPEED


@pytest.mark.parametrize("predict", ["rk2", "rk4"])
@pytest.mark.parametrize("damping", DAMPING)
def test_slides(tmp_path, damping, predict):
    """A sphere that falls on a wall and slips along it so fast that friction is at its limit all the time: mu (H + P),
    where with the dashpot's force in place of the pull it would be another one."""
    mu, slip = 0.2, 5.0
    bodies = of_wall(tmp_path)

    def slope(state):
        d, u, _ = state
        return np.array([u, -force_of(damping)(bodies, d, u) / MASS, -mu * (spring(bodies, d) + pull(bodies)) / MASS])

    _, _, change = integrated(slope, np.array([START, SPEED, 0.0]), TIME, 20000)
    words = models(damping, mu, "linear_nohistory 0.5")
    wall = f"wall/gran/cfpm granular {words} zplane 0 NULL predict {predict}"
    coarse, fine = (v[1] - slip for v in at_wall(tmp_path, LAUNCHER, wall, (16, 32), slip=slip))
    print(f"{damping}, {predict}: slower by {coarse}, {fine}, expected {change}")
    assert abs(fine - change) <= abs(fine - coarse)
    assert abs(fine - coarse) < 0.05 * abs(change)


@pytest.mark.skipif(not IS_NEWER, reason="the host's friction is of a cohesion that it has not set")
@pytest.mark.parametrize("damping", DAMPING)
@pytest.mark.parametrize("friction", [FRICTION, 0.2])
def test_oblique_as_the_host(tmp_path, damping, friction):
    words = models(damping, friction)
    coarse, fine = of_two_spheres(tmp_path, LAUNCHER, words, "predict rk4", (16, 32), SPEED)
    host = {"style": "granular", "integrator": "nve/sphere"}
    host_coarse, host_fine = of_two_spheres(tmp_path, STOCK, words, "", (1024, 2048), SPEED, **host)
    allowed = np.abs(fine - coarse) + np.abs(host_fine - host_coarse) + (START + SPEED * TIME) / RADIUS * SPEED
    assert np.all(np.abs(fine - host_fine) <= allowed), (fine, host_fine, allowed)


def deeper(bodies, overlap, down, dt):
    """By how much larger the spring's force at rest is in steps dt. A prediction is of the contact alone, without the
    weight: its sphere rises by w = down dt, of which half of the change counts, hn w and, with the stiffness k, k w
    dt/2."""
    stiffness = 1.5 * spring(bodies, overlap) / overlap
    return 0.5 * down * dt * (viscoelastic(bodies, overlap, 1.0) + 0.5 * dt * stiffness)


@pytest.mark.parametrize("predict", METHODS)
@pytest.mark.parametrize("share", [0.98, 1.02])
def test_hangs(tmp_path, predict, share):
    """A sphere under a wall, up to the weight P: below it the spring bears what the pull has left, above it falls.

    It may be off by deeper()."""
    bodies = of_wall(tmp_path)
    down = share * pull(bodies) / MASS
    rest = (max(pull(bodies) - MASS * down, 0.0) / (4 / 3 * bodies.e_star * math.sqrt(RADIUS))) ** (2 / 3)
    time, steps = 0.05, 2000
    wall = f"wall/gran/cfpm granular {models('viscoelastic')} zplane NULL 0"
    start = {"place": (0, 0, max(rest, START) - RADIUS), "towards": (0, 0, 0)}
    pairs, gravity = PAIRS.replace("rk4", predict), f"fix down all gravity {down!r} vector 0 0 -1"
    text = impact(wall, steps, before=gravity, pairs=pairs, **start)
    text = text.replace(repr(TIME / steps), repr(time / steps)).replace("id vx", "id z vx")
    run(text, tmp_path)
    z, vz = (read_dump(tmp_path / f"{steps}.dump")[0][1][c][0] for c in ("z", "vz"))
    if share < 1.0:
        allowed = 1.1 * deeper(bodies, rest, down, time / steps)
        off = abs(spring(bodies, z + RADIUS) - spring(bodies, rest))
        print(f"{predict}: off by {off}, allowed {allowed}, vz {vz}")
        assert off < allowed < 0.2 * spring(bodies, rest) and abs(vz) < 1e-4
    else:
        # as in free fall from where it is let go, but for the time in which it is held by all but a little
        assert z < -2 * RADIUS and vz < -0.5 * down * time


@pytest.mark.parametrize("predict", METHODS)
def test_rolls_slower(tmp_path, predict):
    """On a plane, by the couple R mu (H + P), with H = m g + P: as dv/dt = -mu (g + 2 P/m) / (1 + I/(m R^2)); see
    test_turn_resistance.py and deeper()."""
    mu, stiffness, speed, time, dt = 0.01, 1e4, 0.5, 0.05, 1e-4
    bodies = of_wall(tmp_path)
    presses = WEIGHT + 2 * pull(bodies)
    overlap = ((WEIGHT + pull(bodies)) / (4 / 3 * bodies.e_star * math.sqrt(RADIUS))) ** (2 / 3)
    lever = RADIUS - overlap / 2
    words = f"{models('viscoelastic')} rolling sds {stiffness} 20 {mu}"
    text = f"""{HEAD}
create_atoms 1 single 0 0 {RADIUS - overlap!r} units box
set group all diameter {2 * RADIUS} density {DENSITY}
set atom 1 omega {-speed / lever!r} 0 0
velocity all set 0 {speed} 0 units box
pair_style granular/cfpm predict {predict}
pair_coeff * * {words}
fix wall all wall/gran/cfpm granular {words} zplane 0 NULL
fix gravity all gravity {GRAVITY} vector 0 0 -1
fix integrate all nve/cfpm
timestep {dt}
run {round(time / dt)}
write_dump all custom end.dump id vy omegax modify format float %.17g
"""
    run(re.sub(r"^clear\n", "", text.lstrip()), tmp_path)
    end = read_dump(tmp_path / "end.dump")[0][1]
    slower = mu * presses / MASS / (lever / RADIUS + 0.4 * RADIUS / lever)
    late = mu * presses / stiffness / speed + dt + deeper(bodies, overlap, GRAVITY, dt) / presses * time
    print(f"{predict}: {end['vy'][0]}, expected {speed - slower * time} within {slower * late}")
    assert abs(end["vy"][0] - (speed - slower * time)) <= slower * late
    assert slower * late < 0.1 * slower * time < 0.05
    assert abs(end["vy"][0] + lever * end["omegax"][0]) < 1e-3 * speed, "it slips"
