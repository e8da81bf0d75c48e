# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS, stock or with the plugin."""

from harness import host
from harness.host import BUILD

STOCK = "liggghts"
LAUNCHER = str(BUILD / "bin" / "liggghts-cfpm")
PLUGIN = BUILD / "lib" / "cfpm_liggghts.so"
PRELOAD = str(BUILD / "lib" / "cfpm_liggghts_preload.so")


def run(deck, cwd, program=LAUNCHER, **options):
    """As host.run(), with this host."""
    return host.run(program, deck, cwd, **options)
