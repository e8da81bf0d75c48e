# SPDX-License-Identifier: GPL-2.0-or-later
"""Single collisions of spheres with each other, with a plane and with regions at rest and moving, through the host
against the reference scheme (tests/core/reference_scheme.cpp), step by step: the scenes of
tests/liggghts/test_collisions.py and the tolerance that is derived there."""

import importlib.util
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from lammps import run
from spheres import MOTION, Law, digits, largest_error, read_motion, reduced_mass, reference, write_data

_file = Path(__file__).resolve().parents[1] / "liggghts" / "test_collisions.py"
_spec = importlib.util.spec_from_file_location("liggghts_collisions", _file)
scenes = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(scenes)

LAWS = {  # as in the deck: Kn Kt gamma_n gamma_t xmu dampflag
    "hooke": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 1),
    "hooke_undamped_slip": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 0),
    "hertz": (3.5e7, 1.2e7, 1.2e5, 5.0e4, 0.4, 1),
}
PREDICTIONS = [(p, law) for law in LAWS for p in (("rk2", "rk4") if law == "hertz" else scenes.PREDICTORS)]


def law_of(name, bodies):
    kn, kt, gn, gt, mu, dampflag = LAWS[name]
    spheres = scenes.spheres_of(bodies)  # a wall is flat and does not move
    m = reduced_mass(*spheres)
    root = np.sqrt(1.0 / sum(1.0 / s.radius for s in spheres)) if name == "hertz" else 1.0
    values = [root * value for value in (kn, m * gn, kt, dampflag * m * gt)]
    return Law(*values, mu, "hertz/stiffness" if name == "hertz" else "linear")


def on(wall):
    """Ids of the spheres of the scenes with that wall: a plane of this host has no end and would reach the others."""
    ids, first = [], 1
    for bodies in scenes.CASES.values():
        count = len(scenes.spheres_of(bodies))
        ids += range(first, first + count) if wall in bodies else []
        first += count
    return " ".join(map(str, ids))


def deck(predictor, law, newton):
    contact = f"{law.split('_')[0]} {digits(LAWS[law][:5])} {LAWS[law][5]} predict {predictor}"
    point, normal = digits(scenes.MOVING.x), digits(scenes.MOVING.normal)
    moves = "\n".join(f"variable {c} equal {float(v)!r}*step*{scenes.DT!r}" for c, v in zip("xyz", scenes.MOVING.v))
    return f"""
units si
atom_style sphere
boundary f f f
newton {newton}
comm_modify vel yes
read_data spheres.data
neighbor 0.01 bin
neigh_modify delay 0
timestep {scenes.DT!r}
pair_style gran/cfpm {contact}
pair_coeff * *
{moves}
region tilted plane {digits(scenes.TILTED.x)} {digits(scenes.TILTED.normal)} units box
region moving plane {point} {normal} units box move v_x v_y v_z
group floor id {on(scenes.FLOOR)}
group tilted id {on(scenes.TILTED)}
group moving id {on(scenes.MOVING)}
fix floor floor wall/gran/cfpm {contact} zplane 0.0 NULL
fix tilted tilted wall/gran/cfpm {contact} region tilted
fix moving moving wall/gran/cfpm {contact} region moving
fix gravity all gravity {np.linalg.norm(scenes.GRAVITY)} vector {digits(scenes.GRAVITY)}
fix integrate all nve/cfpm
dump motion all custom 1 motion.dump id {" ".join(MOTION)}
dump_modify motion sort id format float %.17g
run {scenes.STEPS}
"""


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    @lru_cache(maxsize=None)
    def motion(predictor, law, newton, ranks):
        folder = tmp_path_factory.mktemp("collisions")
        every = [s for bodies in scenes.CASES.values() for s in scenes.spheres_of(bodies)]
        write_data(folder / "spheres.data", every, low=-0.5, high=0.5)
        run(deck(predictor, law, newton), folder, np=ranks)
        _, everything = read_motion(folder / "motion.dump")
        return scenes.by_case(everything)

    return motion


@pytest.mark.parametrize("case", scenes.CASES)
@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("predictor, law", PREDICTIONS)
def test_host_moves_as_the_reference(host, predictor, law, newton, ranks, case):
    bodies = scenes.CASES[case]
    expected = reference(predictor, law_of(law, bodies), bodies, [(scenes.DT, scenes.STEPS)], scenes.GRAVITY)
    error = largest_error(host(predictor, law, newton, ranks)[case], expected, bodies, scenes.SPEED)
    assert error <= scenes.TOLERANCE, f"{error:.1e}"
