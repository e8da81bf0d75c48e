# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts of spheres by small steps of an integrator of high order, apart from the host and from the plugin.

The law, with the overlap d, the closing speed u = d', the normal n along the line of centres or across the wall, the
slip velocity w of the surfaces at the middle of the overlap and the tangential spring xi:

    normal      fn = max(0, kn d^a1 + hn d^a2 u)                            a1, a2 = 1, 0      Hertz: 3/2, 1/4
    tangential  fs = -(ks d^a3 xi + hs d^a4 w)                              a3, a4 = 0, 0      Hertz: 1/2, 1/4
    spring      xi' = w, xi turns with the normal, and ks d^a3 |xi| <= mu fn; where it is at that limit, without hs

No force remembers anything but xi; the contact begins with xi = 0.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(eq=False)
class Impacts:
    """Of many pairs of spheres or spheres on a wall: arrays with a row for each. All touch at time 0.

    The normal at the touch is z; it points from the second body, or the wall, to the first sphere.
    """

    radii: np.ndarray  # of the two (impacts, 2) [m]; of a wall infinite, and so is its mass
    masses: np.ndarray  # [kg]
    velocity: np.ndarray  # of the first against the second (impacts, 3) [m/s]
    spins: np.ndarray  # (impacts, 2, 3) [rad/s]

    def __len__(self):
        return len(self.velocity)

    @property
    def wall(self):
        return np.isinf(self.radii[:, 1])

    @property
    def reduced_mass(self):
        return 1 / np.sum(1 / self.masses, axis=1)

    @property
    def reduced_radius(self):
        return 1 / np.sum(1 / self.radii, axis=1)

    @property
    def reach(self):
        """Distance of the centres, or of the centre from the wall, at the touch."""
        return np.where(self.wall, self.radii[:, 0], np.sum(self.radii, axis=1))


def final(impacts, laws, dt, most):
    """Velocity and both spins after the impact, (impacts, 9). laws: of each, see spheres.Law; dt: one, or of each.

    most: of steps. Runge and Kutta's method of fourth order; the spring is turned and slackened after every step.
    """
    wall = impacts.wall[:, None]
    kn, hn, ks, hs, mu = (np.array([[getattr(law, name)] for law in laws]) for name in ("kn", "hn", "ks", "hs", "mu"))
    hertz = laws[0].form == "hertz"
    mass, reach = impacts.reduced_mass[:, None], impacts.reach[:, None]
    inertia = 0.4 * np.where(np.isinf(impacts.radii), np.inf, impacts.masses * impacts.radii**2)[..., None]
    radii = np.where(np.isinf(impacts.radii), 0.0, impacts.radii)[..., None]  # a wall does not turn
    dt = np.reshape(dt, (-1, 1))
    up = np.array([0.0, 0.0, 1.0])

    def contact(place):
        distance = np.where(wall, place[:, 2:], np.linalg.norm(place, axis=1, keepdims=True))
        return reach - distance, np.where(wall, up, place / distance)

    def at(place, velocity, spins):
        """Normal, levers, slip velocity, normal force, and stiffness and damping across it."""
        d, n = contact(place)
        touching = d >= 0
        d = np.maximum(d, 0.0)
        root = np.sqrt(d) if hertz else 1.0
        fourth = np.sqrt(root)
        u = -np.sum(velocity * n, axis=1, keepdims=True)
        levers = radii - np.where(radii > 0, d[:, None] / 2, 0.0)
        slip = velocity + u * n + np.cross(n, np.sum(levers * spins, axis=1))
        force = np.where(touching, np.maximum(0.0, kn * root * d + hn * fourth * u), 0.0)
        return n, levers, slip, force, ks * root, hs * fourth

    def slackened(vector, limit):
        size = np.linalg.norm(vector, axis=1, keepdims=True)
        return vector * np.where(size > limit, limit / np.maximum(size, 1e-300), 1.0)

    def rates(place, velocity, spins, spring):
        n, levers, slip, force, stiffness, damping = at(place, velocity, spins)
        spring = spring - np.sum(spring * n, axis=1, keepdims=True) * n
        pull = stiffness * spring
        slides = np.linalg.norm(pull, axis=1, keepdims=True) >= (1 - 1e-9) * mu * force
        friction = -np.where(slides, slackened(pull, mu * force), pull + damping * slip)
        torques = -levers * np.cross(n, friction)[:, None]
        return velocity, (force * n + friction) / mass, torques / inertia, slip

    state = [reach * up, impacts.velocity, impacts.spins, np.zeros_like(impacts.velocity)]
    times = [dt, dt, dt[:, None], dt]
    for _ in range(most):
        slopes = [rates(*state)]
        for part in (0.5, 0.5, 1.0):
            slopes.append(rates(*(y + part * h * slope for y, h, slope in zip(state, times, slopes[-1]))))
        state = [y + h / 6 * (a + 2 * b + 2 * c + d) for y, h, a, b, c, d in zip(state, times, *slopes)]
        place, velocity, spins, spring = state
        n, _, _, force, stiffness, _ = at(place, velocity, spins)
        spring = spring - np.sum(spring * n, axis=1, keepdims=True) * n
        state[3] = slackened(spring, mu * force / np.clip(stiffness, 1e-300, None))
        if np.all(contact(place)[0] < 0):
            return np.hstack([velocity, spins.reshape(-1, 6)])
    raise RuntimeError("the reference is still in contact")
