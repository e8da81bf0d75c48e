# SPDX-License-Identifier: GPL-2.0-or-later
"""`contacts` of a wall: what it says of the contact of each particle."""

import re

import numpy as np
import pytest
from granular_bed import granular_bed
from granular_contacts import CONTACTS, DENSITY, RADIUS, SPEED
from harness.lammps import STOCK, run
from harness.output import read_dump
from test_granular_walls import HEAD

COLUMNS = "f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] f_w[7] f_w[8]"
LAWS = {
    "granular": f"granular {CONTACTS['material'][0]}",
    "granular with tension": f"granular {CONTACTS['hooke'][0]}",
    "hooke": "hooke 1e5 4e4 100 50 0.3 1",
}
OVERLAP = 1e-5
# of a sphere that overlaps with it by that much, and the place where it does
WALLS = {
    "plane": ("zplane 0 NULL", (0.1, 0.2, RADIUS - OVERLAP), (0.1, 0.2, 0)),
    "cylinder": ("region contacts", (0, 0.4 - RADIUS + OVERLAP, 0.3), (0, 0.4, 0.3)),
}


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("predict", ["rk4", "rk4 onset on"])
def test_predicted(tmp_path, law, wall, predict):
    """The force is all that acts on the sphere; of one that touches nothing nothing is said."""
    shape, (x, y, z), place = WALLS[wall]
    text = f"""{HEAD}
region contacts cylinder z 0 0 0.4 -1 1 units box
create_atoms 1 single {x!r} {y!r} {z!r} units box
create_atoms 1 single 0 0 0.5 units box
set group all diameter {2 * RADIUS} density {DENSITY}
velocity all set {SPEED} {SPEED} -{SPEED} units box
pair_style granular/cfpm predict {predict}
pair_coeff * * {CONTACTS["material"][0]}
fix w all wall/gran/cfpm {LAWS[law]} {shape} contacts
fix integrate all nve/cfpm
timestep 1e-5
run 3
write_dump all custom end.dump id x y z fx fy fz {COLUMNS} modify sort id format float %.17g
"""
    run(re.sub(r"^clear\n", "", text.lstrip()), tmp_path)
    end = read_dump(tmp_path / "end.dump")[0][1]
    touches, fx, fy, fz, px, py, pz, radius = (end[column] for column in COLUMNS.split())
    assert list(touches) == [1.0, 0.0] and list(radius) == [RADIUS, 0.0]
    for told, force in zip((fx, fy, fz), ("fx", "fy", "fz")):
        assert list(told) == list(end[force])
    assert np.hypot(fy[0], fz[0]) > 1e-3
    moved = np.array(place) + np.array([SPEED, 0, -SPEED if wall == "cylinder" else 0]) * 3e-5
    moved[1] += 0.0 if wall == "cylinder" else SPEED * 3e-5
    # on a cylinder the place turns with the sphere, which is nearer to the axis
    assert np.abs(np.array([px[0], py[0], pz[0]]) - moved).max() < 0.1 * SPEED * 3e-5
    assert px[1] == py[1] == pz[1] == 0.0


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("style", ["wall/gran", "wall/gran/region"])
def test_as_stock_in_its_own_step(tmp_path, style, ranks):
    """An unmodified deck with -suffix cfpm."""
    text = granular_bed("tsuji", "off", after="run 2000\n")
    shape = "region plane" if style.endswith("region") else "zplane 0 NULL"
    text = re.sub(r"fix floor all wall/gran (.*) zplane.*", rf"fix w all {style} \1 {shape} contacts", text)
    dump = f"dump all all custom 100 all.dump id {COLUMNS}\ndump_modify all sort id format float %.17g\n"
    text = text.replace("run 2000", f"{dump}run 2000")
    text = re.sub(r"(?m)^(region box .*)$", r"\1\nregion plane plane 0 0 0 0 0 1 units box", text)
    found = []
    for words in ({"program": STOCK}, {"options": ("-suffix", "cfpm")}):
        run(text, tmp_path, np=ranks, **words)
        found.append((tmp_path / "all.dump").read_text())
    same = found[0] == found[1]
    assert same
    told = [np.count_nonzero(dump["f_w[1]"]) for _, dump in read_dump(tmp_path / "all.dump")]
    assert sum(told) > 10, "hardly any contact"
