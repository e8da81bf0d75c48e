# SPDX-License-Identifier: GPL-2.0-or-later
"""With "predict none" the plugin's styles are the stock styles, to the last digit.

That covers all that the plugin does around a force: geometry, history, rebuilds, exchange between ranks, walls,
cohesion, rolling friction and settings. test_mutations.py shows that the comparison notices lost history.
"""

import falling_bed as bed
import numpy as np
import pytest
from harness.instruction_sets import SETS
from harness.liggghts import LAUNCHER, STOCK, run
from harness.output import read_dump, rebuilds

# model, settings, history values of a pair
MODELS = {
    "hooke": (bed.HOOKE, "limitForce on", 3),
    "stiffness": ("model hooke/stiffness tangential history", "tangential_damping off", 3),
    "rolling": ("model hooke/stiffness tangential history cohesion sjkr rolling_friction epsd", "", 6),
    "hertz": ("model hertz tangential history", "limitForce on", 3),
    "hertz_stiffness": ("model hertz/stiffness tangential history", "tangential_damping off", 3),
    "hertz_rolling": ("model hertz tangential history cohesion sjkr rolling_friction epsd", "", 6),
    "no_history": ("model hooke tangential no_history", "", 0),
}
MORE = {
    "hertz_no_history": ("model hertz tangential no_history", "", 0),
    "off": ("model hooke tangential off", "ktToKnUser on", 0),
    "heating": (bed.HOOKE, "heating_normal_hooke on", 3),
}
ALL = {**MODELS, **MORE}
FREEZE = """
region low block INF INF INF INF INF 0.02 units box
group base region low
group active subtract all base
fix hold base freeze
unfix integrate
fix integrate active nve/sphere
"""


def fall(folder, styles, program, case, wall="plane", ranks=1, more=""):
    folder.mkdir()
    bed.write(folder)
    model, settings, values = ALL[case]
    deck = bed.box() + bed.pair(styles, model, settings) + bed.fixes(styles, model, settings, wall)
    deck += bed.dump_particles() + (bed.CONTACTS + bed.dump_contacts(values) if values else "")
    return run(deck + more + f"run {bed.STEPS}\n", folder, np=ranks, program=program)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("wall", ["plane", "mesh"])
@pytest.mark.parametrize("case", MODELS)
def test_equals_stock(tmp_path, case, wall, ranks):
    stock = fall(tmp_path / "stock", bed.STOCK, STOCK, case, wall, ranks)
    cfpm = fall(tmp_path / "cfpm", bed.UNPREDICTED, LAUNCHER, case, wall, ranks)
    assert_same_dumps(tmp_path, case)
    assert rebuilds(cfpm.stdout)[-1] == rebuilds(stock.stdout)[-1] > 20
    if MODELS[case][2]:
        assert_history_was_carried(tmp_path / "stock")


def assert_same_dumps(folder, case):
    for name in ("bed.dump", "contacts.dump") if ALL[case][2] else ("bed.dump",):
        bed.assert_same_text(folder / "cfpm" / name, folder / "stock" / name, f"{name} differs from stock")


@pytest.mark.parametrize("case", MORE)
def test_equals_stock_with_other_models(tmp_path, case):
    fall(tmp_path / "stock", bed.STOCK, STOCK, case)
    fall(tmp_path / "cfpm", bed.UNPREDICTED, LAUNCHER, case)
    assert_same_dumps(tmp_path, case)


def test_equals_stock_on_frozen_spheres(tmp_path):
    fall(tmp_path / "stock", bed.STOCK, STOCK, "hertz", more=FREEZE)
    fall(tmp_path / "cfpm", bed.UNPREDICTED, LAUNCHER, "hertz", more=FREEZE)
    assert_same_dumps(tmp_path, "hertz")


@pytest.mark.parametrize(
    "case, reason",
    [
        ("hooke", None),
        ("off", None),
        ("rolling", "cohesion or rolling friction acts beside them"),
        ("heating", "setting 'heating_normal_hooke' is on"),
    ],
)
def test_says_what_is_left_to_the_host(tmp_path, case, reason):
    bed.write(tmp_path)
    styles = {**bed.UNPREDICTED, "nve": "nve/cfpm"}
    model, settings, _ = ALL[case]
    deck = bed.box() + bed.pair(styles, model, settings) + bed.fixes(styles, model, settings) + "run 0\n"
    output = run(deck, tmp_path).stdout
    left = f"contacts of pairs are left to the host's own style, as {reason}\n"
    assert (left in output) == bool(reason)
    assert ("at a time" in output) == (not reason and len(SETS) > 1)


def assert_history_was_carried(folder):
    """A comparison of runs without lasting contacts would say nothing."""
    *_, before, after = bed.read_contacts(folder / "contacts.dump")
    lasting = [pair for pair in after if (pair in before or pair[::-1] in before) and np.any(after[pair])]
    assert len(lasting) > 100
    # the border between two ranks is the middle of the box
    left = [columns["x"] < bed.SIDE / 2 for _, columns in read_dump(folder / "bed.dump")[-2:]]
    moved = left[0] != left[1]
    assert sum(moved[i - 1] and moved[j - 1] for i, j in lasting) > 10
