# SPDX-License-Identifier: GPL-2.0-or-later
"""A column of spheres on a floor under impulses, which goes on with another step once it rests. SI units.

The contacts are those of inputs/HOST/in.packing, gamma = 1.
"""

from math import pi, sqrt

import numpy as np

from harness import HOSTS
from harness.spheres import Law, Sphere, box, dump, lammps_box, read_motion, stiffness_material, write_data

G = 9.81
TC = 2.0e-4  # of a pair
RADIUS, DENSITY = 0.025, 800.0
COUNT = 10
M = Sphere((0.0, 0.0, 0.0), radius=RADIUS, density=DENSITY).mass
K = M / 2.0 * (pi / TC) ** 2
KS = K / (2.0 * (1.0 + 0.32))
ETA = sqrt(M * K)
LAW = Law(K, ETA, KS, ETA * sqrt(KS / K), 0.3)
UNIT = M * G * 2 * RADIUS * COUNT  # of the kinetic energy: m g d for each sphere


def styles(host):
    """Pair style, floor, integrator."""
    if host == "lammps":
        law = f"hooke {K} {KS} {2 * LAW.hn / M} {2 * LAW.hs / M} {LAW.mu} 1 limit_damping"
        return f"pair_style gran/cfpm {law} predict impulse\nfix floor all wall/gran/cfpm {law} zplane 0.0 NULL\n"
    model = "model hooke/stiffness tangential history"
    settings = "tangential_damping on absolute_damping on limitForce on"
    pair = f"pair_style gran/cfpm {model} predict impulse {settings}\n"
    floor = f"fix floor all wall/gran/cfpm {model} primitive type 1 zplane 0.0 {settings}\n"
    return stiffness_material({(1, 1): LAW, (1, 2): LAW, (2, 2): LAW}) + pair + floor


def energies(host, folder, settled, then, contact_times=450):
    """Kinetic energy at rest after steps of tc/settled, and the largest after that to tc/then [m g d a sphere]."""
    spheres = [Sphere((0.0, 0.0, (2 * k + 1) * RADIUS), radius=RADIUS, density=DENSITY) for k in range(COUNT)]
    write_data(folder / "spheres.data", spheres)
    begin = {"lammps": lammps_box, "liggghts": box}[host](TC / settled)
    columns = ("vx", "vy", "vz")
    deck = f"""{begin}
{styles(host)}
pair_coeff * *
fix gravity all gravity {G} vector 0 0 -1
fix integrate all nve/cfpm
thermo 1000000
run {1000 * settled}
timestep {TC / then!r}
{dump(then, columns=columns, host=host)}run {contact_times * then}
"""
    HOSTS[host].run(deck, folder)
    kinetic = 0.5 * M * np.sum(read_motion(folder / "motion.dump", columns)[1] ** 2, axis=(1, 2)) / UNIT
    return kinetic[0], kinetic.max()
