# SPDX-License-Identifier: GPL-2.0-or-later
"""Every way into the stock binary, in serial and on 2 ranks, again after the command "clear"."""

import re
import subprocess

import pytest
from lammps import BUILD, INCLUDE, LAUNCHER, PRELOAD, STOCK, run

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
WAYS = {
    "launcher": (LAUNCHER, {}, ""),
    "preload": (STOCK, {"LD_PRELOAD": PRELOAD}, ""),
    "include": (STOCK, {}, INCLUDE),
}


def energies(output):
    """Kinetic energy at the end of every run."""
    return [float(ke) for ke in re.findall(r"^ +1000 +(\S+)", output, re.MULTILINE)]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("way", WAYS)
def test_styles_are_there(tmp_path, way, ranks):
    program, env, line = WAYS[way]
    deck = line + COLLISION + "clear\n" + line + COLLISION
    found = energies(run(deck, tmp_path, program=program, env=env, np=ranks).stdout)
    assert len(found) == 2 and found[0] == found[1]
    start = 0.5 * 800 * 3.141592653589793 / 6 * 0.05**3
    assert 0.5 * start < found[0] < start  # they met, and half of the energy stays with the centre of mass


def test_stock_has_no_such_style(tmp_path):
    process = run(COLLISION, tmp_path, program=STOCK, check=False)
    assert process.returncode != 0 and "Unrecognized pair style 'gran/cfpm'" in process.stdout


def test_entry_of_the_command_plugin(tmp_path):
    """This host has no command "plugin"; its entry is called as that command calls it."""
    deck = (BUILD / "lib" / "cfpm.lammps").read_text()
    deck = deck.replace("(address(lammps, name(lammps)))", "(address(lammps, name(lammps)), None, None)")
    deck = deck.replace("argtypes = [ctypes.c_void_p]", "argtypes = 3 * [ctypes.c_void_p]")
    deck = deck.replace("cfpm_register", "lammpsplugin_init")
    assert len(energies(run(deck + COLLISION, tmp_path, program=STOCK).stdout)) == 1


def test_exports_no_more_than_its_entries():
    table = subprocess.run(
        ["nm", "-D", "--defined-only", BUILD / "lib" / "cfpm_lammps.so"], capture_output=True, text=True, check=True
    ).stdout
    assert sorted(line.split()[-1] for line in table.splitlines()) == ["cfpm_register", "lammpsplugin_init"]
