# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the real LAMMPS, stock or with the plugin; what it writes is read as LIGGGHTS's."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "liggghts"))
import liggghts  # noqa: E402
from liggghts import BUILD, ROOT, read_dump, vectors  # noqa: E402, F401

STOCK = "lmp"
LAUNCHER = str(BUILD / "bin" / "lmp-cfpm")
PRELOAD = str(BUILD / "lib" / "cfpm_lammps_preload.so")
INCLUDE = f"include {BUILD}/lib/cfpm.lammps\n"


def run(deck, cwd, program=LAUNCHER, **options):
    """As liggghts.run(), with this host."""
    return liggghts.run(deck, cwd, program=program, **options)
