# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS, stock or with the plugin."""

import functools
import re
import tempfile
from datetime import datetime

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


@functools.lru_cache
def version():
    """As the number that LAMMPS itself makes of it: 20250204 of 4 Feb 2025."""
    with tempfile.TemporaryDirectory() as folder:
        said = re.search(r"LAMMPS \((\d+ \w+ \d+)", run("", folder, program=STOCK).stdout)
    return int(datetime.strptime(said[1], "%d %b %Y").strftime("%Y%m%d"))
