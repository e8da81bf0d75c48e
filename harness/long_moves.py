# SPDX-License-Identifier: GPL-2.0-or-later
"""Two equal spheres of 25 mm, undamped, that meet head-on after moves of a good part of their radius in a step.

The first, at rest by the contact's end, hands its whole velocity to the second.
"""

import re
from math import pi

from harness.decks import box
from harness.output import vectors, read_dump
from harness.spheres import Law, Sphere, digits, reduced_mass, stiffness_material

RADIUS = 0.025  # [m]
DT = 1e-5  # [s]
MASS = reduced_mass(*2 * [Sphere((0, 0, 0), radius=RADIUS, density=800.0)])
STIFFNESS = MASS * (pi / (3.0 * DT)) ** 2  # three steps a contact [N/m]
STEPS = 10
PAIR_STYLES = {
    "liggghts": "gran/cfpm model hooke/stiffness tangential history predict impulse{} absolute_damping on",
    "lammps": "gran/cfpm hooke " + digits(STIFFNESS) + " 0 0 0 0 0 predict impulse{}",
}
TEXT = re.compile(
    r"WARNING: fix nve/cfpm: (\d+) moves of a particle in a step, (\d+) of them by more than its radius, were longer "
    r"than neighbour lists reach; contacts there began late, as with 'onset off'(, or were passed by)?; expected a "
    r"smaller timestep, or (\S+) more of skin in 'neighbor'"
)
FIRST = re.compile(r"WARNING: fix nve/cfpm: from step (\d+) on, particles move farther in a step than neighbour lists")


def deck(host, move, gap, skin, onset="", extra=""):
    """The first moves towards the second by so much in a step and begins that far from touching it [m]."""
    material = stiffness_material({(1, 1): Law(STIFFNESS, 0.0, 0.0, 0.0, 0.0)}) if host == "liggghts" else ""
    line = {"liggghts": "", "lammps": "line "}[host]
    return f"""{box(host)}
create_atoms 1 single {-2 * RADIUS - gap!r} 0 0 units box
create_atoms 1 single 0 0 0 units box
set group all diameter {2 * RADIUS!r} density 800
group first id 1
velocity all set 0 0 0
velocity first set {move / DT!r} 0 0 units box
neighbor {skin} bin
neigh_modify delay 0
timestep {DT!r}
{material}pair_style {PAIR_STYLES[host].format(onset)}
pair_coeff * *
fix integrate all nve/cfpm
{extra}
dump d all custom 1 motion.dump id vx vy vz
dump_modify d sort id format {line}"%d %.17g %.17g %.17g"
run {STEPS}
"""


def velocities(folder):
    """(steps + 1, 2, 3) [m/s]."""
    return [vectors(columns, "vx", "vy", "vz") for _, columns in read_dump(folder / "motion.dump")]
