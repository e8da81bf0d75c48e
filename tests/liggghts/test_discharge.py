# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/liggghts/in.discharge and the mesh of its floor. Both hosts together: tests/lammps/test_discharge.py."""

import re
import sys
from collections import Counter

import numpy as np
import pytest
from harness.decks import MESH
from harness.discharge import SPHERES, discharge, settled_bed
from harness.liggghts import run
from harness.output import read_dump, vectors
from harness.spheres import Sphere, box, write_data

sys.path.insert(0, str(MESH.parent))
import floor_with_hole  # noqa: E402

SIDE, RADIUS, POINTS = 0.3, 0.1, 64
PRECISION = 1.0e-10  # of a coordinate in the file


@pytest.fixture(scope="module")
def bed(tmp_path_factory):
    return settled_bed(tmp_path_factory.mktemp("bed") / "packing")


@pytest.fixture(scope="module")
def triangles():
    """As printed: corners that are one point have the same digits. (triangles, 3 corners, x y z)"""
    corners = [tuple(line.split()[1:]) for line in MESH.read_text().splitlines() if line.startswith("vertex")]
    return np.array(corners).reshape(-1, 3, 3)


def test_script_makes_the_mesh():
    assert floor_with_hole.stl() == MESH.read_text()


def test_mesh_is_a_square_with_a_hole(triangles):
    x, y, z = np.moveaxis(triangles.astype(float), -1, 0)
    assert np.all(z == 0)
    cross = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    assert np.all(cross > 0), "a triangle that faces down, or none"
    polygon = POINTS / 2 * RADIUS**2 * np.sin(2 * np.pi / POINTS)
    assert cross.sum() / 2 == pytest.approx(SIDE**2 - polygon, abs=2 * SIDE * PRECISION)
    assert (x.min(), x.max(), y.min(), y.max()) == (0, SIDE, 0, SIDE)


def test_edges_meet_and_the_rim_is_round(triangles):
    """An edge of one triangle only lies on the rim or on the border; there it has one opposite in the next image."""
    edges = Counter(frozenset((tuple(t[k]), tuple(t[(k + 1) % 3]))) for t in triangles for k in range(3))
    assert set(edges.values()) == {1, 2}
    free = [np.array(sorted(edge), dtype=float)[:, :2] for edge, times in edges.items() if times == 1]
    on_border = [e for e in free if any(np.all(e[:, d] == at) for d in (0, 1) for at in (0, SIDE))]
    rim = [e for e in free if not any(e is border for border in on_border)]
    assert len(rim) == POINTS
    points = np.unique(np.concatenate(rim), axis=0)
    assert len(points) == POINTS
    assert np.hypot(*(points - SIDE / 2).T) == pytest.approx(RADIUS, abs=PRECISION)
    angles = np.sort(np.arctan2(*(points - SIDE / 2).T))
    assert np.diff(angles) == pytest.approx(2 * np.pi / POINTS, abs=1e-8)
    for d in (0, 1):
        low, high = (sorted(tuple(sorted(e[:, 1 - d])) for e in on_border if np.all(e[:, d] == at)) for at in (0, SIDE))
        assert low == high and sum(b - a for a, b in low) == pytest.approx(SIDE)


@pytest.mark.parametrize("ranks", [1, 2])
def test_carries_spheres_like_a_plane_across_the_border(tmp_path, ranks):
    """On faces, edges and corners of the cell and of triangles: held up once. Over the hole: not at all."""
    places = [(0, 0), (0.0005, 0.1), (0.2999, 0.2), (0.15, 0.0002), (0.1, 0.2999), (0.06, 0.06), (0.24, 0.24)]
    places += [(0.27, 0.15)]  # an edge inside the cell
    forces = {}
    for wall, floor in {"mesh": "mesh n_meshes 1 meshes plate", "plane": "primitive type 1 zplane 0.0"}.items():
        folder = tmp_path / wall
        folder.mkdir()
        spheres = [Sphere(x=(x, y, 0.0249), density=800.0) for x, y in [*places, (0.15, 0.15)]]
        write_data(folder / "spheres.data", spheres, low=0.0, high=SIDE, types=1)
        model = "model hooke/stiffness tangential history"
        run(
            f"""
{box(1e-6, boundary="p p f").replace("processors * 1 1", "processors * * 1")}
fix kn all property/global kn peratomtypepair 1 1e6
fix kt all property/global kt peratomtypepair 1 4e5
fix gn all property/global gamman_abs peratomtypepair 1 0
fix gt all property/global gammat_abs peratomtypepair 1 0
fix mu all property/global coefficientFriction peratomtypepair 1 0.3
fix plate all mesh/surface file {MESH} type 1
pair_style gran/cfpm {model} absolute_damping on
pair_coeff * *
fix floor all wall/gran/cfpm {model} {floor} absolute_damping on
fix integrate all nve/cfpm
dump f all custom 1 forces.dump id fx fy fz
dump_modify f sort id format "%d %.17g %.17g %.17g"
run 1
""",
            folder,
            np=ranks,
        )
        forces[wall] = vectors(read_dump(folder / "forces.dump")[0][1], "fx", "fy", "fz")
    assert forces["plane"][:, 2] == pytest.approx(100.0, rel=1e-3)
    assert forces["mesh"][:-1] == pytest.approx(forces["plane"][:-1], abs=1e-6)
    assert np.all(forces["mesh"][-1] == 0)


def test_takes_the_mesh_and_draws(tmp_path, bed):
    _, log = discharge(tmp_path / "run", "liggghts", bed, duration=0.05, picture=1)
    assert f"{floor_with_hole.POINTS * 2} triangle" in log
    assert len(list((tmp_path / "run").glob("discharge.*.ppm"))) == 5


def test_missing_files_stop_it(tmp_path, bed):
    for name, what in {"mesh": "none.stl", "bed": "none.data"}.items():
        files = {"bed": bed, name: what}
        _, log = discharge(tmp_path / name, "liggghts", check=False, **files)
        assert re.search(f"ERROR.*annot open.*{what}", log), log[-1000:]


def test_bed_of_another_column_stops_it(tmp_path):
    wide = settled_bed(tmp_path / "wide", n=2 * SPHERES, duration=0.01)
    _, log = discharge(tmp_path / "run", "liggghts", wide, check=False)
    assert "ERROR: the floor fits a bed in a column of 0.3 m" in log
