# SPDX-License-Identifier: GPL-2.0-or-later
"""Materials of the colliding spheres in the host: one type of particle for every restitution."""

from functools import cached_property

import numpy as np

from contact_law import ContactLaw
from host_collisions import BALL
from harness.spheres import Law, digits, reduced_mass, stiffness_material

MASS = reduced_mass(BALL, BALL)
SPEED = 1.0  # normal part of the impact velocity [m/s]
FRICTION = 0.3
POISSON = 0.32  # as the paper's ice; the stiffness of its linear contact, but a softer material than ice


class Material:
    """restitutions: without tension, one for each type; damping: the constants c of ContactLaw that give them."""

    law: ContactLaw
    restitutions: tuple
    stiffness: float

    @cached_property
    def damping(self):
        return [self.law.damping(e) for e in self.restitutions]

    @cached_property
    def unit_time(self):
        """Of ContactLaw, [s]."""
        return (MASS * SPEED**2 / self.stiffness) ** (1 / self.law.p) / SPEED

    @cached_property
    def durations(self):
        """Contact times [s]."""
        return np.array([self.unit_time * self.law.duration(c) for c in self.damping])

    @cached_property
    def contact_time(self):
        """Of the undamped contact [s]: nt steps of it."""
        return self.unit_time * self.law.duration(0.0)


class Hooke(Material):
    name = "Hooke"
    model = "hooke/stiffness"
    settings = "absolute_damping on"
    predictors = ("exact", "trapezoid", "rk2", "rk4")
    law = ContactLaw(1.0)
    restitutions = (0.2, 0.5, 0.9, 1.0)
    stiffness = 2.3e6  # [N/m]

    def deck(self):
        kt = self.stiffness / (2 * (1 + POISSON))
        unit = np.sqrt(MASS * self.stiffness)
        laws = [Law(self.stiffness, c * unit, kt, 0.0, FRICTION) for c in self.damping]
        return stiffness_material({(i, j): laws[i - 1] for i in range(1, 5) for j in range(i, 5)})


class Hertz(Material):
    name = "Hertz"
    model = "hertz"
    settings = ""
    predictors = ("rk2", "rk4")
    law = ContactLaw(1.5)
    restitutions = (0.25, 0.5, 0.9, 1.0)  # the host refuses a coefficient below 0.05, which means 0.2137 here
    young = 1.0e9  # [Pa]
    stiffness = 4 / 3 * young / (2 * (1 - POISSON**2)) * np.sqrt(BALL.radius / 2)  # [N/m^1.5]

    def deck(self):
        coefficients = self.law.coefficient(np.array(self.damping))
        types = len(coefficients)
        return (
            f"fix Y all property/global youngsModulus peratomtype {digits([self.young] * types)}\n"
            f"fix nu all property/global poissonsRatio peratomtype {digits([POISSON] * types)}\n"
            "fix e all property/global coefficientRestitution peratomtypepair "
            f"{types} {digits(np.minimum.outer(coefficients, coefficients).ravel())}\n"
            f"fix mu all property/global coefficientFriction peratomtypepair {types} {digits([FRICTION] * types**2)}\n"
        )
