# SPDX-License-Identifier: GPL-2.0-or-later
"""A run continued from a restart file is the run that went on, to the last digit, on one rank.

The first process goes on with a new "run" after write_restart, so both set up at the same step: both sort their
particles there, rebuild their neighbour lists and evaluate the forces of that step from positions and history.
(The host's other command, "restart N file", writes inside a run the history of the step before: from there neither
stock nor the plugin goes on exactly.) Fixes are not in the restart file and are given again; those that keep contact
history find it by their id.
"""

import falling_bed as bed
import numpy as np
import pytest
from harness.liggghts import LAUNCHER, STOCK, run

HALF = bed.STEPS // 2
SETTINGS = "limitForce on"  # not a default, so a continuation without it shows
DUMPS = ("bed.dump", "contacts.dump")


def second_half():
    return bed.dump_particles() + bed.dump_contacts() + f"run {HALF}\n"


def go_on(folder, styles, wall="plane", program=LAUNCHER, model=bed.HOOKE):
    """The run that goes on; leaves bed.restart in the folder."""
    folder.mkdir()
    bed.write(folder)
    deck = bed.box() + bed.pair(styles, model, SETTINGS) + bed.fixes(styles, model, SETTINGS, wall)
    run(deck + bed.CONTACTS + f"run {HALF}\nwrite_restart bed.restart\n" + second_half(), folder, program=program)
    start, _, end = bed.read_contacts(folder / "contacts.dump")
    assert sum(np.any(spring) for spring in start.values()) > 100 and end, "a restart without sliding contacts"


def continue_from(origin, folder, styles, reissue=True, wall="plane", model=bed.HOOKE):
    """A new process; reissue: with the pair style in its deck."""
    folder.mkdir()
    bed.write_floor(folder / "floor.stl")
    deck = bed.box(f"read_restart {origin}/bed.restart")
    deck += bed.pair(styles, model, SETTINGS) if reissue else ""
    run(deck + bed.fixes(styles, model, SETTINGS, wall) + bed.CONTACTS + second_half(), folder)


@pytest.mark.parametrize("reissue", [True, False], ids=["pair_style", "no_pair_style"])
@pytest.mark.parametrize(
    "predict, wall, model",
    [
        ("exact", "plane", "hooke"),
        ("rk4", "mesh", "hooke"),
        ("none", "plane", "hooke"),
        ("rk2", "plane", "hertz"),
        ("rk4", "mesh", "hertz/stiffness"),
        ("exact onset on", "mesh", "hooke"),
        ("rk4 onset on", "plane", "hertz"),
        ("impulse", "plane", "hooke"),
        ("impulse", "mesh", "hertz"),
        ("impulse split 0.5", "plane", "hooke"),
        ("impulse split 1 onset off", "mesh", "hertz"),
    ],
)
def test_continues_to_the_last_digit(tmp_path, predict, wall, model, reissue):
    styles = {**(bed.UNPREDICTED if predict == "none" else bed.PREDICTED), "predict": predict}
    model = f"model {model} tangential history"
    go_on(tmp_path / "on", styles, wall, model=model)
    continue_from(tmp_path / "on", tmp_path / "again", styles, reissue, wall, model)
    for name in DUMPS:
        bed.assert_same_text(tmp_path / "again" / name, tmp_path / "on" / name, f"{name} differs")


def test_predictors_differ_from_there(tmp_path):
    """Otherwise the comparison above could not tell whether the predictor came out of the restart file."""
    go_on(tmp_path / "rk4", {**bed.PREDICTED, "predict": "rk4"})
    continue_from(tmp_path / "rk4", tmp_path / "exact", {**bed.PREDICTED, "predict": "exact"})
    same = (tmp_path / "rk4" / "bed.dump").read_bytes() == (tmp_path / "exact" / "bed.dump").read_bytes()
    assert not same


def test_wall_with_a_history_of_another_size(tmp_path):
    """The host tells them apart."""
    exact = {**bed.PREDICTED, "predict": "exact"}
    go_on(tmp_path / "exact", exact)
    styles = bed.fixes(exact, bed.HOOKE, SETTINGS, "plane").replace("primitive", "predict impulse primitive")
    deck = bed.box(f"read_restart {tmp_path}/exact/bed.restart") + bed.pair(exact, bed.HOOKE, SETTINGS) + styles
    process = run(deck + "run 1\n", tmp_path, check=False)
    assert process.returncode > 0
    assert "(id history_floor): restarted fix has incompatible data size" in process.stdout


def test_stock_bed_goes_on_under_the_plugin(tmp_path):
    """The history has the same form: unpredicted, the plugin goes on as stock does; predicted, it starts from it."""
    go_on(tmp_path / "stock", bed.STOCK, program=STOCK)
    continue_from(tmp_path / "stock", tmp_path / "unpredicted", bed.UNPREDICTED)
    for name in DUMPS:
        bed.assert_same_text(tmp_path / "unpredicted" / name, tmp_path / "stock" / name, f"{name} differs")

    continue_from(tmp_path / "stock", tmp_path / "predicted", bed.PREDICTED)
    stock, predicted = (bed.read_contacts(tmp_path / name / "contacts.dump") for name in ("stock", "predicted"))
    assert stock[0].keys() == predicted[0].keys()
    for pair, spring in stock[0].items():
        np.testing.assert_array_equal(predicted[0][pair], spring)
    lasting = stock[0].keys() & predicted[1].keys()
    assert sum(np.any(predicted[1][pair]) for pair in lasting) > 50


SHAKEN = "fix nve/cfpm: a bed at rest will move, as below nt = 6 with predict impulse its overlaps are those"


def test_warns_where_the_step_changes_overlaps_at_rest(tmp_path):
    """Between runs, and between the run of a restart file and the next."""
    few = f"timestep {bed.TIME_STEP * 5}\n"  # 4 steps per contact
    bed.write(tmp_path)
    styles = {**bed.PREDICTED, "predict": "impulse"}
    pair, fixes = bed.pair(styles, bed.HOOKE, SETTINGS), bed.fixes(styles, bed.HOOKE, SETTINGS, "plane")
    runs = "run 1\nrun 1\nwrite_restart bed.restart\n" + few + pair + "run 1\nrun 1\n"
    assert run(bed.box() + pair + fixes + runs, tmp_path).stdout.count(SHAKEN) == 1
    again = bed.box("read_restart bed.restart")
    assert SHAKEN not in run(again + fixes + "run 1\n", tmp_path).stdout
    for pair_again in ("", pair):
        assert run(again + pair_again + fixes + few + "run 1\n", tmp_path).stdout.count(SHAKEN) == 1
    anew = "clear\n" + bed.box() + pair + fixes + few
    assert SHAKEN not in run(bed.box() + pair + fixes + "run 1\n" + anew + "run 1\n", tmp_path).stdout
