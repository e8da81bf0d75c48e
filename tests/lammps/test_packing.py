# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/lammps/in.packing beside inputs/liggghts/in.packing: same variables, same columns, a bed of the same kind."""

import numpy as np
import pytest
from harness import HOSTS
from harness.decks import deck, options, variables
from harness.lammps import run


def pack(folder, ranks=1, **variables):
    run(deck("lammps", "packing"), folder, np=ranks, options=options(variables))
    return np.genfromtxt(folder / "packing.csv", delimiter=",", names=True)


def test_decks_take_the_same_variables():
    taken = {host: variables(deck(host, "packing")) for host in HOSTS}
    taken["lammps"].pop("damp", None)
    assert taken["lammps"] == taken["liggghts"] and len(taken["lammps"]) == 14


@pytest.mark.parametrize("style", ["cfpm", "stock"])
def test_settles(tmp_path, style):
    """The bound of the kinetic energy is m g H/4 = 25.7 J; one packing ratio scatters by 1 % around 0.577."""
    table = pack(tmp_path, ranks=2, style=style, nt=6, picture=1)
    assert table.dtype.names == ("time", "kinetic_energy", "packing_ratio", "overlap")
    assert table["time"][-1] == pytest.approx(1.2)
    assert 15.0 < table["kinetic_energy"].max() < 25.7
    assert table["kinetic_energy"][-1] < 0.1
    assert 0.577 * 0.95 < table["packing_ratio"][-1] < 0.577 * 1.05
    assert 0.0 < table["overlap"][-1] < 1e-3
    assert list(tmp_path.glob("packing.*.ppm"))


def test_writes_a_restart(tmp_path):
    pack(tmp_path, nt=3, duration=0.2, restart=1)
    assert (tmp_path / "packing.restart").stat().st_size > 0
