# SPDX-License-Identifier: GPL-2.0-or-later
"""A fine sphere that rolls off two large ones: the decks of both hosts, and what should come out.

The case is that of D. R. Vyas, J. M. Ottino, R. M. Lueptow, P. B. Umbanhowar, Comput. Phys. Commun. 310, 109524 (2025),
arXiv:2410.14798, with the numbers of their example in LAMMPS, examples/granular/in.sync_verlet: two held spheres of
10 mm touch each other, a fine one touches both, at rest, 1 degree from the top.

Until it slips the fine one rolls about the line of centres of the large ones, at the distance p from it. Both contacts
lie at the distance r s from its axis of spin, s = p/(R + r), so it has the inertia of m (1 + k), k = 0.4/s^2:

    angle'' = g sin(angle)/(p (1 + k)),   spin = p angle'/(r s).

Static friction is right if it does so: each contact then carries m k g sin(angle)/(2 (1 + k)).
"""

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import cached_property
from math import log, pi, radians, sqrt
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))
from harness import lammps, liggghts  # noqa: E402
from harness.host import BUILD  # noqa: E402
from harness.spheres import (  # noqa: E402
    MOTION,
    Law,
    Sphere,
    box,
    dump,
    lammps_box,
    read_motion,
    stiffness_material,
    write_data,
)

LARGE = 0.005  # radius [m]
DENSITY, G = 2500.0, 9.81
START = radians(1)
RESTITUTION, FRICTION, TANGENTIAL = 0.5, 0.5, 0.8235  # the last: ks/kn
LEFT = 0.01  # of its radius: a fine sphere so far away has left
HOSTS = ("LIGGGHTS", "LAMMPS")
STOCK = "stock"


@dataclass(frozen=True)
class Case:
    ratio: float  # of the radii
    tc: float  # of a contact [s]

    @property
    def fine(self):
        return Sphere(x=self.start, radius=LARGE / self.ratio, density=DENSITY, type=2)

    @property
    def distance(self):
        """p."""
        return sqrt((LARGE + LARGE / self.ratio) ** 2 - LARGE**2)

    @property
    def start(self):
        return (0.0, self.distance * np.sin(START), self.distance * np.cos(START))

    @property
    def sine(self):
        """s."""
        return self.distance / (LARGE + LARGE / self.ratio)

    @property
    def growth(self):
        """Of a small angle, cosh(growth t) [1/s]."""
        return sqrt(G / (self.distance * (1 + 0.4 / self.sine**2)))

    @property
    def sink(self):
        """By how much p is shorter at rest [m]: each contact carries m g/(2 s)."""
        return self.fine.mass * G / (2 * self.sine**2 * self.law.kn)

    @cached_property
    def law(self):
        kn = self.fine.mass * (pi / self.tc) ** 2
        zeta = -log(RESTITUTION) / sqrt(pi**2 + log(RESTITUTION) ** 2)
        return Law(kn, 2 * zeta * sqrt(kn * self.fine.mass), TANGENTIAL * kn, 0.0, FRICTION)

    def rolled(self, t):
        """Angle at the times t in closed form, up to a quadrature."""
        acceleration = self.growth**2
        motion = solve_ivp(
            lambda _, y: [y[1], acceleration * np.sin(y[0])], (0, t[-1]), [START, 0.0], t_eval=t, rtol=1e-10, atol=1e-14
        )
        return motion.y[0]

    def reference(self, duration, samples, steps_per_contact):
        """Motion by fine_particle.cpp."""
        law, dt = self.law, self.tc / steps_per_contact
        every = round(duration / samples / dt)
        numbers = [LARGE, self.fine.radius, DENSITY, G, law.kn, law.hn, law.ks, law.mu, START, dt, every, samples + 1]
        program = BUILD / "bin" / "fine_particle"
        text = subprocess.run([program, *map(repr, map(float, numbers))], capture_output=True, text=True, check=True)
        t, y, z, vy, vz, spin = np.array([line.split(",") for line in text.stdout.splitlines()[1:]], dtype=float).T
        return Motion(self, t, np.stack([y, z], axis=1), np.stack([vy, vz], axis=1), spin)


@dataclass
class Motion:
    """Of the fine sphere in the plane between the large ones: arrays over the times t [s]."""

    case: Case
    t: np.ndarray
    x: np.ndarray  # (times, 2), across and up
    v: np.ndarray
    spin: np.ndarray  # about the line of centres

    @property
    def angle(self):
        """From the top [rad]."""
        return np.unwrap(np.arctan2(self.x[:, 0], self.x[:, 1]))

    def at(self, values, t):
        return np.interp(t, self.t, values)

    def slip(self):
        """Of the contacts over the speed of the sphere, at every time but the first."""
        along = np.stack([np.cos(self.angle), -np.sin(self.angle)], axis=1)
        speed = np.sum(self.v * along, axis=1)[1:]
        return np.abs(speed + self.spin[1:] * self.case.fine.radius * self.case.sine) / np.abs(speed)

    def left(self):
        """When it has left [s], not a number if it has not."""
        gap = np.sqrt(LARGE**2 + np.sum(self.x**2, axis=1)) - LARGE - self.case.fine.radius
        away = gap > LEFT * self.case.fine.radius
        if not away.any():
            return np.nan
        k = np.argmax(away)
        return np.interp(LEFT * self.case.fine.radius, gap[k - 1 : k + 1], self.t[k - 1 : k + 1])

    def kinetic(self):
        """Without spin [J]."""
        return self.case.fine.mass / 2 * np.sum(self.v**2, axis=1)


def liggghts_styles(law, method):
    pair, predict = ("gran", "") if method == STOCK else ("gran/cfpm", f"predict {method}")
    return stiffness_material({(1, 1): law, (1, 2): law, (2, 2): law}) + (
        f"pair_style {pair} model hooke/stiffness tangential history {predict} limitForce on absolute_damping on"
        " tangential_damping off\n"
    )


def lammps_styles(law, method, mass):
    pair, predict = ("gran/hooke/history", "") if method == STOCK else ("gran/cfpm hooke", f"predict {method}")
    numbers = f"{law.kn:.17g} {law.ks:.17g} {law.hn / mass:.17g} 0.0 {law.mu} 0"
    return f"pair_style {pair} {numbers} limit_damping {predict}\n"


def measure(host, method, case, dt, duration, samples):
    """Motion in a host. method: STOCK or a predictor."""
    every = max(1, round(duration / samples / dt))
    skin = 0.2 * LARGE
    if host == "LIGGGHTS":
        text = box(dt, skin=skin) + liggghts_styles(case.law, method)
    else:
        text = lammps_box(dt, skin=skin) + lammps_styles(case.law, method, case.fine.mass)
    module = liggghts if host == "LIGGGHTS" else lammps
    text += f"""
pair_coeff * *
group large type 1
group fine type 2
fix hold large freeze
fix gravity fine gravity {G} vector 0 0 -1
fix integrate fine {"nve/sphere" if method == STOCK else "nve/cfpm"}
{dump(every, group="fine", columns=MOTION, host=host.lower())}
run {every * samples}
"""
    spheres = [case.fine, *(Sphere((x, 0.0, 0.0), radius=LARGE, density=DENSITY, held=True) for x in (-LARGE, LARGE))]
    with tempfile.TemporaryDirectory() as folder:
        write_data(Path(folder) / "spheres.data", spheres, low=-10 * LARGE, high=10 * LARGE)
        program = module.STOCK if method == STOCK else module.LAUNCHER
        module.run(text, folder, program=program, options=("-log", "none"), timeout=None)
        steps, motion = read_motion(Path(folder) / "motion.dump")
    own = motion[:, 0]
    return Motion(case, steps * dt, own[:, 1:3], own[:, 4:6], own[:, 6])
