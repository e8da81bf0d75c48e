# SPDX-License-Identifier: GPL-2.0-or-later
"""Every shape and motion of a wall against the host's own fix wall/gran: a sphere touches it for some hundred steps.

The two are not the same scheme and not quite the same law (the host's lever is the radius, here it ends in the middle
of the overlap): with 300 steps per contact time and overlaps of 1e-3 of a radius or less, the paths may differ by 1 %.
A wall in another place or with another velocity would make them differ altogether.
"""

import numpy as np
import pytest
from host_walls import documented, skip_if_removed
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import read_dump, vectors

CONTACT = "1e6 NULL 50 0 0.5 0"
DT = 2.0e-6  # the contact time is 7e-4 s
STEPS = 20000
RADIUS = 0.025
SPEED = 0.2

HEAD = """units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
"""
TURN = "variable theta equal {}*step*" + f"{DT}\n"  # [rad]

# wall, region, position, velocity
WALLS = {
    "floor": ("zplane 0.0 NULL", "", (0, 0, 0.0255), (0.1, 0.05, -SPEED)),
    "between_planes": ("xplane -0.05 0.05", "", (0.0245, 0, 0.2), (SPEED, 0.1, 0.05)),
    "wiggle": ("zplane 0.0 NULL wiggle z 0.002 0.02", "", (0, 0, 0.025), (0, 0, 0)),
    "shear": ("yplane NULL 0.1 shear x 0.3", "", (0, 0.0745, 0.2), (0, SPEED, 0)),
    "cylinder": ("zcylinder 0.1", "", (0.045, 0.0595, 0.1), (0.12, 0.16, 0.1)),
    "cylinder_turns": ("zcylinder 0.1 shear x 0.3", "", (0.045, 0.0595, 0.1), (0.12, 0.16, 0.0)),
    # the same as a region, clockwise
    "region_turns": (
        "region W",
        f"{TURN.format(-0.3 / 0.1)}region W cylinder z 0 0 0.1 -1 1 units box rotate v_theta 0 0 0 0 0 1",
        (0.045, 0.0595, 0.1),
        (0.12, 0.16, 0.0),
    ),
    "cylinder_shifts": ("zcylinder 0.1 shear z 0.3", "", (0.045, 0.0595, 0.1), (0.12, 0.16, 0.0)),
    "sphere": ("region W", "region W sphere 0 0 0.2 0.1 units box", (0.045, 0.0595, 0.2), (0.12, 0.16, 0.1)),
    "flat_cone": (
        "region W",
        "region W cone z 0 0 0.03 0.3 -0.0001 0.0 open 1 open 2 units box",
        (0.045, 0, 0.0255),
        (-0.1, 0.02, -SPEED),
    ),
    "turning_drum": (
        "region W",
        f"{TURN.format(2.0)}region W cylinder x 0 0.2 0.1 -0.5 0.5 units box rotate v_theta 0 0 0.2 1 0 0",
        (0, 0.045, 0.1405),
        (0, 0.1, -SPEED),
    ),
}


def path(folder, style, case, predict="", compared_to_the_bit=False):
    """Position and spin over time, the start and ten more, and the text they were read from."""
    wall, region, x, v = WALLS[case]
    folder.mkdir()
    program, law = (STOCK, "hooke/history") if style == "stock" else (LAUNCHER, "hooke")
    model = "gran/hooke/history" if style == "stock" else "gran/cfpm hooke"
    fix = "wall/gran" if style == "stock" else "wall/gran/cfpm"
    integrator = "nve/cfpm" if style == "cfpm" and not predict else "nve/sphere"
    if style == "stock" and region:
        fix += "/region"
    deck = f"""
{HEAD}
region box block -0.5 0.5 -0.5 0.5 -0.1 0.5 units box
create_box 1 box
create_atoms 1 single {x[0]} {x[1]} {x[2]} units box
set group all diameter {2 * RADIUS} density 800
velocity all set {v[0]} {v[1]} {v[2]} units box
neighbor 0.01 bin
timestep {DT}
pair_style {model} {CONTACT} {predict}
pair_coeff * *
{region}
fix wall all {fix} {law} {CONTACT} {wall}
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all {integrator}
dump path all custom {STEPS // 10} path.dump id x y z omegax omegay omegaz
dump_modify path sort id format float %.17g
run {STEPS}
"""
    as_it_is = style != "stock" or compared_to_the_bit
    run(deck if as_it_is else documented(deck), folder, program=program)
    file = folder / "path.dump"
    snapshots = read_dump(file)
    states = [vectors(s, "x", "y", "z", "omegax", "omegay", "omegaz")[0] for _, s in snapshots]
    return np.array(states), file.read_text()


@pytest.mark.parametrize("case", WALLS)
def test_is_where_the_hosts_wall_is(tmp_path, case):
    # the host adds the velocity of a turning zcylinder up over its particles: its region is right
    of_host = "region_turns" if case == "cylinder_turns" else case
    skip_if_removed(WALLS[of_host][0])
    stock, _ = path(tmp_path / "stock", "stock", of_host)
    cfpm, _ = path(tmp_path / "cfpm", "cfpm", case)
    t = STEPS * DT
    free = np.array(WALLS[case][2]) + np.array(WALLS[case][3]) * t - np.array([0, 0, 0.5 * 9.81 * t**2])
    assert np.linalg.norm(stock[-1, :3] - free) > 0.1 * SPEED * t, "the sphere did not meet the wall"
    travelled = np.linalg.norm(stock[:, :3] - stock[0, :3], axis=1).max()
    spun = np.abs(stock[:, 3:]).max()
    error = np.abs(cfpm - stock).max(axis=0)
    print(error, travelled, spun)
    assert error[:3].max() < 0.01 * travelled
    assert error[3:].max() < 0.01 * max(spun, SPEED / RADIUS)


@pytest.mark.parametrize("case", ["floor", "wiggle", "cylinder", "flat_cone", "turning_drum"])
def test_is_the_hosts_with_predict_none(tmp_path, case):
    """To the last digit; a wall without "predict" follows the pair style in this too."""
    skip_if_removed(WALLS[case][0])
    _, stock = path(tmp_path / "stock", "stock", case, compared_to_the_bit=True)
    _, cfpm = path(tmp_path / "cfpm", "cfpm", case, "predict none")
    assert stock == cfpm


@pytest.mark.parametrize(
    "law",
    ["hooke 1e6 1e3 50 0 0.5 0", "granular hertz 1e8 1e5 tangential mindlin 2e6 0 0.5"],
    ids=["hooke", "granular"],
)
def test_springs_follow_a_rank_change(tmp_path, law):
    """A sphere that slips along a wall from one rank to the other slips as on one rank. At the stiffness 1e3 N/m a new
    spring would take 30 steps to reach the limit of friction again."""
    ends = []
    for ranks in (1, 2):
        folder = tmp_path / str(ranks)
        folder.mkdir()
        run(
            f"""
{HEAD}
processors * 1 1
region box block -0.2 0.2 -0.2 0.2 -0.1 0.3 units box
create_box 1 box
create_atoms 1 single -0.03 0 {RADIUS} units box
set group all diameter {2 * RADIUS} density 800
velocity all set 1 0.3 0 units box
neighbor 0.001 bin
neigh_modify delay 0
timestep 1e-5
pair_style gran/cfpm hooke {CONTACT}
pair_coeff * *
fix wall all wall/gran/cfpm {law} zplane 0.0 NULL
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
dump path all custom 1000 path.dump id x y z omegax omegay omegaz
dump_modify path format float %.17g
run 6000
""",
            folder,
            np=ranks,
        )
        ends.append((folder / "path.dump").read_text())
    assert ends[0] == ends[1]


def bounce(folder, wall, pair):
    """A sphere meets the floor in the second run; pair: the pair style before it and from then on."""
    folder.mkdir()
    styles = [f"pair_style gran/cfpm hooke {CONTACT} predict {p}\npair_coeff * *" for p in pair]
    run(
        f"""
{HEAD}
region box block -0.2 0.2 -0.2 0.2 -0.1 0.3 units box
create_box 1 box
create_atoms 1 single 0 0 {1.02 * RADIUS} units box
set group all diameter {2 * RADIUS} density 800
velocity all set 0.1 0 -1 units box
neighbor 0.01 bin
timestep 1e-4
{styles[0]}
fix wall all wall/gran/cfpm hooke {CONTACT} zplane 0.0 NULL {wall}
fix integrate all nve/cfpm
run 1
{styles[1]}
dump path all custom 20 path.dump id x y z vx vy vz
dump_modify path format float %.17g
run 20
""",
        folder,
    )
    return (folder / "path.dump").read_text()


def test_follows_the_pair_style(tmp_path):
    """Also when that is given again; with "predict" of its own a wall does not."""
    followed = bounce(tmp_path / "followed", "", ("exact", "rk2"))
    own = bounce(tmp_path / "own", "predict rk2", ("exact", "exact"))
    left = bounce(tmp_path / "left", "", ("exact", "exact"))
    assert followed == own
    assert followed != left
