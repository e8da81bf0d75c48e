# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugins of both hosts move the same 50 spheres from the same start alike: one core, two hosts.

The hosts find the same contacts and add the same forces in different orders. The bound is that of
tests/liggghts/test_rank_independence.py: N n eps L A, with the growth A of a small disturbance measured.
"""

import lammps
import liggghts
import numpy as np
import pytest
from lammps import LAUNCHER, read_dump, vectors
from spheres import Sphere, box, digits, write_data

STEPS = 1500
TERMS = 16  # neighbours, floor and gravity
SIDE = 0.2
DISTURBANCE = 1.0e-10
DT = 2.0e-5
LINEAR = ("hooke/stiffness", "hooke", (2.0e4, 8.0e3, 120.0, 60.0))
LAWS = {  # model of LIGGGHTS and of LAMMPS, stiffness and damping of both, predictor of pairs and of the floor
    "linear": (*LINEAR, "exact", "exact"),
    "impulse": (*LINEAR, "impulse", "impulse"),
    "split": (*LINEAR, "impulse split 0.5", "impulse"),
    "impulse_floor": (*LINEAR, "exact", "impulse"),
    "impulse_pairs": (*LINEAR, "impulse", "exact"),
    "hertz": ("hertz/stiffness", "hertz", (1.0e7, 4.0e6, 6.0e4, 3.0e4), "rk4", "rk4"),
}
MU = 0.4
OUTPUT = f"""
dump end all custom {STEPS} end.dump id x y z vx vy vz
dump_modify end sort id format {{}}
run {STEPS}
"""


def start(disturbance=0.0):
    random = np.random.default_rng(20050101)
    noise = np.random.default_rng(1)
    sites = np.stack(np.meshgrid(np.arange(4), np.arange(4), np.arange(4)), axis=-1).reshape(-1, 3)[:50]
    return [
        Sphere(
            x=tuple(np.array([-0.02, -0.02, 0.012]) + 0.0125 * site + noise.uniform(-1, 1, 3) * disturbance),
            v=tuple(random.uniform(-0.4, 0.4, 3) - 0.3 * (site - [1.5, 1.5, 0])),
            omega=tuple(random.uniform(-30.0, 30.0, 3)),
            radius=random.choice([0.004, 0.006]),
            density=2500.0,
        )
        for site in sites
    ]


def in_liggghts(folder, law):
    model, _, values, of_pairs, of_floor = LAWS[law]
    names = ("kn", "kt", "gamman", "gammat", "coefficientFriction")
    lines = [f"fix {n} all property/global {n} peratomtypepair 1 {v!r}" for n, v in zip(names, (*values, MU))]
    style = f"model {model} tangential history predict"
    text = box(DT, skin=0.002) + "\n".join(lines)
    text += f"""
pair_style gran/cfpm {style} {of_pairs}
pair_coeff * *
fix floor all wall/gran/cfpm {style} {of_floor} primitive type 1 zplane 0.0
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
"""
    form = '"%d' + 6 * " %.17g" + '"'
    liggghts.run(text + OUTPUT.format(form), folder)
    return read_dump(folder / "end.dump")[-1][1]


def in_lammps(folder, law):
    _, model, values, of_pairs, of_floor = LAWS[law]
    contact = f"{model} {digits(values)} {MU} 1 predict"
    text = f"""
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data spheres.data
neighbor 0.002 bin
neigh_modify delay 0
timestep {DT!r}
pair_style gran/cfpm {contact} {of_pairs}
pair_coeff * *
fix floor all wall/gran/cfpm {contact} {of_floor} zplane 0.0 NULL
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
"""
    lammps.run(text + OUTPUT.format("float %.17g"), folder, program=LAUNCHER)
    return read_dump(folder / "end.dump")[-1][1]


@pytest.mark.parametrize("law", LAWS)
def test_same_motion(tmp_path, law):
    ends = {}
    cases = {"liggghts": (in_liggghts, 0.0), "lammps": (in_lammps, 0.0), "off": (in_lammps, DISTURBANCE)}
    for name, (host, disturbance) in cases.items():
        folder = tmp_path / name
        folder.mkdir()
        write_data(folder / "spheres.data", start(disturbance), low=-SIDE / 2, high=SIDE / 2, types=1)
        ends[name] = vectors(host(folder, law), "x", "y", "z")
    growth = np.abs(ends["off"] - ends["lammps"]).max() / DISTURBANCE
    bound = STEPS * TERMS * np.finfo(float).eps * SIDE * max(growth, 1.0)
    difference = np.abs(ends["lammps"] - ends["liggghts"]).max()
    report = f"A {growth:.2g}, bound {bound:.2g}, hosts differ by {difference:.2g}"
    print(report)
    assert difference <= bound, report
    assert bound < 1e-3 * 0.004, "the motion has become too chaotic to compare"
    fallen = np.abs(ends["lammps"] - [s.x for s in start()]).max()
    assert fallen > 0.01
