# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck: spheres fall into a drum, a floor and a cylinder, predicted contacts all over. SI units."""

import re

CONTACT = {
    "hooke": "hooke 2e4 NULL 100 NULL 0.5 1",
    "hertz": "hertz 1e7 NULL 5e4 NULL 0.5 1",
    "onset": "hooke 2e4 NULL 100 NULL 0.5 1 predict exact onset on",
    "impulse": "hooke 2e4 NULL 100 NULL 0.5 1 predict impulse",
    "split": "hooke 2e4 NULL 100 NULL 0.5 1 predict impulse split 0.5",
}
HALF = 1500


def deck(start, law, pair=True, walls=("zplane 0.0 NULL", "region drum")):
    style = f"pair_style gran/cfpm {CONTACT[law]}\npair_coeff * *" if pair else ""
    contact = re.sub(" (split|onset) .*", "", CONTACT[law])  # these the pair style says for its walls too
    walls = "\n".join(f"fix wall{k} all wall/gran/cfpm {contact} {wall}" for k, wall in enumerate(walls))
    return f"""
units si
atom_style sphere
atom_modify map array sort 0 0
boundary f f f
newton off
comm_modify vel yes
processors * 1 1
{start}
neighbor 0.0005 bin
neigh_modify delay 0
timestep 2e-5
region drum cylinder z 0 0 0.04 -0.01 0.2 units box
{style}
{walls}
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
thermo {HALF}
"""


def half(name):
    columns = "id x y z vx vy vz omegax omegay omegaz fx fy fz"
    return f"""
dump {name} all custom {HALF // 3} {name}.dump {columns}
dump_modify {name} sort id format float %.17g
run {HALF}
"""


FRESH = """region box block -0.05 0.05 -0.05 0.05 -0.01 0.2 units box
create_box 1 box
lattice sc 0.011
region fill cylinder z 0 0 0.034 0.006 0.17 units box
create_atoms 1 region fill
set group all diameter 0.01 density 2500
variable kick atom random(-0.4,0.4,3423)
velocity all set v_kick v_kick v_kick units box"""
