# SPDX-License-Identifier: GPL-2.0-or-later
"""A wall is asked for a particle only where they may touch: to the last bit as if asked for each in each step.

What is known of places is forgotten at the end of each run: in runs of one step every wall is asked for everything.
"""

import numpy as np
import pytest
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import read_dump, vectors
from stock_words import in_stock_words

CONTACT = "1e4 NULL 60 0 0.5 0"  # a contact time of 1e-3 s
RADIUS = 0.005
STEPS = 2000
DT = 5e-5

HEAD = f"""units si
atom_style sphere
boundary s s s
newton off
comm_modify vel yes
region box block -0.2 0.2 -0.2 0.2 -0.2 0.2 units box
create_box 1 box
neighbor 0.004 bin
neigh_modify delay 0 every 1 check yes
timestep {DT}
lattice sc {2.6 * RADIUS}
"""
# a small cloud about the axes, on which some spheres are, that flies apart and meets walls some ten times
CLOUD = f"""
region cloud sphere 0 0 0 0.03 units box
create_atoms 1 region cloud
set group all diameter {2 * RADIUS} density 2500
variable even atom "id%2 == 0"
group small variable even
set group small diameter {1.4 * RADIUS}
variable vx atom "2*sin(7*id)"
variable vy atom "2*sin(3*id)"
variable vz atom "2*sin(5*id)"
velocity all set v_vx v_vy v_vz
"""
TURN = "variable theta equal 25*step*dt\nvariable x equal 0.02*sin(60*step*dt)\n"

WALLS = {
    "planes": ("zplane -0.04 0.04", ""),
    "planes_that_swing": ("zplane -0.06 0.06 wiggle z 0.02 0.03", ""),
    "planes_that_shear": ("xplane -0.04 0.04 shear z 0.5", ""),
    "zcylinder": ("zcylinder 0.045 shear x 0.4", ""),
    "block": ("region W", "region W block -0.04 0.04 -0.05 0.05 -0.04 0.045 units box"),
    "open_block": ("region W", "region W block -0.04 0.04 -0.05 0.05 -0.04 0.045 units box open 2 open 5"),
    "cylinder": ("region W", "region W cylinder y 0 0 0.045 -0.06 0.05 units box"),
    "cone": ("region W", "region W cone z 0 0 0.03 0.06 -0.05 0.06 units box"),
    "sphere": ("region W", "region W sphere 0 0 0 0.045 units box"),
    "plane": ("region W", "region W plane 0 0 -0.04 0.1 0 1 units box"),
    "hopper": (
        "region W",
        """region funnel cone z 0 0 0.02 0.05 -0.035 0.02 units box open 1 open 2
region spout cylinder z 0 0 0.02 -0.08 -0.035 units box open 2
region top cylinder z 0 0 0.05 0.02 0.07 units box open 1
region W union 3 funnel spout top""",
    ),
    "closed_union": (
        "region W",
        """region lower sphere 0 0 -0.01 0.045 units box
region upper block -0.025 0.025 -0.025 0.025 -0.01 0.09 units box
region W union 2 lower upper""",
    ),
    "around_a_bar": (
        "region W",
        """region drum cylinder y 0 0 0.06 -0.06 0.06 units box
region bar block -0.01 0.01 -0.2 0.2 -0.055 -0.035 units box side out
region W intersect 2 drum bar""",
    ),
    "box_that_turns_and_shifts": (
        "region W",
        TURN + "region W block -0.045 0.05 -0.045 0.04 -0.05 0.045 units box "
        "rotate v_theta 0.01 0.01 0 1 2 3 move v_x NULL v_x",
    ),
    "drum_that_turns": (
        "region W",
        TURN + "region W cylinder x 0.01 0 0.05 -0.05 0.05 units box rotate v_theta 0 0.01 0 1 0 0",
    ),
    "sphere_that_breathes": (
        "region W",
        "variable r equal 0.055-0.012*sin(100*step*dt)\nregion W sphere 0 0 0 v_r units box",
    ),
}


def path(folder, wall, predict, once, before="", between="", ranks=1, stock=False):
    """All that the spheres did, by dumps in between. once: in one run; else in runs of one step. stock: with the host's
    styles."""
    folder.mkdir()
    shape, region = wall
    runs = f"run {STEPS // 2}" if once else f"run {STEPS // 2} pre no post no every 1 NULL"
    deck = f"""{HEAD}{CLOUD}{before}
pair_style gran/cfpm hooke {CONTACT} predict {predict}
pair_coeff * *
{region}
fix wall all wall/gran/cfpm hooke {CONTACT} {shape}
fix integrate all nve/cfpm
dump path all custom {STEPS // 50} path.dump id x y z vx vy vz omegax omegay omegaz
dump_modify path sort id format float %.17g
{runs}
{between}
{runs}
"""
    if stock:
        deck = in_stock_words(deck.replace("predict verlet", ""))
    run(deck, folder, program=STOCK if stock else LAUNCHER, np=ranks)
    return (folder / "path.dump").read_text()


def check_same(tmp_path, wall, predict, **options):
    once = path(tmp_path / "once", wall, predict, True, **options)
    asked = path(tmp_path / "asked", wall, predict, False, **options)
    snapshots = [vectors(s, "vx", "vy", "vz") for _, s in read_dump(tmp_path / "once" / "path.dump")]
    first = len(snapshots[0])
    turned = np.abs(snapshots[-1][:first] - snapshots[0]).max(axis=1)
    assert (turned > 0.1).sum() > 20, "few spheres met anything"
    same = once == asked  # of long texts pytest would look for the differences for minutes
    assert same


@pytest.mark.parametrize("case", WALLS)
def test_misses_nothing(tmp_path, case):
    check_same(tmp_path, WALLS[case], "exact")


@pytest.mark.parametrize("case", ["planes_that_swing", "open_block", "hopper", "box_that_turns_and_shifts"])
def test_misses_nothing_that_begins_inside_a_step(tmp_path, case):
    check_same(tmp_path, WALLS[case], "impulse")


COME_AND_GO = {
    "before": f"""
fix gravity all gravity 9.81 vector 0 0 -1
region source block -0.02 0.02 -0.02 0.02 0.03 0.06 units box
fix source all pour 60 1 4242 region source diam one {2 * RADIUS} dens 2500 2500
""",
    "between": """
group low region spout
displace_atoms low move 0 0 0.075 units box
""",
    "ranks": 2,
}


def test_misses_nothing_of_spheres_that_come_and_go(tmp_path):
    """On two ranks, with spheres that are inserted, and others that a command takes elsewhere."""
    check_same(tmp_path, WALLS["hopper"], "exact", **COME_AND_GO)


@pytest.mark.parametrize("case", [case for case in WALLS if WALLS[case][0] == "region W"] + ["come_and_go"])
def test_the_hosts_wall_misses_nothing(tmp_path, case):
    """With "predict verlet" its own region walls act, which are told whom they need not ask for."""
    wall, options = (WALLS["hopper"], COME_AND_GO) if case == "come_and_go" else (WALLS[case], {})
    ours = path(tmp_path / "ours", wall, "verlet", True, **options)
    same = ours == path(tmp_path / "stock", wall, "verlet", True, stock=True, **options)
    assert same


def test_sees_a_wall_that_commands_have_moved(tmp_path):
    """In a run without setup: a sphere that was far from the wall meets it, and is turned back."""
    run(
        f"""{HEAD}
create_atoms 1 single 0 0 0 units box
set group all diameter {2 * RADIUS} density 2500
velocity all set 0 0 -1 units box
pair_style gran/cfpm hooke {CONTACT}
pair_coeff * *
region W plane 0 0 -0.1 0 0 1 units box
fix wall all wall/gran/cfpm hooke {CONTACT} region W
fix integrate all nve/cfpm
dump path all custom 10 path.dump id z vz
run 10
region W delete
region W plane 0 0 -0.01 0 0 1 units box
run 500 pre no
""",
        tmp_path,
    )
    z, vz = vectors(read_dump(tmp_path / "path.dump")[-1][1], "z", "vz")[0]
    assert z > -0.01 and vz > 0
