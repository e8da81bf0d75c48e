# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS, stock or with the plugin."""

from harness import host
from harness.host import BUILD

STOCK = "lmp"
LAUNCHER = str(BUILD / "bin" / "lmp-cfpm")
PLUGIN = BUILD / "lib" / "cfpmplugin.so"
PRELOAD = str(BUILD / "lib" / "cfpm_lammps_preload.so")
INCLUDE = f"include {BUILD}/lib/cfpm.lammps\n"  # at the start of a deck for the stock program


def run(deck, cwd, program=LAUNCHER, **options):
    """As host.run(), with this host."""
    return host.run(program, deck, cwd, **options)
