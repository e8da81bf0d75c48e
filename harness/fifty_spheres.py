# SPDX-License-Identifier: GPL-2.0-or-later
"""The same motion in both hosts: 50 spheres of two sizes, with spin, fall on a floor. SI units.

The hosts find the same contacts and add the same forces in different orders. The bound is that of
tests/liggghts/test_rank_independence.py: N n eps L A, with the growth A of a small disturbance measured.
"""

import numpy as np

from harness import HOSTS
from harness.spheres import Sphere, box, digits, dump, lammps_box, read_motion, write_data

STEPS = 1500
TERMS = 16  # neighbours, floor and gravity
SIDE = 0.2
DISTURBANCE = 1.0e-10
DT = 2.0e-5
# without a dashpot in friction, which Coulomb's limit holds otherwise in either host
LINEAR = ("hooke/stiffness", "hooke", (2.0e4, 8.0e3, 120.0, 0.0))
LAWS = {  # model of LIGGGHTS and of LAMMPS, stiffness and damping of both, predictor of pairs and of the floor
    "linear": (*LINEAR, "exact", "exact"),
    "impulse": (*LINEAR, "impulse", "impulse"),
    "split": (*LINEAR, "impulse split 0.5", "impulse"),
    "impulse_floor": (*LINEAR, "exact", "impulse"),
    "impulse_pairs": (*LINEAR, "impulse", "exact"),
    "hertz": ("hertz/stiffness", "hertz", (1.0e7, 4.0e6, 6.0e4, 0.0), "rk4", "rk4"),
}
MU = 0.4


def start(disturbance=0.0):
    """The spheres; each coordinate is off by the disturbance [m] at most."""
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


def in_liggghts(law):
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
    return text


def in_lammps(law):
    _, model, values, of_pairs, of_floor = LAWS[law]
    contact = f"{model} {digits(values)} {MU} 1 predict"
    text = lammps_box(DT, skin=0.002)
    text += f"""
pair_style gran/cfpm {contact} {of_pairs}
pair_coeff * *
fix floor all wall/gran/cfpm {contact} {of_floor} zplane 0.0 NULL
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
"""
    return text


DECKS = {"liggghts": in_liggghts, "lammps": in_lammps}


def end(host, folder, law, disturbance=0.0):
    """Where the spheres of start() are after STEPS: (50, 3)."""
    write_data(folder / "spheres.data", start(disturbance), low=-SIDE / 2, high=SIDE / 2, types=1)
    HOSTS[host].run(DECKS[host](law) + dump(STEPS, host=host) + f"run {STEPS}\n", folder)
    return read_motion(folder / "motion.dump", ("x", "y", "z"))[1][-1]


def bound(undisturbed, disturbed):
    """How far rounding alone may move the ends of two hosts apart. disturbed: the end with a DISTURBANCE."""
    growth = np.abs(disturbed - undisturbed).max() / DISTURBANCE
    return STEPS * TERMS * np.finfo(float).eps * SIDE * max(growth, 1.0)
