# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests and the exhibits share: running the real hosts, the decks that several of them run, their output."""

from harness import lammps, liggghts

HOSTS = {"liggghts": liggghts, "lammps": lammps}  # by the names that ./cfpm run takes
