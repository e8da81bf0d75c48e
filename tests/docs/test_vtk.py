# SPDX-License-Identifier: GPL-2.0-or-later
"""./cfpm vtk: what it writes, read back as VTK's XML says, is what a host dumped."""

import base64
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest
from harness import HOSTS
from harness.decks import two_spheres
from harness.host import ROOT
from harness.output import read_dump, vectors

PAIRS = {"liggghts": "pair_style none\natom_modify sort 0 0", "lammps": "pair_style zero 0.05\npair_coeff * *"}
DUMP = """
fix move all nve/sphere
dump all all custom 5 spheres.dump id type x y z vx vy vz radius omegax
run 10
"""
KINDS = {"Float64": np.float64, "Int64": np.int64}


def vtk(*words, cwd):
    ask = ["/usr/bin/python3", ROOT / "harness" / "vtk.py", *words]
    return subprocess.run(ask, cwd=cwd, capture_output=True, text=True)


def read(file):
    """{name: array} of all arrays of a .vtp file."""
    found = {}
    for element in ElementTree.parse(file).iter("DataArray"):
        data = base64.b64decode(element.text)
        assert np.frombuffer(data[:8], np.uint64)[0] == len(data) - 8
        values = np.frombuffer(data[8:], KINDS[element.get("type")])
        parts = int(element.get("NumberOfComponents", 1))
        found[element.get("Name")] = values.reshape(-1, parts) if parts > 1 else values
    return found


@pytest.mark.parametrize("host", HOSTS)
def test_what_a_host_dumped(tmp_path, host):
    HOSTS[host].run(two_spheres(host) + PAIRS[host] + DUMP, tmp_path)
    done = vtk("spheres.dump", "--dt", "1e-5", cwd=tmp_path)
    assert done.stdout == "spheres.pvd: 3 snapshots\n", done.stderr
    listed = ElementTree.parse(tmp_path / "spheres.pvd").findall(".//DataSet")
    for (step, columns), entry in zip(read_dump(tmp_path / "spheres.dump"), listed, strict=True):
        assert float(entry.get("timestep")) == step * 1e-5
        found = read(tmp_path / entry.get("file"))
        order = np.argsort(found["id"])
        assert (found["places"][order] == vectors(columns, "x", "y", "z")).all()
        assert (found["v"][order] == vectors(columns, "vx", "vy", "vz")).all()
        for name in ("type", "radius", "omegax"):  # a component alone stays a number
            assert (found[name][order] == columns[name]).all()
        assert (found["connectivity"] == [0, 1]).all() and (found["offsets"] == [1, 2]).all()


SNAPSHOT = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id {}\n"


@pytest.mark.parametrize(
    "text, message",
    [
        (SNAPSHOT.format("xs ys zs") + "1 0 0 0\n2 0 0 0\n", "found the columns id xs ys zs; expected x, y and z"),
        (SNAPSHOT.format("x y z") + "1 0 0 0\n", "found 1 of 2 particles at step 0; expected a whole snapshot"),
        ("units si\n", "found no snapshot"),
    ],
)
def test_refuses(tmp_path, text, message):
    (tmp_path / "some.dump").write_text(text)
    done = vtk("some.dump", cwd=tmp_path)
    assert done.returncode == 1 and done.stderr.startswith("cfpm: vtk: some.dump: " + message), done.stderr
