# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres that meet at right angles without gravity, each at a random phase of the step, and their linear restitution.

It has a closed form. Where the contact ends without tension it is, with the damping ratio zeta, c = 2 zeta and
w = (4 - c^2)^(1/2), exp(-(c/w) (pi/2 - atan((c - 2/c)/w))), for zeta > 1 with b = (zeta^2 - 1)^(1/2)
((zeta - b)/(zeta + b))^(zeta/b). Where it ends as the bodies part, zeta < 1, it is exp(-pi zeta/(1 - zeta^2)^(1/2)).
"""

from math import atan, exp, pi, sqrt

from harness.spheres import Sphere, reduced_mass

PHASES = 67  # for each kind of body that is hit
SPEED = 1.0  # [m/s]
RADIUS = 0.005  # [m]
STEPS_PER_CONTACT = (20, 10, 3, 1, 0.5, 1 / 3)
PAIR_MASS = reduced_mass(*2 * [Sphere((0, 0, 0), radius=RADIUS)])
STIFFNESS = 2.3e6  # [N/m]
TC = pi * sqrt(PAIR_MASS / STIFFNESS)  # of an undamped pair [s]


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


def one_at_rest(dt):
    """Two spheres: the first at rest, the second on its way to it, which it meets in the first step."""
    first = Sphere((0.0, 0.0, 0.0), radius=RADIUS)
    return [first, Sphere((2 * RADIUS + 0.7 * SPEED * dt, 0.0, 0.0), v=(-SPEED, 0.0, 0.0), radius=RADIUS)]
