# SPDX-License-Identifier: GPL-2.0-or-later
"""fix nve/cfpm energy yes: the budget closes to rounding, and its entries are what physics says. SI units.

What is the core's alone is tested in tests/lammps/test_energy_budget.py.
"""

from math import sqrt

import numpy as np
import pytest
from harness.energy_budget import COMMANDS, ENTRIES, G, assert_closes, cloud, normal_energy, table
from harness.liggghts import run
from harness.output import read_dump
from harness.spheres import Law, Sphere, box, contact_time, reduced_mass, stiffness_material, write_data, write_stl
from small_deck import MODEL, PAIR, STOCK_WALL, assert_refused, attempt

KN, KT, YOUNG, POISSON = 2e4, 8e3, 5e6, 0.3
MATERIAL = f"""fix kn all property/global kn peratomtypepair 1 {KN}
fix kt all property/global kt peratomtypepair 1 {KT}
fix gn all property/global gamman peratomtypepair 1 2000
fix gt all property/global gammat peratomtypepair 1 1000
fix Y all property/global youngsModulus peratomtype {YOUNG}
fix nu all property/global poissonsRatio peratomtype {POISSON}
fix e all property/global coefficientRestitution peratomtypepair 1 0.6
fix mu all property/global coefficientFriction peratomtypepair 1 0.5
"""
WALLS = {
    "pairs": "",
    "plane": "fix floor all wall/gran/cfpm {model} primitive type 1 zplane 0 shear x 0.5\n",
    "mesh": "fix mesh all mesh/surface file floor.stl type 1 surface_vel 0.5 0 0\n"
    "fix floor all wall/gran/cfpm {model} mesh n_meshes 1 meshes mesh\n",
}


def deck(dt, law, predict, wall, runs, particles="spheres.data", edge="p p m", material=MATERIAL):
    model = f"model {law} tangential history"
    return f"""{box(dt, data=particles, skin=0.002, boundary=edge)}{material}
pair_style gran/cfpm {model} predict {predict}
pair_coeff * *
{wall.format(model=model)}{COMMANDS}{runs}"""


def move(folder, dt, law, predict, wall, runs, ranks=1):
    """The cloud of spheres; returns the table and the edge of the box."""
    spheres, ends = cloud()
    write_data(folder / "spheres.data", spheres, *ends, types=1)
    low, high = ends
    write_stl(folder / "floor.stl", [(low, low, 0), (high, low, 0), (high, high, 0), (low, high, 0)])
    return table(run(deck(dt, law, predict, wall, runs), folder, np=ranks)), ends[1]


def spring_energy(law):
    if law == "hooke/stiffness":
        return lambda d, _: KN * d**2 / 2
    return lambda d, radius: 0.4 * 4 / 3 * YOUNG / (2 * (1 - POISSON**2)) * np.sqrt(radius) * d**2.5


CASES = [
    ("hooke/stiffness", "verlet"),
    ("hooke/stiffness", "exact"),
    ("hooke/stiffness", "exact onset on"),
    ("hooke/stiffness", "impulse"),
    ("hertz", "verlet"),
    ("hertz", "exact"),
    ("hertz", "impulse"),
]


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("law, predict", CASES)
def test_closes(tmp_path, law, predict, wall):
    steps, dt = 600, 2e-5
    runs = f"""thermo 100
dump motion all custom 100 motion.dump id x y z radius
dump_modify motion format "%d{4 * " %.17g"}"
run {steps // 2}
run {steps // 2}
"""
    for ranks in (1, 2):
        told, edge = move(tmp_path, dt, law, predict, WALLS[wall], runs, ranks)
        motion = dict(read_dump(tmp_path / "motion.dump"))
        held = [normal_energy(motion[step], spring_energy(law), edge, wall != "pairs") for step in told["step"]]
        assert_closes(told, held, steps, dt, predict == "verlet", wall != "pairs")


@pytest.mark.parametrize("wall", ["plane", "mesh"])
@pytest.mark.parametrize("law", ["hooke/stiffness", "hertz", "hertz/stiffness"])
def test_without_friction_all_force_is_normal(tmp_path, law, wall):
    """So nothing is lost by friction: what is told of the host's own step is what it computes."""
    spheres, ends = cloud(side=3)
    write_data(tmp_path / "spheres.data", spheres, *ends, types=1)
    write_stl(tmp_path / "floor.stl", [(0, 0, 0), (ends[1], 0, 0), (ends[1], ends[1], 0), (0, ends[1], 0)])
    material = MATERIAL.replace("Friction peratomtypepair 1 0.5", "Friction peratomtypepair 1 0")
    area = 2000 if law == "hertz/stiffness" else 1  # about 1/(R* d)^(1/2)
    material = material.replace(f"pair 1 {KN}", f"pair 1 {area * KN}").replace("pair 1 2000", f"pair 1 {area * 2000}")
    told = table(run(deck(2e-5, law, "verlet", WALLS[wall], "thermo 500\nrun 1000\n", material=material), tmp_path))
    rounding = 4 * 1000 * np.finfo(float).eps * told["translation"].max()
    assert np.ptp(told["balance"]) < rounding
    assert told["lost_normal"][-1] > 0.05 * told["translation"][0]
    assert np.abs(told["lost_friction"] + told["tangential"]).max() < rounding


def test_same_on_two_ranks(tmp_path):
    """Before rounding has grown: every pair is counted once."""
    one, two = (
        move(tmp_path, 2e-5, "hooke/stiffness", "impulse", WALLS["plane"], "thermo 100\nrun 100\n", ranks)[0]
        for ranks in (1, 2)
    )
    for name in ENTRIES:
        assert two[name] == pytest.approx(one[name], abs=1e-9 * one["translation"].max())


@pytest.mark.parametrize("predict", ["exact", "impulse", "verlet"])
def test_goes_on_from_a_restart_file(tmp_path, predict):
    law = "hooke/stiffness"
    runs = "thermo 100000\nrun 300\nrun 0\nwrite_restart bed.restart\nrun 300\n"
    on, _ = move(tmp_path, 2e-5, law, predict, WALLS["plane"], runs)
    again = deck(2e-5, law, predict, WALLS["plane"], "thermo 100000\nrun 300\n")
    again = again.replace("read_data spheres.data", "read_restart bed.restart")
    told = table(run(again, tmp_path))
    for name in ENTRIES:
        assert told[name][-1] == pytest.approx(on[name][-1], abs=1e-9 * on["translation"].max())


def test_head_on(tmp_path):
    """A collision takes 1 - e^2 of the energy of approach, of a sphere and a wall too."""
    e, speed, gap = 0.6, 1.0, 2e-4
    pair = [Sphere((0, 0, 0.025 + gap), (0, 0, -speed)), Sphere((0.2, 0, 0.1), (speed, 0, 0))]
    pair += [Sphere((0.25 + gap, 0, 0.1))]
    dt = 2e-4  # some of a contact
    write_data(tmp_path / "spheres.data", pair, types=1)
    material = MATERIAL + "fix v all property/global characteristicVelocity scalar 1.0\n"
    runs = "unfix g\nfix g all gravity 0 vector 0 0 -1\nthermo 1\nrun 40\n"
    floor = WALLS["plane"].replace("shear x 0.5", "")
    told = table(run(deck(dt, "hooke", "impulse", floor, runs, edge="f f f", material=material), tmp_path))
    before = 0.5 * pair[0].mass * speed**2 + 0.5 * reduced_mass(*pair[1:]) * speed**2
    assert told["lost_normal"][-1] == pytest.approx((1 - e**2) * before, abs=1e-6 * before)
    assert np.abs(told["lost_friction"]).max() < 1e-9 * before
    assert told["normal"].max() > 0.1 * before and told["normal"][-1] == 0.0


MU, SLIDING, SPEED = 0.3, 0.05, 2.0


@pytest.mark.parametrize("wall", ["plane", "mesh"])
@pytest.mark.parametrize("predict", ["verlet", "exact", "impulse"])
def test_sheared_floor_gives_force_times_its_way(tmp_path, predict, wall):
    """A sphere that has settled slides until it rolls: the slip velocity falls by 7/2 mu g, and friction takes mu m g
    times its integral, the floor gives mu m g times its own way. But for what loading the spring and the first steps
    change: mu m g over the way that a spring is long at the limit, and over two steps, twice."""
    sphere = Sphere((0, 0, 0.025 - 1e-7))
    mass, kn = sphere.mass, 1e6
    law = Law(kn, sqrt(kn * mass), kn, 0.0, MU)
    dt = contact_time(law, mass) / 10
    steps = int(SLIDING / dt)
    write_data(tmp_path / "spheres.data", [sphere], types=1)
    write_stl(tmp_path / "floor.stl", [(-0.9, -0.9, 0), (0.9, -0.9, 0), (0.9, 0.9, 0), (-0.9, 0.9, 0)])
    words = WALLS[wall].replace("0.5", str(SPEED)).format(model="model hooke/stiffness tangential history")
    still = words.replace(f"shear x {SPEED}", "").replace(f"surface_vel {SPEED} 0 0", "")
    runs = f"thermo 100000\nrun 3000\nunfix floor\n{'unfix mesh' if wall == 'mesh' else ''}\n{words}run {steps}\n"
    material = stiffness_material({(1, 1): law})
    text = deck(dt, "hooke/stiffness", predict, still, runs, edge="f f f", material=material)
    told = table(run(absolute(text), tmp_path))
    change = {name: told[name][-1] - told[name][-2] for name in ENTRIES}
    force, time = MU * mass * G, steps * dt
    bound = 2 * force * (force / kn + 2 * SPEED * dt)
    assert change["moved"] == pytest.approx(force * SPEED * time, abs=bound * SPEED)
    way = SPEED * time - 7 / 4 * MU * G * time**2
    assert way > 0.5 * SPEED * time, "it rolls"
    assert change["lost_friction"] + change["tangential"] == pytest.approx(force * way, abs=bound + 1e-5 * force * way)


def absolute(text):
    """With damping that is given as it is."""
    lines = []
    for line in text.splitlines():
        if line.startswith(("pair_style", "fix floor")):
            line += " absolute_damping on"
        lines.append(line)
    return "\n".join(lines) + "\n"


REFUSED = {
    "energy": "fix nve/cfpm: found 'nothing' behind energy; expected yes or no",
    "energy on": "fix nve/cfpm: found 'on' behind energy; expected yes or no",
    "energy yes disc": "fix nve/cfpm: unknown argument 'disc'",
    "disc": "fix nve/cfpm: unknown argument 'disc'",
}


@pytest.mark.parametrize("words", REFUSED)
def test_wrong_words(tmp_path, words):
    assert_refused(attempt(tmp_path, 1, {"integrator": f"fix integrate all nve/cfpm {words}"}), [REFUSED[words]])


COMPANIONS = {
    "another": ({"extra": "fix second two nve/cfpm", "integrator": "fix integrate one nve/cfpm energy yes"},
                "fix nve/cfpm (id second): the budget is of the particles of one fix nve/cfpm"),
    "rolling": ({"pair": PAIR + MODEL + " rolling_friction cdt",
                 "extra": "fix r all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1"},
                "cohesion or rolling friction"),
    "wall": ({"pair": PAIR + MODEL + " predict verlet", "wall": STOCK_WALL}, "its contacts are the host's"),
}


@pytest.mark.parametrize("case", COMPANIONS)
def test_what_has_no_budget_is_refused(tmp_path, case):
    changes, expected = COMPANIONS[case]
    changes = {"integrator": "fix integrate all nve/cfpm energy yes", **changes}
    assert_refused(attempt(tmp_path, 1, changes), ["fix nve/cfpm: 'energy yes' beside", expected])
