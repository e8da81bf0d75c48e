# SPDX-License-Identifier: GPL-2.0-or-later
"""A cloud of spheres without gravity and walls that flies into itself: nothing but contacts changes their motion."""

import numpy as np

from harness.spheres import Law, Sphere, contact_time, reduced_mass

LAW = Law(kn=2.0e4, hn=1.0, ks=8.0e3, hs=0.5, mu=0.4)


def cloud():
    """216 spheres of random size around a lattice, the outer ones on their way inwards."""
    random = np.random.default_rng(20050101)
    sites = np.stack(np.meshgrid(*3 * [np.arange(6) - 2.5]), axis=-1).reshape(-1, 3)
    return [
        Sphere(
            x=tuple(0.045 * site + random.uniform(-0.002, 0.002, 3)),
            v=tuple(random.uniform(-2.0, 2.0, 3) - 0.8 * site + 0.5),
            omega=tuple(random.uniform(-100.0, 100.0, 3)),
            radius=random.uniform(0.012, 0.02),
            density=random.uniform(800.0, 3000.0),
        )
        for site in sites
    ]


CLOUD = cloud()
CLOUD_DT = contact_time(LAW, reduced_mass(*2 * [min(CLOUD, key=lambda s: s.mass)])) / 6.0  # [s]
