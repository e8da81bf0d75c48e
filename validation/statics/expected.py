# SPDX-License-Identifier: GPL-2.0-or-later
"""What follows for states at rest from the equations of the methods, and how far rounding may be off it.

A contact at rest acts with k d in the stock style. A predicted one that averages the force now and the force of the
isolated contact a step later (Eq. 20) acts with (1 + q)/2 k d, where q is what is left of the force: the isolated
contact springs back, its partner being the only other body it knows of. So

  overlap    the force F needs d = 2/(1 + q) F/k. No tension (Eq. 36): q >= 0.
  friction   a tangential spring acts with (1 + r)/2 ks xi, r its own ratio, dashpot included. At its end it gives mu fn
             now and r times that a step later, unless the spring's part of r is beyond q: mu q fn is the limit then
             (Eq. 40), of the spring alone. As the mean normal force is (1 + q)/2 fn, a contact that does not slip
             holds c mu times it, c = (1 + r)/(1 + q), or with the limit in place of r: less than mu for r < q.
  creep      A contact that slips at the speed w gives mu fn now, without a dashpot, and r mu fn + s w later, s the
             predicted damping, with the same limit of the spring's part. So a tangential load T is carried at w =
             (2 T - (1 + r) mu fn)/s, if that is positive. With s < 0 a block may both hold and creep.

The impulse of an isolated contact is linear in its overlap and, near rest, in its closing speed: J = dt (K d + H u),
so the force F needs d = F/K, and friction is limited by impulses, so that bodies which stick hold all of mu. A
contact whose bodies have others gives less, so that all of them together come to rest: with C and D what a step, at
most a quarter of a period long, takes of the speed for an overlap and for a closing speed, K is softened until C dt
is pi/2 at most, and both are divided by D times the crowding, if that is above 1. crowding: 1, and 1/2 m*/m for each
other contact of either body. A load that a single contact carries counts as another one.

Beyond mu both forces are at their limits, and a block on an incline accelerates by g (sin a - mu cos a): in every
method that limits the mean friction to mu times the mean normal force. Neither style has a dashpot on top of it.

A column at rest stays there if the step, linear around that state, makes a disturbance smaller: the largest
eigenvalue of the map of all positions and velocities is below 1. Rounding adds half an ulp a step, which decays too.
"""

from math import atan, atan2, cos, degrees, exp, pi, radians, sin, sqrt
from typing import NamedTuple

import numpy as np
from states import COLUMN, DIAMETER, ETA, ETAT, G, KN, KT, MU, RADIUS, ROW, SINK, STOCK, M

# which states has put on the path
from harness.prediction_map import scaled_map  # noqa: E402

IMPULSE = "impulse"
LOADED = 1.5  # crowding of a sphere that rests on the floor alone
BETWEEN_TWO = [2.0]  # crowding of a sphere of the block at the floor, with one before and one behind it
MEAN_OF_TWO_FORCES = ("exact", "trapezoid", "rk2", "rk4")  # the predictors of the equations above


class Left(NamedTuple):
    """Of the force of an isolated contact a step later."""

    from_spring: float  # ratio to the force of the spring now
    from_rate: float  # over the rate now [kg/s]
    spring_from_spring: float  # the spring's part of the first
    spring_from_rate: float  # of the second


def left(predictor, stiffness, damping, mass, dt):
    omega = sqrt(stiffness / mass)
    zeta = damping / (2 * sqrt(stiffness * mass))
    step = scaled_map(predictor, omega * dt, zeta)
    both, spring = (stiffness / omega * np.array([1.0, of_rate]) @ step for of_rate in (2 * zeta, 0.0))
    return Left(both[0] * omega / stiffness, both[1], spring[0] * omega / stiffness, spring[1])


def derived(method):
    """Whether the equations above are its own."""
    return method == STOCK or method.predict in (*MEAN_OF_TWO_FORCES, IMPULSE)


def motion(mass, d, u, dt):
    """Overlap and closing speed of an isolated contact after dt; once no force is left its bodies fly on."""
    b = ETA / (2 * mass)
    w = sqrt(KN / mass - b**2)
    f, g = KN / mass * d + 2 * b * u, KN / mass * u - b * (KN / mass * d + 2 * b * u)
    t = min(dt, atan2(f * w, -g) / w)
    decay, c, s = exp(-b * t), cos(w * t), sin(w * t) / w
    end = decay * ((c + b * s) * d + s * u), decay * (-KN / mass * s * d + (c - b * s) * u)
    return end[0] + (dt - t) * end[1], end[1]


def impulse_response(mass, dt, felt=1.0):
    """K, H of an impulse, see above. felt: the crowding."""

    def mean_force(u):
        return mass * (u - motion(mass, 1.0, u, dt)[1]) / dt

    u = 1e-6 * sqrt(KN / mass)
    alone = np.array([mean_force(0.0), (mean_force(u) - mean_force(-u)) / (2 * u)])
    if felt == 1.0:
        return alone
    b = ETA / (2 * mass)
    w = sqrt(KN / mass - b**2)
    t = min(dt, atan2(w, b) / w)
    from_overlap = KN / mass * exp(-b * t) * sin(w * t) / w
    from_speed = 1 - exp(-b * t) * (cos(w * t) - b / w * sin(w * t))
    return alone * [min(1.0, pi / 2 / (from_overlap * dt)), 1.0] / max(1.0, felt * from_speed)


def column_felt(count):
    """Crowding of the contacts of a column, from the floor up: m*/m is 1 at the floor, else 1/2. Each sphere has one
    other contact, the highest its load."""
    return np.array([LOADED, *(count - 1) * [1 + (1 + 1) / 2 / 2]])


def normal_ratio(case, mass):
    """q. mass: the reduced mass."""
    return max(0.0, left(case.method.predict, KN, ETA, mass, case.dt).from_spring)


def tangential(case):
    """Left of the friction at the floor. 1/mt = 1/m + r^2/I."""
    return left(case.method.predict, KT, ETAT, M * 2 / 7, case.dt)


def sinking(case, mass, felt):
    """Overlap at rest over force/k."""
    if case.method == STOCK:
        return 1.0
    if case.method.predict == IMPULSE:
        return KN / impulse_response(mass, case.dt, felt)[0]
    return 2 / (1 + normal_ratio(case, mass))


def column_overlaps(case):
    """In units of m g/k, as states.overlaps: the single sphere, then the column from the floor up."""
    lone = sinking(case, M, LOADED)
    sunk = [sinking(case, mass, felt) for mass, felt in zip(column_masses(COLUMN), column_felt(COLUMN))]
    return np.array([lone, *(sunk * np.arange(COLUMN, 0, -1))])


def friction_held(case):
    """c: of mu, what a contact that does not slip can hold."""
    if case.method == STOCK or case.method.predict == IMPULSE:
        return 1.0
    q, later = normal_ratio(case, M), tangential(case)
    spring = later.spring_from_spring
    return (1 + (later.from_spring if abs(spring) <= q else np.clip(spring, -q, q))) / (1 + q)


def creep_speeds(case):
    """Of a block on an incline below arctan(mu), where it may hold, creep or either [m/s]."""
    a = radians(case.angle)
    held = [0.0] if sin(a) < friction_held(case) * MU * cos(a) else []
    if case.method == STOCK or case.method.predict == IMPULSE:
        return held
    q, later = normal_ratio(case, M), tangential(case)
    limit = MU * 2 / (1 + q) * M * G * cos(a)  # of the friction now
    friction = 2 * M * G * sin(a) - limit  # a step later
    speed = (friction - later.from_spring * limit) / later.from_rate
    spring = later.spring_from_spring * limit + later.spring_from_rate * speed
    return held + ([speed] if speed > 0 and abs(spring) <= q * limit else [])


def incline(part_of_mu):
    """Angle whose tangent is so much of mu [degrees]."""
    return degrees(atan(part_of_mu * MU))


def sliding_acceleration(angle):
    a = radians(angle)
    return G * (sin(a) - MU * cos(a))


def column_masses(count):
    """Reduced masses of the contacts of a column, from the floor up."""
    return [M, *(count - 1) * [M / 2]]


def chain(case, count, felt):
    """The step of so many spheres above each other, along z: its map of (z, v), and the overlaps from z. felt: the
    crowding of their contacts."""
    closing = np.eye(count, k=-1) - np.eye(count)  # the first contact is the floor's
    stiffness, damping = np.full(count, KN), np.full(count, ETA)
    if case.method.predict == IMPULSE:
        responses = [impulse_response(mass, case.dt, one) for mass, one in zip(column_masses(count), felt)]
        stiffness, damping = np.transpose(responses)
    elif case.method != STOCK:
        ratios = [left(case.method.predict, KN, ETA, mass, case.dt) for mass in column_masses(count)]
        later = np.array([ratio[:2] if ratio.from_spring >= 0 else (0.0, 0.0) for ratio in ratios])  # Eq. 36
        stiffness, damping = KN / 2 * (1 + later[:, 0]), (ETA + later[:, 1]) / 2
    dt, one = case.dt, np.eye(count)
    by_z, by_v = (-closing.T @ np.diag(c) @ closing / M for c in (stiffness, damping))  # accelerations
    if case.method == STOCK:  # v is that of half a step ago, which the dashpot takes
        kick = [dt * by_z, one + dt * by_v]
        return np.block([[one + dt * kick[0], dt * kick[1]], kick]), closing
    half = dt**2 / 2
    return np.block([[one + half * by_z, dt * one + half * by_v], [dt * by_z, one + dt * by_v]]), closing


def growth(case, felt):
    """Of a disturbance of a column with such contacts, a factor per step; a steady state needs less than 1."""
    return np.abs(np.linalg.eigvals(chain(case, len(felt), felt)[0])).max()


def dither(case, size, felt):
    """Largest sum of rounding errors [m]. size: of the coordinates; felt: see chain()."""
    return np.spacing(size) / 2 / (1 - growth(case, felt))


def column_tolerance(case, steps):
    """Of the overlaps, in units of m g/k: twice the dither, and what is left of the way from the start."""
    felt = column_felt(COLUMN)
    step, closing = chain(case, COLUMN, felt)
    away = np.arange(COLUMN, 0, -1) - column_overlaps(case)[1:]
    start = np.concatenate([np.linalg.solve(closing, away), np.zeros(COLUMN)])
    rest = closing @ (np.linalg.matrix_power(step, steps) @ start)[:COLUMN]
    return 2 * dither(case, COLUMN * DIAMETER, felt) / SINK + np.abs(rest).max()


def creep_tolerance(case):
    """Of a speed [m/s]: a dither of the overlap changes the limit, twice; a position is rounded every step."""
    limit = MU * KN * dither(case, RADIUS, BETWEEN_TWO)
    mean_of_two = case.method.predict in MEAN_OF_TWO_FORCES
    damping = tangential(case).from_rate if mean_of_two else ETAT
    return 2 * limit / abs(damping) + np.spacing(ROW * DIAMETER) / 2 / case.dt


def acceleration_tolerance(case):
    return MU * KN * dither(case, RADIUS, BETWEEN_TWO) / M
