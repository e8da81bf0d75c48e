# SPDX-License-Identifier: GPL-2.0-or-later
"""Two spheres, one at rest, that meet head-on."""

import re

from harness.decks import two_spheres

COLLISION = two_spheres("lammps") + """
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
