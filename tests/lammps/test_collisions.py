# SPDX-License-Identifier: GPL-2.0-or-later
"""Single collisions of spheres with each other, with a plane and with regions at rest and moving, through the host
against the reference scheme (tests/core/reference_scheme.cpp), step by step: the scene and the tolerance of
harness/collisions.py."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from harness import collisions as scene
from harness.lammps import run
from harness.spheres import MOTION, PREDICTORS, Law, digits, dump, lammps_box, largest_error, read_motion
from harness.spheres import reduced_mass, reference

LAWS = {  # as in the deck: Kn Kt gamma_n gamma_t xmu dampflag
    "hooke": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 1),
    "hooke_undamped_slip": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 0),
    "hooke/nohistory": (1.2e5, 4.0e4, 400.0, 150.0, 0.4, 1),
    "hertz": (3.5e7, 1.2e7, 1.2e5, 5.0e4, 0.4, 1),
}
PREDICTIONS = [(p, law) for law in LAWS for p in (("rk2", "rk4") if law == "hertz" else PREDICTORS)]


def law_of(name, bodies):
    kn, kt, gn, gt, mu, dampflag = LAWS[name]
    spheres = scene.spheres_of(bodies)  # a wall is flat and does not move
    kt = 0.0 if name == "hooke/nohistory" else kt
    m = reduced_mass(*spheres)
    root = np.sqrt(1.0 / sum(1.0 / s.radius for s in spheres)) if name == "hertz" else 1.0
    values = [root * value for value in (kn, m * gn, kt, dampflag * m * gt)]
    return Law(*values, mu, "hertz/stiffness" if name == "hertz" else "linear", together=True)


def on(wall):
    """Ids of the spheres of the scenes with that wall: a plane of this host has no end and would reach the others."""
    ids, first = [], 1
    for bodies in scene.CASES.values():
        count = len(scene.spheres_of(bodies))
        ids += range(first, first + count) if wall in bodies else []
        first += count
    return " ".join(map(str, ids))


def deck(predictor, law, newton, limit):
    contact = f"{law.split('_')[0]} {digits(LAWS[law][:5])} {LAWS[law][5]} {limit} predict {predictor}"
    point, normal = digits(scene.MOVING.x), digits(scene.MOVING.normal)
    moves = "\n".join(f"variable {c} equal {float(v)!r}*step*{scene.DT!r}" for c, v in zip("xyz", scene.MOVING.v))
    text = lammps_box(scene.DT, newton=newton)
    text += f"""
pair_style gran/cfpm {contact}
pair_coeff * *
{moves}
region tilted plane {digits(scene.TILTED.x)} {digits(scene.TILTED.normal)} units box
region moving plane {point} {normal} units box move v_x v_y v_z
group floor id {on(scene.FLOOR)}
group tilted id {on(scene.TILTED)}
group moving id {on(scene.MOVING)}
fix floor floor wall/gran/cfpm {contact} zplane 0.0 NULL
fix tilted tilted wall/gran/cfpm {contact} region tilted
fix moving moving wall/gran/cfpm {contact} region moving
fix gravity all gravity {np.linalg.norm(scene.GRAVITY)} vector {digits(scene.GRAVITY)}
fix integrate all nve/cfpm
"""
    return text + dump(columns=MOTION, host="lammps") + f"run {scene.STEPS}\n"


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    @lru_cache(maxsize=None)
    def motion(predictor, law, newton, ranks, limit):
        folder = tmp_path_factory.mktemp("collisions")
        scene.write_spheres(folder)
        run(deck(predictor, law, newton, limit), folder, np=ranks)
        _, everything = read_motion(folder / "motion.dump")
        return scene.by_case(everything)

    return motion


HOSTS = [("off", 1, "limit_damping"), ("on", 2, "limit_damping"), ("on", 2, "")]


@pytest.mark.parametrize("case", scene.CASES)
@pytest.mark.parametrize("newton, ranks, limit", HOSTS)
@pytest.mark.parametrize("predictor, law", PREDICTIONS)
def test_host_moves_as_the_reference(host, predictor, law, newton, ranks, limit, case):
    """Without limit_damping contacts pull until the bodies part."""
    bodies = scene.CASES[case]
    expected_law = replace(law_of(law, bodies), tension=not limit)
    expected = reference(predictor, expected_law, bodies, [(scene.DT, scene.STEPS)], scene.GRAVITY)
    error = largest_error(host(predictor, law, newton, ranks, limit)[case], expected, bodies, scene.SPEED)
    assert error <= scene.TOLERANCE, f"{error:.1e}"
