# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs of spheres through the host against the reference scheme (tests/core/reference_scheme.cpp), step by step: the
same scenes and the same tolerance as tests/liggghts/test_collisions.py derives them."""

import importlib.util
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from lammps import run
from spheres import MOTION, Law, digits, largest_error, read_motion, reduced_mass, reference

_file = Path(__file__).resolve().parents[1] / "liggghts" / "test_collisions.py"
_spec = importlib.util.spec_from_file_location("liggghts_collisions", _file)
scenes = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(scenes)

PAIRS = {name: bodies for name, bodies in scenes.CASES.items() if len(scenes.spheres_of(bodies)) == 2}
LAWS = {  # as in the deck: Kn Kt gamma_n gamma_t xmu dampflag
    "hooke": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 1),
    "hooke_undamped_slip": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 0),
    "hertz": (3.5e7, 1.2e7, 1.2e5, 5.0e4, 0.4, 1),
}
PREDICTIONS = [(p, law) for law in LAWS for p in (("rk2", "rk4") if law == "hertz" else scenes.PREDICTORS)]


def law_of(name, bodies):
    kn, kt, gn, gt, mu, dampflag = LAWS[name]
    m = reduced_mass(*bodies)
    root = np.sqrt(1.0 / sum(1.0 / s.radius for s in bodies)) if name == "hertz" else 1.0
    values = [root * value for value in (kn, m * gn, kt, dampflag * m * gt)]
    return Law(*values, mu, "hertz/stiffness" if name == "hertz" else "linear")


def write_data(path, spheres):
    lines = ["spheres", "", f"{len(spheres)} atoms", "2 atom types", ""]
    lines += [f"-0.5 0.5 {c}lo {c}hi" for c in "xyz"]
    lines += ["", "Atoms", ""]
    lines += [f"{k} {s.type} {digits(2 * s.radius, s.density, s.x)}" for k, s in enumerate(spheres, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{k} {digits(s.v, s.omega)}" for k, s in enumerate(spheres, 1)]
    path.write_text("\n".join(lines) + "\n")


def deck(predictor, law, newton):
    style = f"gran/cfpm {law.split('_')[0]} {digits(LAWS[law][:5])} {LAWS[law][5]} predict {predictor}"
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
pair_style {style}
pair_coeff * *
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
        write_data(folder / "spheres.data", [s for bodies in PAIRS.values() for s in bodies])
        run(deck(predictor, law, newton), folder, np=ranks)
        _, everything = read_motion(folder / "motion.dump")
        return {name: everything[:, 2 * k : 2 * k + 2] for k, name in enumerate(PAIRS)}

    return motion


@pytest.mark.parametrize("case", PAIRS)
@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("predictor, law", PREDICTIONS)
def test_host_moves_as_the_reference(host, predictor, law, newton, ranks, case):
    bodies = PAIRS[case]
    expected = reference(predictor, law_of(law, bodies), bodies, [(scenes.DT, scenes.STEPS)], scenes.GRAVITY)
    error = largest_error(host(predictor, law, newton, ranks)[case], expected, bodies, scenes.SPEED)
    assert error <= scenes.TOLERANCE, f"{error:.1e}"
