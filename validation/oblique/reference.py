# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts of spheres by small steps of an integrator of high order, apart from the host and from the plugin.

The law, with the overlap d, the closing speed u = d', the normal n along the line of centres or across the wall, the
slip velocity w of the surfaces at the middle of the overlap and the tangential spring xi:

    normal      fn = max(0, kn d^a1 + hn d^a2 u)                            a1, a2 = 1, 0      Hertz: 3/2, 1/4
    tangential  fs = -(ks d^a3 xi + hs d^a4 w), |fs| <= mu fn as a whole    a3, a4 = 0, 0      Hertz: 1/2, 1/4
    spring      xi' = w, xi turns with the normal, and ks d^a3 |xi| <= mu fn

No force remembers anything but xi; the contact begins with xi = 0.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(eq=False)
class Impacts:
    """Of many pairs of equal spheres or spheres on a wall: arrays with a row for each. All touch at time 0.

    The normal at the touch is z; it points from the second body, or the wall, to the first sphere.
    """

    wall: np.ndarray  # bool
    velocity: np.ndarray  # of the first against the second (impacts, 3) [m/s]
    spin: np.ndarray  # of every sphere (impacts, 3) [rad/s]

    def __len__(self):
        return len(self.wall)


def final(impacts, laws, ball, dt, most):
    """Velocity and spin after the impact, (impacts, 6). laws: (for pairs, for walls), see spheres.Law.

    most: of steps. Runge and Kutta's method of fourth order; the spring is turned and slackened after every step.
    """
    wall = impacts.wall[:, None]
    names = ("kn", "hn", "ks", "hs")
    kn, hn, ks, hs = (np.where(wall, getattr(laws[1], name), getattr(laws[0], name)) for name in names)
    mu, hertz = laws[0].mu, laws[0].form == "hertz"
    mass = np.where(wall, ball.mass, ball.mass / 2)
    inertia = 0.4 * ball.mass * ball.radius**2
    reach = np.where(wall, ball.radius, 2 * ball.radius)
    up = np.array([0.0, 0.0, 1.0])

    def contact(place):
        distance = np.where(wall, place[:, 2:], np.linalg.norm(place, axis=1, keepdims=True))
        return reach - distance, np.where(wall, up, place / distance)

    def at(place, velocity, spin):
        """Normal, lever, slip velocity, normal force, and stiffness and damping across it."""
        d, n = contact(place)
        touching = d >= 0
        d = np.maximum(d, 0.0)
        root = np.sqrt(d) if hertz else 1.0
        fourth = np.sqrt(root)
        u = -np.sum(velocity * n, axis=1, keepdims=True)
        lever = ball.radius - d / 2
        slip = velocity + u * n + np.cross(n, np.where(wall, 1, 2) * lever * spin)
        force = np.where(touching, np.maximum(0.0, kn * root * d + hn * fourth * u), 0.0)
        return n, lever, slip, force, ks * root, hs * fourth

    def slackened(vector, limit):
        size = np.linalg.norm(vector, axis=1, keepdims=True)
        return vector * np.where(size > limit, limit / np.maximum(size, 1e-300), 1.0)

    def rates(place, velocity, spin, spring):
        n, lever, slip, force, stiffness, damping = at(place, velocity, spin)
        spring = spring - np.sum(spring * n, axis=1, keepdims=True) * n
        friction = slackened(-(stiffness * spring + damping * slip), mu * force)
        return velocity, (force * n + friction) / mass, -lever * np.cross(n, friction) / inertia, slip

    state = [reach * up, impacts.velocity, impacts.spin, np.zeros_like(impacts.velocity)]
    for _ in range(most):
        slopes = [rates(*state)]
        for part in (0.5, 0.5, 1.0):
            slopes.append(rates(*(y + part * dt * slope for y, slope in zip(state, slopes[-1]))))
        state = [y + dt / 6 * (a + 2 * b + 2 * c + d) for y, a, b, c, d in zip(state, *slopes)]
        place, velocity, spin, spring = state
        n, _, _, force, stiffness, _ = at(place, velocity, spin)
        spring = spring - np.sum(spring * n, axis=1, keepdims=True) * n
        state[3] = slackened(spring, mu * force / stiffness.clip(1e-300))
        if np.all(contact(place)[0] < 0):
            return np.hstack([velocity, spin])
    raise RuntimeError("the reference is still in contact")
