# SPDX-License-Identifier: GPL-2.0-or-later
"""Springs in the tangent plane that follow the area of contact: mindlin/force, mindlin_rescale, mindlin_rescale/force.

A sphere meets a wall obliquely and leaves it again, against its equations of motion: of a contact with the radius a
that slips at the speed s the spring force F is kt a x, where x grows by s, or F itself grows by kt a s; with rescale
what grows, x or F, is also multiplied by a over the a before while a shrinks. Loading alone, pairs and beds are in
test_granular_predicted.py.
"""

import math

import numpy as np
import pytest
from granular_contacts import FRICTION, MASS, RADIUS, SPEED, START, TIME
from harness.lammps import run
from harness.output import read_dump
from test_granular_walls import impact

KN, GAMMA, KT, XT = 1e8, 5e5, 1e8, 0.5
UNTIL = 1.5e-3  # about two thirds of the contact, which is stiffest at about half
INERTIA = 0.4 * MASS * RADIUS**2
SPRINGS = {  # whether it keeps its force, and rescales
    "mindlin": (False, False),
    "mindlin/force": (True, False),
    "mindlin_rescale": (False, True),
    "mindlin_rescale/force": (True, True),
}


def reference(spring, slip, steps=20000):
    """(vy, R wx) of a sphere that falls along -z and slips along y, by the classical Runge-Kutta scheme with steps so
    small that its error is far below the others'."""
    keeps_force, rescales = SPRINGS[spring]

    def slope(state):
        d, u, held, vy, wx = state
        a = math.sqrt(RADIUS * d)
        damping = GAMMA * MASS * a
        lever = RADIUS - d / 2
        s = vy + lever * wx
        force = (held if keeps_force else KT * a * held) + XT * damping * s
        shrinks = u / (2 * d) * held if rescales and u < 0 else 0.0
        growth = (KT * a * s if keeps_force else s) + shrinks
        return np.array([u, -(KN * a * d + damping * u) / MASS, growth, -force / MASS, -lever * force / INERTIA])

    state = np.array([START, SPEED, 0.0, slip, 0.0])
    h = UNTIL / steps
    for _ in range(steps):
        k1 = slope(state)
        k2 = slope(state + h / 2 * k1)
        k3 = slope(state + h / 2 * k2)
        k4 = slope(state + h * k3)
        state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert state[0] > 0.0 > state[1], "the contact has ended, or does not unload yet"
    return np.array([state[3], RADIUS * state[4]])


def found(folder, spring, predict, steps):
    models = f"granular hertz {KN} {GAMMA} tangential {spring} {KT} {XT} {FRICTION} limit_damping"
    deck = impact(f"wall/gran/cfpm {models} zplane 0 NULL predict {predict}", steps, slip=SPEED)
    run(deck.replace(f"timestep {TIME / steps!r}", f"timestep {UNTIL / steps!r}"), folder)
    sphere = read_dump(folder / f"{steps}.dump")[0][1]
    return np.array([sphere["vy"][0], RADIUS * sphere["omegax"][0]])


@pytest.mark.parametrize("predict", ["rk2", "rk4"])
@pytest.mark.parametrize("spring", SPRINGS)
def test_loads_and_unloads(tmp_path, spring, predict):
    """Of first order, as the spring of a contact that is there at the start begins half a step late: the error at a
    step h/2 is no larger than the difference to the step h. And what is left without the term of first order tells
    springs apart."""
    coarse, fine = (found(tmp_path, spring, predict, steps) for steps in (128, 256))
    expected = {name: reference(name, SPEED) for name in SPRINGS}
    error = np.abs(fine - expected[spring])
    left = np.abs(2 * fine - coarse - expected[spring])
    print(f"{spring}, {predict}: off by {np.abs(coarse - expected[spring])}, {error}, without first order {left}")
    assert np.all(error <= np.abs(fine - coarse))
    for other in SPRINGS:
        assert other == spring or np.all(np.abs(expected[other] - expected[spring]) > 10 * left), other
