# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse, where particles move by much of their radius in a step.

As far as the lists reach, by contact_distance_factor and half of the skin, their contacts begin at the touch, at any
such move; beyond that late, as without onset. No run stops for it; the end of the run tells how often it was.
"""

import numpy as np
import pytest
from harness.impacts import SPEED
from harness.liggghts import run
from harness.long_moves import DT, FIRST, RADIUS, TEXT, deck, velocities
from harness.spheres import write_stl
from small_deck import MODEL, PAIR, WALL, write
from test_impulse import CASES, NAMES, TOLERANCE, restitutions

LOOPS = ["", " rolling_friction cdt"]  # the second takes the host's own loop
MATERIAL = "fix rolling all property/global coefficientRollingFriction peratomtypepair 1 0\n"


def with_models(text, models):
    text = text.replace("pair_style", MATERIAL + "pair_style")
    return text.replace("tangential history", "tangential history" + models)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("models", LOOPS)
@pytest.mark.parametrize("phase", [0.1, 0.9])
def test_within_reach(tmp_path, phase, models, ranks):
    move = 0.4 * RADIUS
    text = deck("liggghts", move, (1.0 + phase) * move, skin=2.0 * (move - 0.1 * RADIUS) * 1.01)
    process = run(with_models(text, models), tmp_path, np=ranks)
    end = velocities(tmp_path)[-1]
    assert np.abs(end - [[0.0, 0.0, 0.0], [move / DT, 0.0, 0.0]]).max() <= 1e-9 * move / DT
    assert not FIRST.search(process.stdout) and not TEXT.search(process.stdout), process.stdout


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("models", LOOPS)
@pytest.mark.parametrize("part", [0.4, 1.2])
def test_beyond(tmp_path, part, models, ranks):
    """The move into the contact begins with a gap that no list reaches over."""
    move, skin = part * RADIUS, 0.002
    reach = 0.5 * skin + 0.1 * RADIUS
    found = {}
    for onset in ("on", "off"):
        text = deck("liggghts", move, 1.8 * move, skin, f" onset {onset}")
        process = run(with_models(text, models), tmp_path, np=ranks)
        found[onset] = np.array(velocities(tmp_path))
        if onset == "off":
            assert not FIRST.search(process.stdout) and not TEXT.search(process.stdout), process.stdout
            continue
        moves = np.linalg.norm(found[onset], axis=2) * DT
        count, passing, passed_by, more = TEXT.search(process.stdout).groups()
        assert len(TEXT.findall(process.stdout)) == 1 and FIRST.findall(process.stdout) == ["0"]
        assert int(count) == (moves > reach).sum() > 0
        assert int(passing) == (moves > RADIUS).sum()
        assert (passed_by is not None) == (int(passing) > 0)
        assert float(more) == pytest.approx(2.0 * (moves.max() - reach), rel=1e-2)
    assert np.array_equal(found["on"], found["off"])


@pytest.mark.parametrize("case", [CASES[2], CASES[5]], ids=[NAMES[2], NAMES[5]])
def test_restitution_at_walls(tmp_path, case):
    """Spheres that move by 0.8 of their radius in a step, on a plane and on a mesh, and pairs that come together so."""
    material, model, settings, expected = case
    found = restitutions(tmp_path, material, model, settings, 0.8 * 0.005 / SPEED, skin=0.01)
    assert np.abs(found - expected).max() <= TOLERANCE


DRIVEN = "fix integrate one nve/cfpm\nfix drive two move linear 0 0 600"
MOVING_MESH = f"""fix plate all mesh/surface file plate.stl type 1
fix drive all move/mesh mesh plate linear 0 0 300
{WALL}{MODEL} mesh n_meshes 1 meshes plate"""

# what moves too far for lists that reach 2.5 mm and half of the skin: in a step of 10 us, at a radius of 25 and 50 mm
TOO_FAST = {
    "pairs": ({}, 600),
    "driven": ({"wall": "", "integrator": DRIVEN}, 0),
    "mesh": ({"wall": MOVING_MESH}, 0),
    "planes": ({"neighbor": "neighbor 0.001 bin\nneigh_modify delay 0"}, 150),
}


@pytest.mark.parametrize("case", TOO_FAST)
def test_whoever_moves(tmp_path, case):
    changes, speed = TOO_FAST[case]
    write_stl(tmp_path / "plate.stl", [(-0.9, -0.9, -0.5), (0.9, -0.9, -0.5), (0.9, 0.9, -0.5), (-0.9, 0.9, -0.5)])
    start = {"pair": f"{PAIR}{MODEL} predict impulse", "neighbor": "neighbor 0.0005 bin\nneigh_modify delay 0"}
    start["run"] = f"velocity one set 0 0 {speed} units box\nrun 3"
    process = run(write(**{**start, **changes}), tmp_path)
    assert int(TEXT.search(process.stdout).group(1)) > 0, process.stdout


@pytest.mark.parametrize("late", ["delay 10", "delay 0 every 2"])
def test_lists_that_the_host_would_make_late(tmp_path, late):
    """They are asked for in time."""
    move = 0.05 * RADIUS
    text = deck("liggghts", move, 9.5 * move, 0.002).replace("neigh_modify delay 0", f"neigh_modify {late}")
    run(text.replace("run 10", "run 20"), tmp_path)
    assert np.abs(velocities(tmp_path)[-1] - [[0.0] * 3, [move / DT, 0.0, 0.0]]).max() <= 1e-9 * move / DT


# places and moves in a step over the radius, in the plane across the edge of a plate to the left of it; all pass by
PASSING = {
    "beside": ((0.5, 1.5), (0.75, -0.95)),
    "from the face over the edge": ((-0.1, 1.4), (0.9, -0.6)),
}


@pytest.mark.parametrize("case", PASSING)
def test_past_the_edge_of_a_mesh(tmp_path, case):
    """Where the plane through the nearest point of the mesh would be met, but not the mesh."""
    (x, z), (u, w) = PASSING[case]
    write_stl(tmp_path / "plate.stl", [(-0.2, -0.2, 0), (0, -0.2, 0), (0, 0.2, 0), (-0.2, 0.2, 0)])
    speed = RADIUS / DT
    changes = {
        "pair": f"{PAIR}{MODEL} predict impulse",
        "neighbor": "neighbor 0.06 bin\nneigh_modify delay 0",
        "particles": f"create_atoms 1 single {x * RADIUS} 0.01 {z * RADIUS} units box\n"
        f"set type 1 diameter {2 * RADIUS} density 800\nvelocity all set {u * speed} 0 {w * speed} units box",
        "wall": f"fix plate all mesh/surface file plate.stl type 1\n{WALL}{MODEL} mesh n_meshes 1 meshes plate",
        "extra": 'dump d all custom 1 motion.dump id vx vy vz\ndump_modify d sort id format "%d %.17g %.17g %.17g"',
        "run": "run 3",
    }
    run(write(**changes), tmp_path)
    assert np.array_equal(velocities(tmp_path)[-1], velocities(tmp_path)[0])
