# SPDX-License-Identifier: GPL-2.0-or-later
"""fix nve/cfpm energy yes: the budget closes to rounding, and its entries are what physics says. SI units."""

from math import exp, log, pi, sqrt

import numpy as np
import pytest
from harness.energy_budget import COMMANDS, ENTRIES, G, assert_closes, cloud, normal_energy, table
from harness.lammps import run
from harness.output import first_error, read_dump
from harness.spheres import Sphere, lammps_box, reduced_mass, write_data
from host_walls import skip_if_another_law

KN = 2e4
LAWS = {"hooke": f"hooke {KN} NULL 100 NULL 0.5 1", "hertz": "hertz 1e7 NULL 1e5 NULL 0.5 1"}
SHEARED = "zplane 0 NULL shear x 0.5"


def move(folder, spheres, dt, law, runs, wall="", box=(-1.0, 1.0), **options):
    """Runs a deck of commands behind the wall; returns the table."""
    write_data(folder / "spheres.data", spheres, *box, types=1)
    start = lammps_box(dt, skin=0.005, newton=options.pop("newton", "off"))
    start = start.replace("f f f", options.pop("edge", "f f f"))
    model = law.split(" predict")[0].split(" onset")[0]
    floor = f"fix floor all wall/gran/cfpm {model} {wall}" if wall else ""
    deck = f"""{start}
pair_style gran/cfpm {law}
pair_coeff * *
{options.pop("before", "")}{floor}
{COMMANDS}{runs}"""
    return table(run(deck, folder, **options))


CASES = [
    ("hooke", "verlet"),
    ("hooke", "exact"),
    ("hooke", "exact onset on"),
    ("hooke", "impulse"),
    ("hertz", "verlet"),
    ("hertz", "rk4"),
    ("hertz", "impulse"),
]


def spring_energy(law):
    if law == "hooke":
        return lambda d, _: KN * d**2 / 2
    return lambda d, radius: 0.4 * 1e7 * np.sqrt(radius) * d**2.5


@pytest.mark.parametrize("wall", ["", SHEARED], ids=["pairs", "floor"])
@pytest.mark.parametrize("law, predict", CASES)
def test_closes(tmp_path, law, predict, wall):
    if wall and (law, predict) == ("hooke", "verlet"):
        skip_if_another_law()
    spheres, box = cloud()
    steps, dt = 600, 2e-5
    runs = f"""thermo 100
dump motion all custom 100 motion.dump id x y z radius
dump_modify motion format line "%d{4 * " %.17g"}"
run {steps // 2}
run {steps // 2}
"""
    style = f"{LAWS[law]} predict {predict}"
    for ranks, newton in ((1, "off"), (2, "off"), (2, "on")):
        told = move(tmp_path, spheres, dt, style, runs, wall, box=box, edge="p p m", np=ranks, newton=newton)
        motion = dict(read_dump(tmp_path / "motion.dump"))
        held = [normal_energy(motion[step], spring_energy(law), box[1], wall) for step in told["step"]]
        assert_closes(told, held, steps, dt, predict == "verlet", bool(wall))


SHAPES = {  # with the sides of the box that are periodic
    "cylinder": ("zcylinder 0.04", "f f p"),
    "planes": ("zplane 0 0.06 shear y 1", "p p f"),
    "region": ("region drum", "f f f"),
}


@pytest.mark.parametrize("predict", ["verlet", "rk2", "impulse"])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("law", ["hooke", "hertz"])
def test_without_friction_all_force_is_normal(tmp_path, law, shape, predict):
    """So friction does no work: the normal force of a wall of any shape is the whole force to rounding, where the host
    has computed it as well. What its springs hold is then against its dashpots, as the host's law sets them."""
    if (shape, predict) == ("region", "verlet"):
        return  # refused, see below
    spheres, box = cloud(side=3, speed=2.0)
    centre = 0.5 * box[1]
    spheres = [Sphere(tuple(np.array(s.x) - (centre, centre, 0)), s.v, s.omega, s.radius, s.density) for s in spheres]
    style = LAWS[law].replace("0.5 1", "0 1")
    wall, edge = SHAPES[shape]
    region = "region drum cylinder z 0 0 0.04 -0.06 0.05 units box\n"
    told = move(
        tmp_path, spheres, 2e-5, f"{style} predict {predict}", "thermo 500\nrun 1000\n", wall, box=(-0.06, 0.06),
        edge=edge, before=region,
    )
    rounding = 4 * 1000 * np.finfo(float).eps * told["translation"].max()
    assert np.ptp(told["balance"]) < rounding
    assert told["lost_normal"][-1] > 0.05 * told["translation"][0]
    assert np.abs(told["lost_friction"] + told["tangential"]).max() < rounding
    assert np.abs(told["moved"]).max() < rounding


@pytest.mark.parametrize("predict", ["verlet", "exact", "impulse"])
def test_same_on_two_ranks(tmp_path, predict):
    """Before rounding has grown: every pair is counted once."""
    spheres, box = cloud()
    law, runs = f"{LAWS['hooke']} predict {predict}", "thermo 100\nrun 100\n"
    one, off, on = (
        move(tmp_path, spheres, 2e-5, law, runs, SHEARED, box=box, edge="p p m", np=ranks, newton=newton)
        for ranks, newton in ((1, "off"), (2, "off"), (2, "on"))
    )
    scale = one["translation"].max()
    for name in ENTRIES:
        assert off[name] == pytest.approx(one[name], abs=1e-9 * scale)
        assert on[name] == pytest.approx(one[name], abs=1e-9 * scale)


def damping(e, mass):
    """gamma_n of hooke."""
    loss = -log(e)
    return 2 * loss / sqrt(loss**2 + pi**2) * sqrt(mass * KN) / mass


@pytest.mark.parametrize("predict, nt, within", [("verlet", 200, 1e-2), ("exact", 200, 2e-2), ("impulse", 3.3, 1e-6)])
def test_head_on(tmp_path, predict, nt, within):
    """A collision takes 1 - e^2 of the energy of approach, to the error of the method, which with dashpots that jump at
    the touch is of first order in dt for methods that find contacts late."""
    e, speed = 0.6, 1.0
    gap = 2e-4
    pair = [Sphere((-0.025 - gap, 0, 0), (speed / 2, 0, 0)), Sphere((0.025, 0, 0), (-speed / 2, 0, 0))]
    mass = reduced_mass(*pair)
    tc = pi * sqrt(mass / KN)
    got = move(
        tmp_path, pair, tc / nt, f"hooke {KN} 0 {damping(e, mass)} 0 0 0 predict {predict}",
        f"unfix g\nfix g all gravity 0 vector 0 0 -1\nthermo 1\nrun {int(3 * nt) + 10}\n",
    )
    before = mass * speed**2 / 2
    assert got["translation"][0] == pytest.approx(before)
    assert got["lost_normal"][-1] == pytest.approx(before - got["translation"][-1], abs=1e-12 * before)
    assert got["lost_normal"][-1] == pytest.approx((1 - e**2) * before, abs=within * before)
    assert np.abs(got["lost_friction"]).max() < 1e-12 * before
    if predict != "impulse":
        return
    # while they touch the motion is d = u/w exp(-b t) sin(w t)
    b = damping(e, mass) / 2
    w = sqrt(KN / mass - b**2)
    t = got["step"] * tc / nt - gap / speed
    touching = (t > 0) & (t < pi / w)
    d = np.where(touching, speed / w * np.exp(-b * t) * np.sin(w * t), 0.0)
    assert touching.sum() > 2
    assert got["normal"] == pytest.approx(KN * d**2 / 2, abs=1e-6 * before)
    u = speed * np.exp(-b * t) * (np.cos(w * t) - b / w * np.sin(w * t))
    left = np.where(t < 0, before, np.where(touching, mass * u**2 / 2, exp(-2 * b * pi / w) * before))
    assert got["lost_normal"] == pytest.approx(before - left - KN * d**2 / 2, abs=1e-6 * before)


MU, SLIDING = 0.3, 0.05  # s


def on_floor(folder, predict, sheared="", kick=""):
    """A sphere that has settled, for a time in which it slides. What has changed, or at the end is; the limit of
    friction; the time; a bound of what loading its spring and the first steps may change [J]: the slip velocity is at
    most 2 m/s and that of a spring over force/kn, or over two steps."""
    if predict == "verlet":
        skip_if_another_law()
    sphere = Sphere((0, 0, 0.025 - 1e-7))
    mass, kn = sphere.mass, 1e6
    dt = pi * sqrt(mass / kn) / 10
    steps = int(SLIDING / dt)
    law = f"hooke {kn} {kn} {sqrt(kn / mass)} 0 {MU} 0"
    floor = f"unfix floor\nfix floor all wall/gran/cfpm {law} zplane 0 NULL {sheared}\n"
    runs = f"thermo 100000\nrun 3000\n{floor}{kick}run {steps}\n"
    got = move(folder, [sphere], dt, f"{law} predict {predict}", runs, "zplane 0 NULL")
    change = {name: column[-1] - (0.0 if name in ENTRIES[:4] else column[-2]) for name, column in got.items()}
    force = MU * mass * G
    return change, force, steps * dt, 2 * force * (force / kn + 2 * 2.0 * dt)


@pytest.mark.parametrize("predict", ["verlet", "exact", "impulse"])
def test_sliding_takes_friction_times_way(tmp_path, predict):
    """A sphere without spin slides until it rolls: the slip velocity falls by 7/2 mu g, the way is its integral, and
    friction takes mu m g times that. Verlet's lever is the radius or half an overlap less, 1e-6 of it."""
    speed = 2.0
    e, force, time, bound = on_floor(tmp_path, predict, kick=f"velocity all set {speed} 0 0\n")
    way = speed * time - 7 / 4 * MU * G * time**2
    assert way > 0.5 * speed * time, "it rolls"
    assert e["lost_friction"] + e["tangential"] == pytest.approx(force * way, abs=bound + 1e-5 * force * way)
    assert abs(e["lost_normal"]) < 1e-3 * force * way
    assert e["moved"] == 0.0


@pytest.mark.parametrize("predict", ["verlet", "exact", "impulse"])
def test_sheared_floor_gives_force_times_its_way(tmp_path, predict):
    """Which is what the sphere gains and friction takes of it."""
    speed = 2.0
    e, force, time, bound = on_floor(tmp_path, predict, f"shear x {speed}")
    assert e["moved"] == pytest.approx(force * speed * time, abs=bound * speed)
    way = speed * time - 7 / 4 * MU * G * time**2
    assert e["lost_friction"] + e["tangential"] == pytest.approx(force * way, abs=bound + 1e-5 * force * way)


@pytest.mark.parametrize("law, predict", [("hooke", "exact"), ("hooke", "impulse"), ("hertz", "verlet")])
def test_goes_on_from_a_restart_file(tmp_path, law, predict):
    """Of particles that write_restart itself moves the host loses springs; "run 0" moves them before."""
    spheres, box = cloud()
    style = f"{LAWS[law]} predict {predict}"
    runs = "thermo 100000\nrun 300\nrun 0\nwrite_restart bed.restart\nrun 300\n"
    on = move(tmp_path, spheres, 2e-5, style, runs, "zplane 0 NULL", box=box, edge="p p m")
    deck = f"""read_restart bed.restart
comm_modify vel yes
pair_style gran/cfpm {style}
pair_coeff * *
neighbor 0.005 bin
neigh_modify delay 0
timestep 2e-5
fix floor all wall/gran/cfpm {LAWS[law]} zplane 0 NULL
{COMMANDS}thermo 100000
run 300
"""
    again = table(run(deck, tmp_path))
    scale = on["translation"].max()
    for name in ENTRIES:
        assert again[name][-1] == pytest.approx(on[name][-1], abs=1e-9 * scale)


@pytest.mark.parametrize("predict", ["rk2", "impulse"])
def test_closes_with_granular(tmp_path, predict):
    spheres, box = cloud()
    write_data(tmp_path / "spheres.data", spheres, *box, types=1)
    model = "hertz/material 1e6 0.5 0.3 tangential mindlin NULL 1 0.3 damping tsuji"
    deck = f"""{lammps_box(2e-5, skin=0.005).replace("f f f", "p p m")}
pair_style granular/cfpm predict {predict}
pair_coeff * * {model}
fix floor all wall/gran/cfpm granular {model} zplane 0 NULL shear x 0.5
{COMMANDS}thermo 100
dump motion all custom 100 motion.dump id x y z radius
dump_modify motion format line "%d{4 * " %.17g"}"
run 600
"""
    told = table(run(deck, tmp_path))
    motion = dict(read_dump(tmp_path / "motion.dump"))
    stiffness = 4 / 3 * 1e6 / (2 * (1 - 0.3**2))  # of two bodies of that material, over the root of R*

    def energy(overlap, radius):
        return 0.4 * stiffness * np.sqrt(radius) * overlap**2.5

    held = [normal_energy(motion[step], energy, box[1], False) for step in told["step"]]
    at_floor = told["normal"] - held  # whose moduli older hosts mix in a way of their own
    assert at_floor.min() > -1e-10 * told["balance"][0] and at_floor.max() > 0.0
    assert_closes(told, told["normal"], 600, 2e-5, False, True)


REFUSED = {
    "energy": "fix nve/cfpm: found 'nothing' behind energy; expected yes or no",
    "energy on": "fix nve/cfpm: found 'on' behind energy; expected yes or no",
    "energie yes": "fix nve/cfpm: unknown argument 'energie'; expected disc, energy yes|no or nothing",
}


@pytest.mark.parametrize("words", REFUSED)
def test_wrong_words(tmp_path, words):
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, 0))], types=1)
    deck = f"{lammps_box(1e-5)}pair_style gran/cfpm {LAWS['hooke']}\npair_coeff * *\nfix move all nve/cfpm {words}\n"
    assert REFUSED[words] in first_error(run(deck, tmp_path, check=False))


COMPANIONS = {
    "fix second none nve/cfpm": "fix nve/cfpm (id second): the budget is of the particles of one fix nve/cfpm",
    f"fix w all wall/gran/cfpm {LAWS['hooke']} zplane -1 NULL predict verlet": "fix wall/gran (id w): its contacts",
    f"region r block -1 1 -1 1 -1 1\nfix w all wall/gran/cfpm {LAWS['hooke']} region r": "contacts with a region",
}


@pytest.mark.parametrize("command", COMPANIONS)
def test_what_has_no_budget_is_refused(tmp_path, command):
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, 0))], types=1)
    deck = f"""{lammps_box(1e-5)}
group none empty
pair_style gran/cfpm {LAWS["hooke"]} predict verlet
pair_coeff * *
fix move all nve/cfpm energy yes
{command}
run 1
"""
    error = first_error(run(deck, tmp_path, check=False))
    assert "fix nve/cfpm: 'energy yes' beside" in error and COMPANIONS[command] in error


COEFFICIENTS = "hooke 1e4 10 tangential linear_history 1e4 1 0.5 damping velocity"
PAIRS = {
    f"granular/cfpm predict verlet;{COEFFICIENTS}": "granular/cfpm: with 'predict verlet' its contacts are not told of",
    f"granular/cfpm predict exact;{COEFFICIENTS} rolling sds 1e3 1 0.1": "granular/cfpm: what springs hold of rolling",
    f"gran/cfpm {LAWS['hooke'].replace('hooke', 'hooke/nohistory')} predict verlet;": "contacts of hooke/nohistory",
}


@pytest.mark.parametrize("style", PAIRS)
def test_contacts_that_are_not_told_of_are_refused(tmp_path, style):
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, 0))], types=1)
    pair, coefficients = style.split(";")
    deck = f"""{lammps_box(1e-5)}
pair_style {pair}
pair_coeff * * {coefficients}
fix move all nve/cfpm energy yes
run 1
"""
    error = first_error(run(deck, tmp_path, check=False))
    assert "'energy yes' beside pair_style gran" in error and PAIRS[style] in error
