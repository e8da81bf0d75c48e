# SPDX-License-Identifier: GPL-2.0-or-later
"""The packing and the discharge deck of both hosts, one after the other."""

import re

import numpy as np
from harness import HOSTS
from harness.decks import MESH, deck, options

SPHERES = 200
RADIUS = 0.025
COLUMNS = ("time", "kinetic_energy", "discharged")


def settled_bed(folder, host="liggghts", **variables):
    """The file that in.packing leaves for in.discharge."""
    folder.mkdir()
    HOSTS[host].run(deck(host, "packing"), folder, options=options({"bed": 1, **variables}))
    return folder / "packing.data"


def discharge(folder, host, bed, ranks=1, then="", check=True, **variables):
    """The .csv and what the host printed. then: commands behind the deck; check: fail if the host complains."""
    folder.mkdir()
    if host == "liggghts":
        variables = {"mesh": MESH, **variables}
    text = deck(host, "discharge").read_text() + then
    variables = options({"bed": bed, **variables})
    process = HOSTS[host].run(text, folder, np=ranks, check=check, options=variables)
    if not check:
        return None, process.stdout
    # but for those of uses that this is not
    assert not re.search("WARNING(?!.*agitated grains are right up to)", process.stdout), process.stdout
    return np.genfromtxt(folder / "discharge.csv", delimiter=",", names=True), process.stdout


def heights(data):
    """z of the spheres in a file of write_data; both hosts have it in column 7."""
    atoms = data.read_text().split("Atoms")[1].split("\n\n")[1]
    return np.array([float(line.split()[6]) for line in atoms.splitlines()])


def assert_discharge(table, bed, end):
    """What holds of any discharge of 2 s from the bed it starts from. end: the data file at its end."""
    time, energy, count = (table[name] for name in COLUMNS)
    assert table.dtype.names == COLUMNS
    assert np.all(np.diff(count) >= 0) and count[0] == 0
    # a sphere counts when its centre has come down to -radius. It falls freely at best, but for the first ones, which
    # the load of the bed squeezes out: they were seen up to 5 mm ahead
    start = heights(bed)
    free = np.array([np.sum(start - 0.5 * 9.81 * t**2 < -RADIUS + 0.01) for t in time])
    assert np.all(count <= free)
    # the spheres above the hole have nothing to stand on, for 4 diameters do not make a lasting arch; those in
    # the corners of the floor have no reason to leave
    assert SPHERES * np.pi * 0.1**2 / 0.3**2 < count[-1] < SPHERES
    # counted is what is missing from above the lower end of the floor, and only what was counted is gone
    left = heights(end)
    assert count[-1] == SPHERES - np.sum(left > -RADIUS)
    assert len(left) >= SPHERES - count[-1] and left.min() > -1.0
    # a sphere on its way down has no more than m g times its height at the start above the lower floor
    mass = 800 * 4 / 3 * np.pi * RADIUS**3
    assert 1.0 < energy.max() < mass * 9.81 * np.sum(start + 1.0)
