# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of inputs/ and how they are given their variables; the start of the small decks of the tests. SI units."""

import re
from pathlib import Path

from harness.host import ROOT

VARIABLE = re.compile(r"^variable (\w+) +index (\S+)", re.MULTILINE)
MESH = ROOT / "inputs" / "liggghts" / "meshes" / "floor_with_hole.stl"  # of LIGGGHTS's in.discharge

PARTICLES = {
    "liggghts": "atom_style granular\ncommunicate single vel yes",
    "lammps": "atom_style sphere\ncomm_modify vel yes",
}


def deck(host, name):
    """The file inputs/HOST/in.NAME."""
    return ROOT / "inputs" / host / f"in.{name}"


def options(variables):
    """Of the host's command line: no log file, and variables of the deck; a Path is a file that the deck reads."""
    values = {name: value.resolve() if isinstance(value, Path) else value for name, value in variables.items()}
    return ["-log", "none", *(str(word) for pair in values.items() for word in ("-var", *pair))]


def variables(deck):
    """{name: default} of those that a deck takes from the command line."""
    return dict(VARIABLE.findall(deck.read_text()))


def box(host, newton="off"):
    """All that comes before the particles, of one type: a fixed cube of 2 m around the origin."""
    return f"""
units si
{PARTICLES[host]}
boundary f f f
newton {newton}
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
"""


def two_spheres(host, newton="off", offset=0, velocity="1 0 0", skin=0.01):
    """All that comes before the pair style: two spheres of 50 mm, 2 mm apart.

    The one in group left moves at the velocity [m/s] towards the other, which is at rest, by the offset [m] aside.
    """
    return f"""{box(host, newton)}
create_atoms 1 single -0.026 0 0 units box
create_atoms 1 single 0.026 {offset} 0 units box
set group all diameter 0.05 density 800
group left id 1
velocity all set 0 0 0
velocity left set {velocity} units box
neighbor {skin} bin
timestep 1e-5
"""
