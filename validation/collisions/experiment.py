# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs of spheres that collide in the host, head-on and at 45 degrees, and what is known of them exactly."""

from dataclasses import replace

import numpy as np

from host_collisions import BALL, DIAMETER, HALVED, PHASES, STOCK, centres, cfpm, collide, small_step_limit
from materials import SPEED

IMPACTS = (0.0, SPEED)  # tangential part of the impact velocity: head-on, 45 degrees
IMPACT_SPEED = np.hypot(SPEED, SPEED)  # of the oblique one
QUANTITIES = ("restitution", "duration", "oblique restitution", "oblique duration", "tangential", "spin")


def new(material):
    """The predictor that stands for the method."""
    return cfpm("exact" if "exact" in material.predictors else "rk4")


def methods(material):
    return [STOCK, *map(cfpm, material.predictors)]


def order(material, method):
    """Of the error in the step: the stock style's damping sees velocities that are half a step old; a contact that is
    found late misses the impulse of its damping until then, the integral of d^a2 u."""
    return 1 if method == STOCK else material.law.p / 2


def pairs(material, dt, phases):
    """Two spheres for every restitution, impact and phase; they touch along x."""
    spheres = []
    cases = [(t, slip, phase) for t in range(len(material.damping)) for slip in IMPACTS for phase in phases]
    for centre, (t, slip, phase) in zip(centres(len(cases)), cases):
        for side in (-1, 1):
            v = -0.5 * side * np.array([SPEED, slip, 0.0])
            x = centre + [side * BALL.radius, 0.0, 0.0] - phase * dt * v
            spheres.append(replace(BALL, x=tuple(x), v=tuple(v), type=t + 1))
    return spheres


def measure(material, method, nt, phases=PHASES):
    """{quantity: (restitution, phase)}: of both pairs the restitution along the normal at the touch, and the contact
    time over the undamped one; of the oblique pair the velocity across that normal, and of the surface by spin, over
    the impact speed."""
    dt = material.contact_time / nt
    steps = int(np.ceil(3 * nt)) + 10  # of a contact time and a half, and of what late release adds at few steps
    spheres = pairs(material, dt, phases)
    model, settings = f"{material.model} tangential history", f"tangential_damping off {material.settings}"
    motion, pushed = collide(method, model, settings, material.deck(), spheres, dt, steps)
    motion = motion.reshape(len(material.damping), len(IMPACTS), len(phases), 2, 9)
    pushed = pushed.reshape(motion.shape[:-1])
    first, second = motion[..., 0, :], motion[..., 1, :]
    distance = np.linalg.norm(second[..., :3] - first[..., :3], axis=-1)
    assert np.all(distance > DIAMETER), f"{method.name}, nt = {nt}: still in contact"
    apart = (second - first)[..., 3:6]
    spin = (first + second)[..., 8] * BALL.radius
    return {
        "restitution": apart[:, 0, :, 0] / SPEED,
        "duration": pushed[:, 0, :, 0] / nt,
        "oblique restitution": apart[:, 1, :, 0] / SPEED,
        "oblique duration": pushed[:, 1, :, 0] / nt,
        "tangential": -apart[:, 1, :, 1] / IMPACT_SPEED,
        "spin": spin[:, 1] / IMPACT_SPEED,
    }


def references(material, nt):
    """Exact {quantity: (restitution,)} and the error of each: closed forms, and for the oblique impact tiny steps."""
    middle = np.array([0.5])  # the spring of a new contact begins with the slip of half a step
    coarse, fine = (measure(material, new(material), n, middle) for n in (nt // 2, nt))
    exact = {q: fine[q][:, 0] for q in QUANTITIES}
    error = {q: np.abs(fine[q] - coarse[q])[:, 0] for q in QUANTITIES}
    exact["restitution"] = np.array(material.restitutions)
    exact["duration"] = material.durations / material.contact_time
    error["restitution"] = error["duration"] = np.zeros(len(material.restitutions))
    return exact, error


def late_detection(material, c, nt):
    """Mean restitution if nothing were wrong but that contacts are found late."""
    overlaps = PHASES * material.contact_time / nt / material.unit_time
    return np.mean([material.law.found_late(c, d) for d in overlaps])


def phase_error(samples, jump=0.0):
    """Bound of the error of a mean over n phases by Koksma's inequality: the variation over 2n.

    It matters for what changes by jumps, as at the onset of sliding. jump: what may come and go between two phases.
    """
    n = len(PHASES)
    variation = np.abs(np.diff(samples)).sum(axis=-1) * n / (n - 1)  # the ends of the step included
    return (variation + 2 * jump) / (2 * n)


class Outcome:
    """What all methods made of one material. results: {(method, nt): what measure() returns}."""

    def __init__(self, material, results, exact, exact_error):
        self.material, self.results, self.exact, self.exact_error = material, results, exact, exact_error
        self.methods = list(dict.fromkeys(method for method, _ in results))

    def off(self, quantity, method, nt):
        """Errors: (restitution, phase)."""
        return self.results[method, nt][quantity] - self.exact[quantity][:, None]

    def mean(self, quantity, method, nt):
        return self.off(quantity, method, nt).mean(axis=1)

    def rms(self, quantity, method, nt):
        return np.sqrt(np.mean(self.off(quantity, method, nt) ** 2, axis=1))

    def limit(self, quantity, method):
        """Error of what the phase means tend to for small steps, and its bound."""
        q = order(self.material, method)
        jumps = [1 / nt if "duration" in quantity else 0.0 for nt in HALVED]  # a step more or less is counted
        samples = [self.off(quantity, method, nt) for nt in HALVED]
        limit, change = small_step_limit(*(s.mean(axis=1) for s in samples), q)
        _, middle, fine = (phase_error(s, jump) for s, jump in zip(samples, jumps))
        return np.abs(limit), change + (2**q * fine + middle) / (2**q - 1) + self.exact_error[quantity]
