# SPDX-License-Identifier: GPL-2.0-or-later
"""In a two-dimensional box the particles are discs, I = 1/2 m r^2.

Two discs collide obliquely. Their angular momentum drifts by what test_conservation.py derives, first order in the
step; with the inertia of a sphere it would miss a part of the spin that no step makes up for.
"""

import numpy as np
from harness.liggghts import run
from harness.output import read_dump

DECK = """
units si
atom_style granular
atom_modify map array
dimension 2
boundary f f p
newton off
communicate single vel yes
region box block -0.2 0.2 -0.2 0.2 -0.001 0.001 units box
create_box 1 box
create_atoms 1 single -0.0255 0.004 0 units box
create_atoms 1 single 0.0255 -0.004 0 units box
set group all diameter 0.05 density 800
group left id 1
group right id 2
velocity left set 1.0 0.3 0 units box
velocity right set -1.0 0 0 units box
neighbor 0.005 bin
neigh_modify delay 0
timestep {dt}
fix kn all property/global kn peratomtypepair 1 6.46e5
fix kt all property/global kt peratomtypepair 1 2.4e5
fix gn all property/global gamman_abs peratomtypepair 1 20
fix gt all property/global gammat_abs peratomtypepair 1 12
fix mu all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran/cfpm model hooke/stiffness tangential history absolute_damping on
pair_coeff * *
fix integrate all nve/cfpm
fix plane all enforce2d
dump motion all custom {steps} motion.dump id x y vx vy omegaz radius mass
dump_modify motion format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g"
run {steps}
"""
DURATION = 6.0e-3  # the contact takes 3.5e-3 s


def drift(folder, dt):
    """Change of angular momentum over the collision, for discs and for spheres."""
    run(DECK.format(dt=dt, steps=round(DURATION / dt)), folder)

    def angular_momentum(c, inertia):
        orbital = c["x"] * c["vy"] - c["y"] * c["vx"]
        return np.sum(c["mass"] * (orbital + inertia * c["radius"] ** 2 * c["omegaz"]))

    (_, before), (_, after) = read_dump(folder / "motion.dump")
    assert np.all(np.abs(after["omegaz"]) > 1.0), "the discs were to gain spin"
    return [angular_momentum(after, inertia) - angular_momentum(before, inertia) for inertia in (0.5, 0.4)]


def test_discs_conserve_angular_momentum(tmp_path):
    coarse, fine = drift(tmp_path, 4.0e-6), drift(tmp_path, 2.0e-6)
    # first order: the ratio is 2, off by the next order, about dt/tc
    assert abs(coarse[0] / fine[0] - 2.0) < 0.05
    assert abs(fine[1]) > 100.0 * abs(fine[0])
