# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of both launchers share: for each host a stock deck that -suffix cfpm predicts."""

from harness.decks import two_spheres

PREDICTED = "gran/cfpm: predict auto"  # what the plugin says at the start of a predicted run

LAMMPS_DECK = two_spheres("lammps") + """
pair_style gran/hooke/history 1e5 NULL 100 NULL 0.3 1
pair_coeff * *
fix integrate all nve/sphere
run 10
"""
LIGGGHTS_DECK = two_spheres("liggghts") + """
fix young all property/global youngsModulus peratomtype 5e6
fix poisson all property/global poissonsRatio peratomtype 0.45
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.9
fix friction all property/global coefficientFriction peratomtypepair 1 0.3
fix speed all property/global characteristicVelocity scalar 2.0
pair_style gran model hooke tangential history
pair_coeff * *
fix integrate all nve/sphere
run 10
"""
DECKS = {"liggghts": LIGGGHTS_DECK, "lammps": LAMMPS_DECK}
