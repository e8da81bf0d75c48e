# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of both launchers share: the two hosts and, for each, a stock deck that -suffix cfpm predicts."""

import sys
from pathlib import Path

for host in ("lammps", "liggghts"):
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / host))
import lammps  # noqa: E402
import liggghts  # noqa: E402
from lammps import BUILD, ROOT  # noqa: E402, F401

HOSTS = {"liggghts": liggghts, "lammps": lammps}
PLUGINS = {"liggghts": "cfpm_liggghts.so", "lammps": "cfpmplugin.so"}
PREDICTED = "gran/cfpm: predict exact"  # what the plugin says at the start of a predicted run

START = """
units si
boundary f f f
newton off
{atoms}
{communication}
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
create_atoms 1 single -0.026 0 0 units box
create_atoms 1 single 0.026 0 0 units box
set group all diameter 0.05 density 800
group left id 1
velocity all set 0 0 0
velocity left set 1 0 0 units box
neighbor 0.01 bin
timestep 1e-5
"""
LAMMPS_DECK = START.format(atoms="atom_style sphere", communication="comm_modify vel yes") + """
pair_style gran/hooke/history 1e5 NULL 100 NULL 0.3 1
pair_coeff * *
fix integrate all nve/sphere
run 10
"""
LIGGGHTS_DECK = START.format(atoms="atom_style granular", communication="communicate single vel yes") + """
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
