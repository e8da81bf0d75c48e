# SPDX-License-Identifier: GPL-2.0-or-later
"""Looking at a run does not change it, to the last digit.

Pressure is asked of the forces of the step itself, compute pair/gran/local evaluates them again: contact history must
advance once per step with both, and whatever loop over the pairs serves them must give the same forces.
"""

import falling_bed as bed
import numpy as np
import pytest
from harness.liggghts import run
from harness.output import read_dump, vectors

PRESSURE = """
compute temperature all temp
compute pressure all pressure temperature
thermo_style custom step ke c_pressure
thermo 7
"""


@pytest.mark.parametrize(
    "predict, ranks",
    [("exact", 1), ("exact", 2), ("exact onset on", 2), ("impulse", 1), ("impulse split 0.2", 2)],
)
def test_output_is_passive(tmp_path, predict, ranks):
    bed.write(tmp_path)
    styles = {**bed.PREDICTED, "predict": predict}
    deck = bed.box() + bed.pair(styles) + bed.fixes(styles, wall="mesh")
    run(deck + bed.dump_particles("silent.dump") + f"run {bed.STEPS}\n", tmp_path, np=ranks)
    deck += bed.CONTACTS + bed.dump_contacts(every=10) + PRESSURE
    run(deck + bed.dump_particles("watched.dump") + f"run {bed.STEPS}\n", tmp_path, np=ranks)
    bed.assert_same_text(tmp_path / "watched.dump", tmp_path / "silent.dump", "output changed the run")


@pytest.mark.parametrize("model", [bed.HOOKE, "model hertz tangential history", "model hooke tangential no_history"])
@pytest.mark.parametrize("predict", ["exact", "exact onset on", "impulse"])
def test_storing_the_forces_of_a_wall_is_passive(tmp_path, predict, model):
    """Contacts with a plane are computed together, unless somebody reads the force of each."""
    bed.write(tmp_path)
    styles = {**bed.PREDICTED, "predict": predict}
    for name, settings in ("together", ""), ("one_by_one", "store_force yes"):
        deck = bed.box() + bed.pair(styles, model) + bed.fixes(styles, model, settings)
        run(deck + bed.dump_particles(f"{name}.dump") + f"run {bed.STEPS}\n", tmp_path)
    bed.assert_same_text(tmp_path / "together.dump", tmp_path / "one_by_one.dump", "the forces differ")


@pytest.mark.parametrize("rolling", ["off", "epsd2"])
@pytest.mark.parametrize("predict", ["exact", "exact onset on", "impulse"])
def test_setup_is_passive(tmp_path, predict, rolling):
    """However often the forces of one state are evaluated before a run."""
    bed.write(tmp_path)
    styles = {**bed.PREDICTED, "predict": predict}
    model = f"{bed.HOOKE} rolling_friction {rolling}"
    deck = bed.box() + bed.pair(styles, model) + bed.fixes(styles, model, wall="mesh") + f"run {bed.STEPS // 2}\n"
    for name, evaluations in ("once", ""), ("often", "run 0\nrun 0\n"):
        run(deck + evaluations + bed.dump_particles(f"{name}.dump") + f"run {bed.STEPS // 2}\n", tmp_path)
    bed.assert_same_text(tmp_path / "often.dump", tmp_path / "once.dump", "the springs moved")


@pytest.mark.parametrize("rolling", ["off", "cdt", "epsd", "epsd2"])
@pytest.mark.parametrize("predict", ["exact", "rk4", "impulse"])
def test_two_runs_are_one(tmp_path, predict, rolling):
    """But for rounding: lists are built anew. Stock moves the spheres by 30 um. The host adds a step to the torque of a
    rolling spring (epsd, epsd2) at the start of a run, which would move them by 0.6 um, were it not kept from that: at
    the cost of 1e-12 of the torque where the spring is at its limit, far below what is compared."""
    bed.write(tmp_path)
    styles = {**bed.PREDICTED, "predict": predict}
    model = f"{bed.HOOKE} rolling_friction {rolling}"
    deck = bed.box() + bed.pair(styles, model) + bed.fixes(styles, model)
    ends = []
    for runs in ("run 1100\n", "run 1000\nrun 0\nrun 100\n"):
        run(deck + bed.dump_particles(every=1100) + runs, tmp_path)
        step, columns = read_dump(tmp_path / "bed.dump")[-1]
        assert step == 1100
        ends.append(vectors(columns, "x", "y", "z"))
    way = ends[1] - ends[0]
    way[:, :2] -= bed.SIDE * np.round(way[:, :2] / bed.SIDE)
    assert np.abs(way).max() < 1e-14
