# SPDX-License-Identifier: GPL-2.0-or-later
"""Overlaps of an undamped contact at rest and in an impact, in closed form. Lengths, times and masses of one system."""

from math import gamma, pi, sqrt

# of a Hertz contact: tc = HERTZ_TIME d/v, with the deepest overlap d of an impact at speed v
HERTZ_TIME = 2 * 0.4 * gamma(0.4) * sqrt(pi) / gamma(0.9)
# Average overlaps that soft spheres are commonly given are 0.1 to 1 % of their size: P. W. Cleary, Large-scale
# industrial DEM modelling, Engineering Computations 21, 169 (2004).
USUAL_LIMIT = 0.01

# (nt, overlap at rest over that of the law) as measured with linear contacts, least nt first: in a column with impulse
# (./cfpm validate statics), of a sphere on a floor with the paper's predictors (docs/pair_gran_cfpm.md)
IMPULSE_AT_REST = ((1, 10.0), (3, 3.3), (5, 1.7), (10, 1.26), (30, 1.08))
PREDICTED_AT_REST = ((3, 1.52), (6, 1.22), (30, 1.04))


def reduced(masses):
    """m* of two bodies; a wall has mass 0 in the facts and is taken as immovable."""
    one, other = masses
    return one * other / (one + other) if other else one


def contact_time(collision, deck_speed, speed):
    """tc at an impact speed; the facts have it at deck_speed, which matters to Hertz contacts alone."""
    return collision["tc"] * (speed / deck_speed) ** -0.2 if collision["hertz"] else collision["tc"]


def impact_overlap(collision, deck_speed, speed):
    """Deepest: v sqrt(m*/kn) = v tc/pi; Hertz: (5/4 m* v^2/kn)^(2/5), which is v tc/HERTZ_TIME."""
    return speed * contact_time(collision, deck_speed, speed) / (HERTZ_TIME if collision["hertz"] else pi)


def stiffness(collision, deck_speed):
    """kn of f = kn d, or of Hertz's f = kn d^(3/2), from the time of an impact."""
    mass, tc = reduced(collision["masses"]), collision["tc"]
    if not collision["hertz"]:
        return mass * (pi / tc) ** 2
    return 1.25 * mass * deck_speed**2 / (deck_speed * tc / HERTZ_TIME) ** 2.5


def static_overlap(collision, deck_speed, gravity, height):
    """Under a column of single spheres of that height, of the heavier of the two columns; at least a sphere's own
    weight. Spheres fill 52 % of such a column."""
    bodies = [(m, r) for m, r in zip(collision["masses"], collision["radii"]) if m]
    load = max(m * gravity * max(1.0, height / (2 * r)) for m, r in bodies)
    return (load / stiffness(collision, deck_speed)) ** (2 / 3 if collision["hertz"] else 1)


def least_radius(collision):
    return min(r for r in collision["radii"] if r)


def at_rest_factor(method, nt):
    """By which overlaps at rest exceed the law's: that of the largest measured nt not above, a bound."""
    if method == "verlet":
        return 1.0
    measured = IMPULSE_AT_REST if method == "impulse" else PREDICTED_AT_REST
    return min(factor for steps, factor in measured if steps <= 1.001 * nt)
