# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts with sub-models of granular, of two spheres or of one and a wall.

A contact is compared at a time T at which it still lasts, from a small overlap on, so that neither its begin nor its
end is sampled. The method is of second order or, with damping that grows with the fourth root of the overlap, less, but
at least of first: so the error at a step h/2 is no larger than the difference to the step h.
"""

import math
from dataclasses import dataclass

import numpy as np

RADIUS, DENSITY = 0.025, 800.0
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
START, SPEED, TIME = 1e-6, 0.1, 8e-4  # overlap, closing speed, T [m, m/s, s]
FRICTION = 5.0  # so that the contacts below stick
YOUNG, POISSON = 3e7, 0.3


@dataclass
class Bodies:
    mass: float  # reduced, as the radius
    radius: float
    e_star: float = YOUNG / (2 * (1 - POISSON**2))

    def hertz(self, k, d):
        return k * math.sqrt(self.radius * d)


TWO_SPHERES = Bodies(MASS / 2, RADIUS / 2)

TSUJI = np.polyval([4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728], 0.5)
# sub-models, the predictor, and the normal force of them between bodies b at an overlap d and a closing speed u
CONTACTS = {
    "hooke": (
        f"hooke 1e5 20 tangential linear_history 4e4 0.5 {FRICTION} damping velocity",
        "exact",
        lambda b, d, u: 1e5 * d + 20 * u,
    ),
    "mass": (
        f"hooke 1e5 500 tangential linear_nohistory 0.5 {FRICTION} damping mass_velocity",
        "trapezoid",
        lambda b, d, u: 1e5 * d + 500 * b.mass * u,
    ),
    "hooke with tsuji": (
        f"hooke 1e5 0.5 tangential linear_history 4e4 0.5 {FRICTION} damping tsuji",
        "rk4",
        lambda b, d, u: 1e5 * d + TSUJI * math.sqrt(b.mass * 1e5) * u,
    ),
    "hooke of area": (
        f"hooke 1e5 5e5 tangential mindlin 1e7 0.5 {FRICTION}",
        "rk4",
        lambda b, d, u: 1e5 * d + b.hertz(5e5 * b.mass, d) * u,
    ),
    "viscoelastic": (
        f"hertz 1e8 5e5 tangential mindlin 1e8 0.5 {FRICTION} limit_damping",
        "rk2",
        lambda b, d, u: b.hertz(1e8, d) * d + b.hertz(5e5 * b.mass, d) * u,
    ),
    "material": (
        f"hertz/material 3e7 0.5 0.3 tangential mindlin NULL 0.5 {FRICTION} damping tsuji",
        "exact",
        lambda b, d, u: b.hertz(4 / 3 * b.e_star, d) * d + TSUJI * math.sqrt(b.mass * b.hertz(4 / 3 * b.e_star, d)) * u,
    ),
    "force": (
        f"hertz 1e8 5e5 tangential mindlin/force 1e8 0.5 {FRICTION}",
        "rk4",
        lambda b, d, u: b.hertz(1e8, d) * d + b.hertz(5e5 * b.mass, d) * u,
    ),
    "rescale": (
        f"hertz/material 3e7 0.5 0.3 tangential mindlin_rescale NULL 0.5 {FRICTION} damping tsuji",
        "rk4",
        lambda b, d, u: b.hertz(4 / 3 * b.e_star, d) * d + TSUJI * math.sqrt(b.mass * b.hertz(4 / 3 * b.e_star, d)) * u,
    ),
    "hertz with a linear spring": (
        f"hertz 1e8 20 tangential linear_history 4e4 0.5 {FRICTION} damping velocity",
        "rk4",
        lambda b, d, u: b.hertz(1e8, d) * d + 20 * u,
    ),
}


def integrated(slope, state, time, steps):
    """By the classical Runge-Kutta scheme."""
    h = time / steps
    for _ in range(steps):
        k1 = slope(state)
        k2 = slope(state + h / 2 * k1)
        k3 = slope(state + h / 2 * k2)
        k4 = slope(state + h * k3)
        state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return state


def closing_speed(force, bodies):
    """After T, in steps so small that the error is one of rounding."""
    def slope(state):
        return np.array([state[1], -force(bodies, max(state[0], 0.0), state[1]) / bodies.mass])

    overlap, speed = integrated(slope, np.array([START, SPEED]), TIME, 20000)
    assert overlap > 0.0, "the contact has ended"
    return speed
