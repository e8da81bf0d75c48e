# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres that meet at right angles without gravity, each at a random phase of the step, and their linear restitution.

It has a closed form. Where the contact ends without tension it is, with the damping ratio zeta, c = 2 zeta and
w = (4 - c^2)^(1/2), exp(-(c/w) (pi/2 - atan((c - 2/c)/w))), for zeta > 1 with b = (zeta^2 - 1)^(1/2)
((zeta - b)/(zeta + b))^(zeta/b). Where it ends as the bodies part, zeta < 1, it is exp(-pi zeta/(1 - zeta^2)^(1/2)).
"""

import functools
from math import atan, exp, pi, sqrt

import numpy as np
from harness.spheres import Sphere, reduced_mass

PHASES = 67  # for each kind of body that is hit
SPEED = 1.0  # [m/s]
RADIUS = 0.005  # [m]
STEPS_PER_CONTACT = (20, 10, 3, 1, 0.5, 1 / 3)
PAIR_MASS = reduced_mass(*2 * [Sphere((0, 0, 0), radius=RADIUS)])
STIFFNESS = 2.3e6  # [N/m]
TC = pi * sqrt(PAIR_MASS / STIFFNESS)  # of an undamped pair [s]
# (kn/m*)^(1/2) and the length l of viscoelastic_motion.h, of Hertz contacts that last TC undamped at SPEED
RATE = (3.21808 / TC) ** 1.25 / SPEED**0.25  # [1/(s m^(1/4))]
LENGTH = (SPEED / RATE) ** 0.2  # [m^(1/4)]


def linear_restitution(zeta, tension=False):
    """Speed after over speed before."""
    if tension:
        return exp(-pi * zeta / sqrt(1.0 - zeta**2))
    if zeta == 0.0:
        return 1.0
    if zeta > 1.0:
        b = sqrt(zeta**2 - 1.0)
        return ((zeta - b) / (zeta + b)) ** (zeta / b)
    c, w = 2.0 * zeta, 2.0 * sqrt(1.0 - zeta**2)
    return exp(-c / w * (pi / 2.0 - atan((c - 2.0 / c) / w)))


@functools.lru_cache
def viscoelastic_restitution(alpha, tension):
    """Of d'' = -d^(3/2) - alpha d^(1/2) d' from d = 0, d' = 1 on, by Runge-Kutta steps of dt, with damping that is not
    smooth where the contact begins: it adds alpha dt^(3/2) to the speed there, of which a part is lost, 1e-6 alpha."""
    dt = 1e-4

    def slope(d, u):
        root = sqrt(max(d, 0.0))
        return u, -root * (d + alpha * u)

    d, u = 0.0, 1.0
    while True:
        before = d, u
        k1 = slope(d, u)
        k2 = slope(d + dt / 2 * k1[0], u + dt / 2 * k1[1])
        k3 = slope(d + dt / 2 * k2[0], u + dt / 2 * k2[1])
        k4 = slope(d + dt * k3[0], u + dt * k3[1])
        d += dt / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        u += dt / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        hold, held = (d, before[0]) if tension else (d + alpha * u, before[0] + alpha * before[1])
        if hold <= 0.0 and u < 0.0:
            return -(before[1] + held / (held - hold) * (u - before[1]))


def touching_rebounds(zeta, nt, gaps, tension):
    """Those of the mean of the force now and the one predicted by the exact solution, acting from the touch on until it
    vanishes or the bodies part: "predict exact onset on". gaps: from which they come, in ways of one step.

    In units of m, k and the speed of impact, written anew from Eqs. 20, 27, 36 and 39.
    """
    dt, w, least = pi / nt, sqrt(1.0 - zeta**2), -np.inf if tension else 0.0
    d, u = -np.asarray(gaps, dtype=float) * dt, np.ones(len(gaps))

    def force(overlap, speed):
        return overlap + 2.0 * zeta * speed

    while np.any((d > 0.0) | (u > 0.0)):
        wait = np.where(d > 0.0, 0.0, np.where(u > 0.0, -d / np.where(u > 0.0, u, 1.0), dt))
        span, start = dt - np.minimum(wait, dt), np.maximum(d, 0.0)
        sine, cosine = (np.exp(-zeta * span) * f(w * span) for f in (np.sin, np.cos))
        end = cosine * start + sine / w * (u + zeta * start)
        end_speed = cosine * u - sine / w * (start + zeta * u)
        now, then = force(start, u), force(end, end_speed)
        parted = tension & (end < 0.0)
        part = np.where(parted, start / np.where(parted, start - end, 1.0), 1.0)
        then = np.where(parted, 2.0 * zeta * (u + part * (end_speed - u)), then)
        now = np.maximum(now, least)
        vanishes = then < least
        part = np.where(vanishes, now / np.where(vanishes, now - then, 1.0), part)
        impulse = np.where(span > 0.0, 0.5 * part * span * (now + np.maximum(then, least)), 0.0)
        d, u = d + dt * (u - 0.5 * impulse), u - impulse
    return -u


def one_at_rest(dt):
    """Two spheres: the first at rest, the second on its way to it, which it meets in the first step."""
    first = Sphere((0.0, 0.0, 0.0), radius=RADIUS)
    return [first, Sphere((2 * RADIUS + 0.7 * SPEED * dt, 0.0, 0.0), v=(-SPEED, 0.0, 0.0), radius=RADIUS)]
