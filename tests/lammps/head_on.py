# SPDX-License-Identifier: GPL-2.0-or-later
"""Two spheres, one at rest, that meet head-on: the smallest deck with a contact."""

import re

COLLISION = """
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
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
pair_style gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1
pair_coeff * *
fix integrate all nve/cfpm
thermo_style custom step ke
thermo 1000
run 1000
"""


def energies(output):
    """Kinetic energy at the end of every run."""
    return [float(ke) for ke in re.findall(r"^ +1000 +(\S+)", output, re.MULTILINE)]
