# SPDX-License-Identifier: GPL-2.0-or-later
"""One contact without tension, Eq. 2 with a2 = (a1 - 1)/2: linear (a1 = 1), or Hertz with Tsuji's damping (a1 = 3/2).

In units of the reduced mass, the impact speed and the length L with k L^(a1 + 1) = m* u0^2 it is

    d'' = -d^a1 - c d^a2 d',   d(0) = 0,   d'(0) = 1,

and ends when the force is zero. For this a2 the shape of the trajectory depends on s = d'/d^(p/2) alone, p = a1 + 1,
which gives the restitution in closed form. c is 2 zeta for the linear law and Tsuji's alpha for Hertz.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


@dataclass(frozen=True)
class ContactLaw:
    a1: float

    @property
    def p(self):
        return self.a1 + 1

    def _decay(self, c, s):
        """Logarithm of the speed lost by damping since the touch, where s was infinite."""
        root = np.sqrt(2 * self.p - c**2)
        return c / root * (np.pi / 2 - np.arctan((self.p * s + c) / root))

    def restitution(self, c):
        """The force is zero at s = -1/c."""
        return np.exp(-self._decay(c, -1 / c)) if c > 0 else 1.0

    def damping(self, restitution):
        """The c with this restitution."""
        if restitution == 1:
            return 0.0
        return brentq(lambda c: self.restitution(c) - restitution, 1e-9, 0.999 * np.sqrt(2 * self.p), xtol=1e-15)

    def damping_with_tension(self, restitution):
        """The c with this restitution if the contact ends where the bodies part, s -> -infinity."""
        if restitution == 1:
            return 0.0
        ratio = -np.log(restitution) / np.pi
        return np.sqrt(2 * self.p) * ratio / np.sqrt(1 + ratio**2)

    def coefficient(self, c):
        """Restitution of a contact with this c that ends where the bodies part: what coefficientRestitution says."""
        return np.exp(-np.pi * c / np.sqrt(2 * self.p - c**2))

    def duration(self, c):
        """Time from the touch until the force is zero."""

        def motion(_, y):
            d, u = max(y[0], 0.0), y[1]
            return [u, -(d**self.a1) - c * d ** ((self.a1 - 1) / 2) * u]

        def force(_, y):
            """Over d^a2, so that it changes sign."""
            return np.sign(y[0]) * abs(y[0]) ** (self.p / 2) + c * y[1]

        force.terminal, force.direction = True, -1
        return solve_ivp(motion, (0, 10), [0, 1], events=force, rtol=1e-10, atol=1e-12).t_events[0][0]

    def found_late(self, c, overlap):
        """Restitution of a contact that is exact once it is found, at this overlap and still with its impact speed."""
        s = overlap ** (-self.p / 2)
        energy = 1 + 2 / self.p * (overlap**self.p + c * overlap ** (self.p / 2))
        return self.restitution(c) * np.sqrt(energy) * np.exp(self._decay(c, s))
