# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests 1 to 8 of Y. C. Chung and J. Y. Ooi, Granular Matter 13, 643 (2011), and what their decks say in the hosts.

Materials, sizes and velocities are those of the paper as its implementations in Yade (examples/chung-ooi-benchmarks),
PySPH and Kratos give them; copper's are not in these, but handbook values. A rigid plane has the sphere's material and
a thousand times its Young's modulus, as there; the large sphere of test 8 has a thousand times the density.
"""

import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "collisions"), str(HERE.parent / "oblique")]
import impacts  # noqa: E402
from contact_law import ContactLaw  # noqa: E402
from host_collisions import STOCK  # noqa: E402
from reference import Impacts  # noqa: E402
from scipy.optimize import brentq  # noqa: E402
from harness import lammps  # noqa: E402, host_collisions has put it on the path
from harness.spheres import Law, digits  # noqa: E402

HERTZ = ContactLaw(1.5)
RIGID = 1000.0  # Young's modulus of a plane over the sphere's
HEAVY = 1000.0  # density of the large sphere of test 8 over that of the small one
LONGEST = 1.7  # contact over tc, undamped: of test 4 at 85 degrees, cos(85)^-0.2
STEPS = 6  # of tc: a phase of a step, the contact, and the way apart


@dataclass(frozen=True)
class Material:
    name: str
    young: float  # [Pa]
    poisson: float
    density: float  # [kg/m^3]


GLASS = Material("glass", 4.8e10, 0.20, 2800.0)
LIMESTONE = Material("limestone", 2.0e10, 0.25, 2500.0)
WROUGHT_ALUMINIUM = Material("aluminium alloy", 7.0e10, 0.30, 2699.0)  # of test 2
MAGNESIUM = Material("magnesium alloy", 4.0e10, 0.35, 1800.0)
ALUMINIUM_OXIDE = Material("aluminium oxide", 3.8e11, 0.23, 4000.0)
CAST_IRON = Material("cast iron", 1.0e11, 0.25, 7000.0)
ALUMINIUM = Material("aluminium alloy", 7.0e10, 0.33, 2700.0)
STEEL = Material("steel", 2.08e11, 0.30, 7850.0)
POLYETHYLENE = Material("polyethylene", 1.0e9, 0.40, 1400.0)
NYLON = Material("nylon", 2.5e9, 0.40, 1000.0)
COPPER = Material("copper", 1.2e11, 0.35, 8900.0)


@dataclass(frozen=True)
class Test:
    number: int
    material: Material
    radius: float  # of the first sphere [m]
    other: float  # radius of the second, infinite for a plane [m]
    speed: float  # of the impact, along the normal but in test 4 [m/s]
    friction: float
    restitution: float
    varied: tuple = (0.0,)  # angle [degrees], tangential velocity [m/s] or spin [rad/s]
    tension: bool = False  # until the bodies part

    def __str__(self):
        return f"{self.number}, {self.material.name}" + (f", e = {self.restitution:g}" if self.number == 3 else "")

    @cached_property
    def cases(self):
        n = len(self.varied)
        varied, zero = np.array(self.varied), np.zeros(n)
        velocity = np.stack([zero, zero, np.full(n, -self.speed)], axis=1)
        spins = np.zeros((n, 2, 3))
        if self.number == 4:
            angle = np.radians(varied)
            velocity = self.speed * np.stack([np.sin(angle), zero, -np.cos(angle)], axis=1)
        elif self.number == 5:
            velocity[:, 0] = varied
        elif self.number in (6, 8):
            spins[:, 0, 1] = varied
        elif self.number == 7:  # opposite to each other, so that the surfaces do not slip
            spins[:, 0, 1], spins[:, 1, 1] = varied, -varied
        first = self.material.density * 4 / 3 * np.pi * self.radius**3
        heavy = HEAVY if self.number == 8 else 1.0
        second = first * heavy * (self.other / self.radius) ** 3
        return Impacts(np.tile((self.radius, self.other), (n, 1)), np.tile((first, second), (n, 1)), velocity, spins)

    @property
    def plane(self):
        return np.isinf(self.other)

    @cached_property
    def moduli(self):
        """E* and G* of the contact [Pa]."""
        m = self.material
        softer = 1 + (1 / RIGID if self.plane else 1.0)
        shear = m.young / (2 * (1 + m.poisson))
        return m.young / (1 - m.poisson**2) / softer, shear / (2 - m.poisson) / softer

    @cached_property
    def damping(self):
        """Tsuji's alpha. With tension the restitution has another closed form than without."""
        if not self.tension:
            return HERTZ.damping(self.restitution)
        return HERTZ.damping_with_tension(self.restitution)

    @cached_property
    def law(self):
        mass, root = self.cases.reduced_mass[0], np.sqrt(self.cases.reduced_radius[0])
        kn, ks = 4 / 3 * self.moduli[0] * root, 8 * self.moduli[1] * root
        return Law(kn, self.damping * np.sqrt(mass * kn), ks, 0.0, self.friction, "hertz", self.tension)

    @cached_property
    def tc(self):
        """Of the undamped contact at this speed along the normal, 2.868 (m*^2/(R* E*^2 v))^(1/5) [s]."""
        return HERTZ.duration(0.0) * (self.cases.reduced_mass[0] / self.law.kn) ** 0.4 * self.speed**-0.2

    @cached_property
    def deepest(self):
        """Overlap of an elastic impact along the normal, (15 m* v^2/(16 E* R*^(1/2)))^(2/5) [m]."""
        energy = self.cases.reduced_mass[0] * self.speed**2 / 2
        return (2.5 * energy / self.law.kn) ** 0.4

    def styles(self, method):
        """From the material to the integrator, for LIGGGHTS."""
        m = self.material
        coefficient = HERTZ.coefficient(self.damping)
        model = f"model hertz tangential history {method.predict}"
        settings = f"limitForce {'off' if self.tension else 'on'} tangential_damping off"
        floor = f"fix floor all wall/{method.pair_style} {model} primitive type 2 zplane 0.0 {settings}\n"
        return (
            "hard_particles yes\n"
            f"fix Y all property/global youngsModulus peratomtype {digits([m.young, RIGID * m.young])}\n"
            f"fix nu all property/global poissonsRatio peratomtype {digits([m.poisson] * 2)}\n"
            f"fix e all property/global coefficientRestitution peratomtypepair 2 {digits([coefficient] * 4)}\n"
            f"fix mu all property/global coefficientFriction peratomtypepair 2 {digits([self.friction] * 4)}\n"
            f"pair_style {method.pair_style} {model} {settings}\npair_coeff * *\n"
            f"{floor if self.plane else ''}fix integrate all {method.integrator}\n"
        )

    def granular_styles(self, predictor):
        """The same for LAMMPS's pair_style granular. predictor: none for the stock styles."""
        kind, predict, integrator = ("granular", "", "nve/sphere")
        if predictor:
            kind, predict, integrator = ("granular/cfpm", f"predict {predictor}", "nve/cfpm")
        wall = "wall/gran/cfpm granular" if predictor else "wall/gran granular"
        normal = digits([4 / 3 * self.moduli[0], granular_restitution(self.damping)])
        tangential = digits([8 * self.moduli[1], 0.0, self.friction])
        damping = "tsuji" if self.damping else "velocity"
        model = f"hertz {normal} damping {damping} tangential mindlin {tangential}"
        model += "" if self.tension else " limit_damping"
        floor = f"fix floor all {wall} {model} zplane 0.0 NULL\n"
        return (
            f"pair_style {kind} {predict}\npair_coeff * * {model}\n"
            f"{floor if self.plane else ''}fix integrate all {integrator}\n"
        )

    def gran_styles(self, predictor):
        """Likewise for pair_style gran, whose Hertz contacts have a damping of another kind: elastic tests only."""
        pair, wall, integrator = "gran/hertz/history", "wall/gran hertz/history", "nve/sphere"
        if predictor:
            pair, wall, integrator = "gran/cfpm hertz", "wall/gran/cfpm hertz", "nve/cfpm"
        # a wall of LAMMPS 4 Feb 2025 divides by the damping: NaN without any
        damping = 1e-300
        numbers = digits([4 / 3 * self.moduli[0], 8 * self.moduli[1], damping, 0.0, self.friction]) + " 0 limit_damping"
        floor = f"fix floor all {wall} {numbers} zplane 0.0 NULL\n"
        predict = f"predict {predictor}" if predictor else ""
        return (
            f"pair_style {pair} {numbers} {predict}\npair_coeff * *\n"
            f"{floor if self.plane else ''}fix integrate all {integrator}\n"
        )


def granular_restitution(damping):
    """The restitution from which damping "tsuji" of pair_style granular makes this alpha, by the polynomial of Tsuji et
    al. (1992) that the host's page gives; 0, a coefficient of damping "velocity", for none."""
    if not damping:
        return 0.0
    alpha = np.polynomial.Polynomial((1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218))
    return brentq(lambda e: alpha(e) - damping, 0.0, 1.0, xtol=1e-15)


@dataclass(frozen=True)
class Runner:
    """A host with a method. LIGGGHTS: method as in host_collisions; LAMMPS: a predictor or none."""

    host: str
    name: str
    method: object
    granular: bool = False  # LAMMPS's pair_style granular in place of gran

    def __str__(self):
        return f"{self.host} {self.name}"

    def styles(self, test):
        if self.host == "LIGGGHTS":
            return test.styles(self.method)
        return test.granular_styles(self.method) if self.granular else test.gran_styles(self.method)

    def has(self, test):
        """Whether its damping can be the test's."""
        return self.host == "LIGGGHTS" or self.granular or test.restitution == 1.0

    @property
    def program(self):
        if self.host == "LIGGGHTS":
            return self.method.program
        return lammps.LAUNCHER if self.method else lammps.STOCK

    @property
    def stock(self):
        return self.method in (STOCK, None)


@dataclass
class Outcome:
    """Of all impacts of a test with all phases: velocity over the impact speed, surface velocities by spin over it,
    contact time [s], and the deepest overlap that any phase has at the end of a step [m]."""

    velocity: np.ndarray  # (impacts, phases, 3)
    spins: np.ndarray  # (impacts, phases, 2, 3)
    duration: np.ndarray  # (impacts, phases)
    deepest: float


def measure(test, runner, nt):
    dt, steps = test.tc / nt, int(np.ceil(STEPS * nt)) + 2
    every = 1 if nt <= 6 or test.number < 3 else steps  # what the stock style throws may fly into others later on
    cases = test.cases
    host = runner.host.lower()
    flights = impacts.fly(
        runner.styles(test), runner.program, cases, test.material.density, dt, steps, every, host=host
    )
    velocity, spins, duration = flights.after()
    overlap = cases.reach[:, None] - flights.distance
    return Outcome(velocity / test.speed, spins * test.radius / test.speed, duration, overlap.max())


ANGLES = tuple(range(5, 90, 5))
VELOCITIES = (0.1, 0.3, 0.5, 1.0, 2.0, 3.5, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 70.0)
SPINS = (0.175, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 9.0, 12.0, 16.0, 22.0)
PLANE = np.inf
TESTS = (
    *(Test(1, m, 0.01, 0.01, 20.0, 0.35, 1.0) for m in (GLASS, LIMESTONE)),
    *(Test(2, m, 0.1, PLANE, 0.2, 0.0, 1.0) for m in (WROUGHT_ALUMINIUM, MAGNESIUM)),
    *(
        Test(3, m, 0.0025, PLANE, 3.9, 0.0, e, tension=True)
        for m in (ALUMINIUM_OXIDE, CAST_IRON)
        for e in (0.2, 0.4, 0.6, 0.8, 1.0)
    ),
    *(Test(4, m, 0.0025, PLANE, 3.9, 0.092, 0.98, ANGLES) for m in (ALUMINIUM_OXIDE, ALUMINIUM)),
    *(Test(5, m, 1e-5, PLANE, 5.0, 0.3, 1.0, VELOCITIES) for m in (STEEL, POLYETHYLENE)),
    *(Test(6, m, 0.1, PLANE, 0.2, 0.4, 0.5, SPINS) for m in (ALUMINIUM, NYLON)),
    *(Test(7, m, 0.1, 0.1, 0.4, 0.4, 0.5, SPINS) for m in (ALUMINIUM, COPPER)),
    *(Test(8, m, 0.1, 0.5, 0.2, 0.4, 0.5, SPINS) for m in (ALUMINIUM, NYLON)),
)
