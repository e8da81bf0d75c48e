# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of stock with the law as the host documents it.

The walls hooke/history of LAMMPS 4 Feb 2025 multiply Kt with the contact radius, as is right for hertz only; releases
before and since do not (the constructor of its linear_history_classic sets contact_radius_flag). There, fix wall/gran
granular has the documented law.
"""

import re

import pytest
from harness.lammps import version


HAVE_ANOTHER_LAW = version() == 20250204


def skip_if_another_law():
    """Where contacts at a wall hooke/history are the host's own and expected to be what they are documented as."""
    if HAVE_ANOTHER_LAW:
        pytest.skip("walls hooke/history of this LAMMPS have another law than the documented one")


def skip_if_removed(shape):
    """Newer hosts have a region in place of zcylinder."""
    if shape.startswith("zcylinder") and version() >= 20260704:
        pytest.skip("this LAMMPS has no zcylinder to compare with")


def granular(wall):
    """The words of fix wall/gran granular for those of hooke/history."""
    start, kn, kt, gamma_n, gamma_t, mu, dampflag = wall.groups()
    kt = float(kn) * 2 / 7 if kt == "NULL" else float(kt)
    over_gamma_n = 0.5 if gamma_t == "NULL" else float(gamma_t) / float(gamma_n)
    tangential = f"linear_history {kt!r} {over_gamma_n * int(dampflag)!r} {mu}"
    return f"{start}granular hooke {kn} {gamma_n} damping mass_velocity tangential {tangential}"


def documented(deck):
    """The deck, with walls hooke/history written as granular where the host's would have another law."""
    if not HAVE_ANOTHER_LAW:
        return deck
    return re.sub(r"(wall/gran\S* )hooke/history" + 5 * r" (\S+)" + r" ([01])", granular, deck)
