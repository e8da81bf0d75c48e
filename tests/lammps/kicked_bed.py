# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck for the stock pair style and "predict none": two sizes of spheres fall on a wall while contacts cross periodic
faces and the border between two ranks. SI units."""

import re

from harness.lammps import LAUNCHER, STOCK, run
from harness.output import rebuilds

STEPS = 5000
LAWS = {
    "hooke": "2e4 NULL 100 NULL 0.5 1",
    "hertz": "1e7 NULL 5e4 NULL 0.5 1 limit_damping",
    "hooke_given": "2e4 8e3 100 70 0.4 0",
    "hooke/nohistory": "2e4 NULL 100 NULL 0.5 1",
}


def bed(style, newton, before="", after=f"run {STEPS}"):
    return f"""
units si
atom_style sphere
boundary p p f
newton {newton}
comm_modify vel yes
processors * 1 1
region box block 0 0.099 0 0.099 -0.01 0.2 units box
create_box 2 box
lattice sc 0.011
region fill block 0 0.0989 0 0.0989 0.008 0.1 units box
create_atoms 1 region fill
set group all diameter 0.01 density 2500
set group all type/fraction 2 0.4 8123
set type 2 diameter 0.006
variable kick atom random(-0.8,0.8,3423)
velocity all set v_kick v_kick v_kick units box
neighbor 0.0005 bin
neigh_modify delay 0
timestep 2e-5
{before}
pair_style {style}
pair_coeff * *
fix gravity all gravity 9.81 vector 0 0 -1
fix floor all wall/gran hooke/history 2e4 NULL 100 NULL 0.5 1 zplane 0.0 NULL
fix integrate all nve/sphere
thermo_style custom step ke press
thermo 500
dump bed all custom 1000 bed.dump id type x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz
dump_modify bed sort id format float %.17g
{after}
"""


def stock_style(law):
    model = "hooke" if law == "hooke/nohistory" else f"{law.split('_')[0]}/history"
    return f"gran/{model} {LAWS[law]}"


def cfpm_style(law):
    return f"gran/cfpm {law.split('_')[0]} {LAWS[law]} predict none"


def fall(folder, program, deck, ranks=1):
    """Every digit of the particles, and the thermo table."""
    folder.mkdir()
    output = run(deck, folder, program=program, np=ranks).stdout
    assert rebuilds(output)[0] > 50
    table = re.findall(r"^ +(\d+ +\S+ +\S+) *$", output, re.MULTILINE)
    assert len(table) == STEPS // 500 + 1
    return (folder / "bed.dump").read_text(), table


def assert_equal(folder, stock_deck, cfpm_deck, ranks):
    """Returns the dump of both."""
    stock = fall(folder / "stock", STOCK, stock_deck, ranks)
    cfpm = fall(folder / "cfpm", LAUNCHER, cfpm_deck, ranks)
    assert stock[1] == cfpm[1], "thermo output differs from stock"
    same = stock[0] == cfpm[0]  # not compared in the assert: its report of a difference would take minutes
    assert same, "particles differ from stock"
    return stock[0]
