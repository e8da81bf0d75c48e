# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts in the host, of pairs and on a plane, many at a time, and the materials that they have."""

import sys
import tempfile
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "collisions")]
import reference  # noqa: E402
from contact_law import ContactLaw  # noqa: E402
from host_collisions import BALL, DIAMETER, PHASES  # noqa: E402
from harness import liggghts  # noqa: E402, host_collisions has put it on the path
from harness.spheres import MOTION, Law, box, digits, dump, read_motion, stiffness_material, write_data  # noqa: E402

SPEED = 1.0  # of the impact [m/s]
RADIUS = BALL.radius
TC = RADIUS / 40 / SPEED  # of the undamped head-on pair: at 3 tc a step the spheres move by 3/40 of their radius
LONGEST = 2.8 * TC  # a Hertz contact with the wall at 85 degrees lasts 2^0.2 11^0.2 = 1.9 tc undamped
MASSES = (BALL.mass / 2, BALL.mass)  # reduced: of a pair, at a wall
FRICTION = 0.3
POISSON = 0.32
SPINS = {  # surface velocity by spin over the impact speed, and the axis
    "none": (0.0, 0.0, 0.0),
    "with the slip": (0.0, -0.5, 0.0),
    "against it": (0.0, 0.5, 0.0),
    "across": (0.5, 0.0, 0.0),
}
BODIES = ("pair", "wall")
FREE = 10 * DIAMETER  # what the stock style throws at large steps flies far


@dataclass(frozen=True)
class Hooke:
    """hooke/stiffness with absolute damping."""

    restitution: float
    dashpot: bool = False  # across the normal: with the damping ratio of the normal direction
    model = "hooke/stiffness"
    law = ContactLaw(1.0)

    def __str__(self):
        return f"Hooke, e = {self.restitution:g}" + (", dashpot" if self.dashpot else "")

    @property
    def settings(self):
        return f"absolute_damping on tangential_damping {'on' if self.dashpot else 'off'}"

    @cached_property
    def laws(self):
        kn = MASSES[0] * (np.pi / TC) ** 2
        ks = kn / (2 * (1 + POISSON))
        damping = self.law.damping(self.restitution)
        hn = [damping * np.sqrt(mass * kn) for mass in MASSES]
        return [Law(kn, h, ks, h * np.sqrt(ks / kn) if self.dashpot else 0.0, FRICTION) for h in hn]

    def deck(self):
        pair, wall = self.laws
        return stiffness_material({(1, 1): pair, (1, 2): wall, (2, 2): wall})


@dataclass(frozen=True)
class Hertz:
    """hertz with tangential history and without tangential dashpot."""

    restitution: float
    model = "hertz"
    settings = "tangential_damping off"
    law = ContactLaw(1.5)
    dashpot = False

    def __str__(self):
        return f"Hertz, e = {self.restitution:g}"

    @cached_property
    def young(self):
        unit = self.law.duration(0.0)
        kn = MASSES[0] * (unit / TC) ** 2.5 / np.sqrt(SPEED)
        return kn / (4 / 3 / (2 * (1 - POISSON**2)) * np.sqrt(RADIUS / 2))  # [Pa]

    @cached_property
    def laws(self):
        alpha = self.law.damping(self.restitution)
        laws = []
        for mass, radius in zip(MASSES, (RADIUS / 2, RADIUS)):
            kn = 4 / 3 * self.young / (2 * (1 - POISSON**2)) * np.sqrt(radius)
            ks = 8 * self.young / (4 * (2 - POISSON) * (1 + POISSON)) * np.sqrt(radius)
            laws.append(Law(kn, alpha * np.sqrt(kn * mass), ks, 0.0, FRICTION, "hertz"))
        return laws

    def deck(self):
        # the host's coefficient is the restitution of a contact with tension, and gives Tsuji's alpha = 5^(1/2) beta
        beta = self.law.damping(self.restitution) / np.sqrt(5)
        coefficient = np.exp(-np.pi * beta / np.sqrt(1 - beta**2))
        return (
            f"fix Y all property/global youngsModulus peratomtype {digits([self.young] * 2)}\n"
            f"fix nu all property/global poissonsRatio peratomtype {digits([POISSON] * 2)}\n"
            f"fix e all property/global coefficientRestitution peratomtypepair 2 {digits([coefficient] * 4)}\n"
            f"fix mu all property/global coefficientFriction peratomtypepair 2 {digits([FRICTION] * 4)}\n"
        )


def impacts(angles, spins):
    """All bodies, angles [degrees] and spins, in this order."""
    cases = [(body, np.radians(angle), spin) for body, angle, spin in labels(angles, spins)]
    return reference.Impacts(
        wall=np.array([body == "wall" for body, _, _ in cases]),
        velocity=SPEED * np.array([(np.sin(angle), 0.0, -np.cos(angle)) for _, angle, _ in cases]),
        spin=SPEED / RADIUS * np.array([SPINS[spin] for _, _, spin in cases]),
    )


def labels(angles, spins):
    """Body, angle and spin of impacts()."""
    return [(body, angle, spin) for body in BODIES for angle in angles for spin in spins]


def outcome(velocity, spin):
    """Velocity after the impact and surface velocity by spin over the impact speed, in six columns."""
    return np.concatenate([velocity, spin * RADIUS], axis=-1) / SPEED


def expected(material, cases, steps_per_contact):
    """(impacts, 6), and how much that changes if the step doubles."""

    def found(nt):
        end = reference.final(cases, material.laws, BALL, TC / nt, 20 * nt)
        return outcome(end[:, :3], end[:, 3:])

    fine = found(steps_per_contact)
    return fine, np.abs(fine - found(steps_per_contact // 2)).max()


def measure(material, method, cases, step, phases=PHASES):
    """What the host makes of them, (impacts, phases, 6). step: dt over tc."""
    dt = step * TC
    side = int(np.ceil(np.sqrt(len(cases) * len(phases))))
    spheres, firsts = [], []
    for k in range(len(cases)):
        for j, phase in enumerate(phases):
            row, column = divmod(k * len(phases) + j, side)
            ahead = -phase * dt * cases.velocity[k]
            x, y = FREE * (column - 0.5 * side), FREE * (row - 0.5 * side)
            firsts.append(len(spheres))
            omega = tuple(cases.spin[k])
            if cases.wall[k]:
                place = np.array([x, y, RADIUS]) + ahead
                spheres.append(replace(BALL, x=tuple(place), v=tuple(cases.velocity[k]), omega=omega))
                continue
            for part in (0.5, -0.5):
                place = np.array([x, y, FREE]) + part * (np.array([0.0, 0.0, DIAMETER]) + ahead)
                spheres.append(replace(BALL, x=tuple(place), v=tuple(part * cases.velocity[k]), omega=omega))
    steps = int(np.ceil(3.5 / step)) + 2  # a phase of a step, the contact, and the way apart
    every = 1 if step > 0.2 else steps  # stock's may fly into others later on
    model = f"model {material.model} tangential history {method.predict}"
    settings = f"limitForce on {material.settings}"
    text = box(dt, skin=FREE / 2) + material.deck()
    text += f"""
pair_style {method.pair_style} {model} {settings}
pair_coeff * *
fix floor all wall/{method.pair_style} {model} primitive type 2 zplane 0.0 {settings}
fix integrate all {method.integrator}
"""
    text += dump(every, columns=MOTION) + f"run {steps}\n"
    with tempfile.TemporaryDirectory() as folder:
        half = FREE * (side / 2 + 10)
        write_data(Path(folder) / "spheres.data", spheres, low=-half, high=half)
        liggghts.run(text, folder, program=method.program, options=("-log", "none"), timeout=None)
        _, motion = read_motion(Path(folder) / "motion.dump")
    return after(motion, np.array(firsts), np.repeat(cases.wall, len(phases))).reshape(len(cases), len(phases), 6)


def after(motion, firsts, wall):
    """Of each impact when the bodies are apart for the first time. motion: (times, spheres, MOTION)."""
    own = motion[:, firsts]
    other = motion[:, np.where(wall, firsts, firsts + 1)]
    own_spin = np.where(wall[:, None], own, (own + other) / 2)[..., 6:]
    floor = np.array([0.0, 0.0, 1.0])
    place = np.where(wall[:, None], floor * own[..., :3], own[..., :3] - other[..., :3])
    velocity = np.where(wall[:, None], own[..., 3:6], own[..., 3:6] - other[..., 3:6])
    apart = np.linalg.norm(place, axis=-1) > np.where(wall, RADIUS, DIAMETER)
    leaving = np.sum(place * velocity, axis=-1) > 0
    free = apart & leaving
    assert np.all(free.any(axis=0)), "still in contact"
    first = np.argmax(free, axis=0)
    rows = np.arange(len(firsts))
    return outcome(velocity[first, rows], own_spin[first, rows])
