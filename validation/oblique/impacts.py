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
from host_collisions import BALL, PHASES  # noqa: E402
from harness import lammps, liggghts  # noqa: E402, host_collisions has put it on the path
from harness.spheres import (  # noqa: E402
    MOTION,
    Law,
    Sphere,
    box,
    digits,
    dump,
    lammps_box,
    read_motion,
    stiffness_material,
    write_data,
)

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
        coefficient = self.law.coefficient(self.law.damping(self.restitution))
        return (
            f"fix Y all property/global youngsModulus peratomtype {digits([self.young] * 2)}\n"
            f"fix nu all property/global poissonsRatio peratomtype {digits([POISSON] * 2)}\n"
            f"fix e all property/global coefficientRestitution peratomtypepair 2 {digits([coefficient] * 4)}\n"
            f"fix mu all property/global coefficientFriction peratomtypepair 2 {digits([FRICTION] * 4)}\n"
        )


def impacts(angles, spins):
    """All bodies, angles [degrees] and spins, in this order."""
    cases = [(body, np.radians(angle), spin) for body, angle, spin in labels(angles, spins)]
    wall = [body == "wall" for body, _, _ in cases]
    return reference.Impacts(
        radii=np.array([(RADIUS, np.inf if one else RADIUS) for one in wall]),
        masses=np.array([(BALL.mass, np.inf if one else BALL.mass) for one in wall]),
        velocity=SPEED * np.array([(np.sin(angle), 0.0, -np.cos(angle)) for _, angle, _ in cases]),
        spins=SPEED / RADIUS * np.array([2 * [SPINS[spin]] for _, _, spin in cases]),
    )


def labels(angles, spins):
    """Body, angle and spin of impacts()."""
    return [(body, angle, spin) for body in BODIES for angle in angles for spin in spins]


def outcome(velocity, spin):
    """Velocity after the impact and surface velocity by spin over the impact speed, in six columns."""
    return np.concatenate([velocity, spin * RADIUS], axis=-1) / SPEED


def expected(material, cases, steps_per_contact):
    """(impacts, 6), and how much that changes if the step doubles."""
    laws = [material.laws[int(wall)] for wall in cases.wall]

    def found(nt):
        end = reference.final(cases, laws, TC / nt, 20 * nt)
        return outcome(end[:, :3], end[:, 3:6])

    fine = found(steps_per_contact)
    return fine, np.abs(fine - found(steps_per_contact // 2)).max()


def measure(material, method, cases, step, phases=PHASES):
    """What the host makes of them, (impacts, phases, 6). step: dt over tc."""
    model = f"model {material.model} tangential history {method.predict}"
    settings = f"limitForce on {material.settings}"
    deck = f"""{material.deck()}
pair_style {method.pair_style} {model} {settings}
pair_coeff * *
fix floor all wall/{method.pair_style} {model} primitive type 2 zplane 0.0 {settings}
fix integrate all {method.integrator}
"""
    steps = int(np.ceil(3.5 / step)) + 2  # a phase of a step, the contact, and the way apart
    every = 1 if step > 0.2 else steps  # stock's may fly into others later on
    flights = fly(deck, method.program, cases, BALL.density, step * TC, steps, every, phases)
    velocity, spins, _ = flights.after()
    return outcome(velocity, spins.mean(axis=2))


def sliding(cases, friction, restitution, longest, exact):
    """Which impacts on a wall have a slip that outlasts all the friction that there can be, without tangential dashpot
    (impacts,), and how far off their tangential velocity may be [m/s].

    Friction of mu (1 + e) times the momentum across the wall is the most there is; how much less it really is comes
    from the time in which the spring is loaded, which is all that steps can miss; and the slip turns as the lever of
    the spin becomes shorter. longest: contact [s]; exact: velocities after the impact (impacts, 3).
    """
    approach, radius = -cases.velocity[:, 2], cases.radii[:, 0]
    along, across = cases.velocity[:, :2], cases.spins[:, 0, :2] * radius[:, None]
    slip = np.linalg.norm(along + np.stack([-across[:, 1], across[:, 0]], axis=1), axis=1)
    most = friction * (1 + restitution) * approach
    left = slip - 3.5 * most
    slides = cases.wall & (left > 0)
    change = np.linalg.norm(exact[:, :2] - along, axis=1)
    shorter = approach * longest / 2 / (2 * radius)  # the lever, at most, over the radius
    turned = np.linalg.norm(across, axis=1) * shorter / np.where(slides, left, np.inf)
    return slides, (most * (1 + turned) - change)[slides]


@dataclass
class Flights:
    """Of all impacts with all phases, of the first body against the second: arrays (times, impacts, phases, ...)."""

    cases: reference.Impacts
    times: np.ndarray  # [s]
    touches: np.ndarray  # when they touch (phases,) [s]
    place: np.ndarray
    velocity: np.ndarray
    spins: np.ndarray  # of the first and the second, the first twice at a wall (..., 2, 3)

    @property
    def distance(self):
        """Of the centres, or of the centre from the wall."""
        return np.where(self.cases.wall[:, None], self.place[..., 2], np.linalg.norm(self.place, axis=-1))

    def after(self):
        """When the bodies go apart for the first time: velocity (impacts, phases, 3), spins (impacts, phases, 2, 3),
        and how long they had been in contact (impacts, phases) [s].

        With tension a step may turn bodies back once more that have just come apart: then it is when they are apart.
        """
        normal = np.where(self.cases.wall[:, None, None], [0.0, 0.0, 1.0], self.place)
        leaving = np.sum(normal * self.velocity, axis=-1) > 0
        gap = self.distance - self.cases.reach[:, None]
        been_in_contact = np.logical_or.accumulate(gap <= 0, axis=0)
        free = (gap > 0) & leaving
        free = np.where(free.any(axis=0), free, (gap > 0) & been_in_contact)
        assert np.all(free.any(axis=0)), "still in contact"
        row, column = np.indices(free.shape[1:])
        first = np.argmax(free, axis=0), row, column
        normal = normal[first] / np.linalg.norm(normal[first], axis=-1, keepdims=True)
        apart = self.times[first[0]] - gap[first] / np.sum(normal * self.velocity[first], axis=-1)
        return self.velocity[first], self.spins[first], apart - self.touches


def fly(deck, program, cases, density, dt, steps, every, phases=PHASES, host="liggghts"):
    """Runs all of them far apart in one deck. deck: from the material to the integrator.

    density: of the first spheres; the others have it too but for what their mass says.
    """
    free = 20 * cases.radii[:, 0].max() if cases.wall.all() else 10 * cases.reach.max()
    side = int(np.ceil(np.sqrt(len(cases) * len(phases))))
    spheres, firsts = [], []
    for k in range(len(cases)):
        (r, other), share = cases.radii[k], cases.reduced_mass[k] / cases.masses[k]
        for j, phase in enumerate(phases):
            row, column = divmod(k * len(phases) + j, side)
            ahead = -phase * dt * cases.velocity[k]
            x, y = free * (column - 0.5 * side), free * (row - 0.5 * side)
            firsts.append(len(spheres))
            first = Sphere((0.0, 0.0, 0.0), radius=r, density=density, omega=tuple(cases.spins[k, 0]))
            if cases.wall[k]:
                place = np.array([x, y, r]) + ahead
                spheres.append(replace(first, x=tuple(place), v=tuple(cases.velocity[k])))
                continue
            second = replace(first, radius=other, omega=tuple(cases.spins[k, 1]))
            second.density *= cases.masses[k, 1] / second.mass
            for sphere, part in ((first, share[0]), (second, -share[1])):
                place = np.array([x, y, free]) + part * (np.array([0.0, 0.0, r + other]) + ahead)
                spheres.append(replace(sphere, x=tuple(place), v=tuple(part * cases.velocity[k])))
    start = {"liggghts": box, "lammps": lammps_box}[host](dt, skin=free / 2)
    text = start + deck + dump(every, columns=MOTION, host=host) + f"run {steps}\n"
    with tempfile.TemporaryDirectory() as folder:
        half = free * (side / 2 + 10)
        write_data(Path(folder) / "spheres.data", spheres, low=-half, high=half)
        module = {"liggghts": liggghts, "lammps": lammps}[host]
        module.run(text, folder, program=program, options=("-log", "none"), timeout=None)
        times, motion = read_motion(Path(folder) / "motion.dump")
    wall = np.repeat(cases.wall, len(phases))
    own = motion[:, firsts]
    other = motion[:, np.where(wall, firsts, np.array(firsts) + 1)]
    against = np.where(wall[:, None], own, own - other)
    shape = (len(times), len(cases), len(phases))
    return Flights(
        cases,
        times * dt,
        np.array(phases) * dt,
        against[..., :3].reshape(*shape, 3),
        against[..., 3:6].reshape(*shape, 3),
        np.stack([own[..., 6:], other[..., 6:]], axis=2).reshape(*shape, 2, 3),
    )
