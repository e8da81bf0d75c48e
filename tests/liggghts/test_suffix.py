# SPDX-License-Identifier: GPL-2.0-or-later
"""-suffix cfpm tells where a deck has nothing that it predicts."""

import pytest
from harness.liggghts import run
from small_deck import MODEL, STOCK_INTEGRATOR, STOCK_WALL, write

PAIR = f"pair_style gran {MODEL}"
NOTHING = "WARNING: -suffix cfpm finds nothing to predict: pair_style gran has no predicted form"
NOTHING_TO_MOVE = (
    "WARNING: -suffix cfpm finds nothing to predict: fix rigid (id bodies) moves the particles, so only the host's own "
    "step goes here; expected fix nve/sphere"
)
STOCK = {"pair": PAIR, "wall": STOCK_WALL, "integrator": STOCK_INTEGRATOR}


def suffixed(folder, text, **options):
    return run(text, folder, options=("-suffix", "cfpm"), **options)


@pytest.mark.parametrize("ranks", [1, 2])
def test_nothing_to_predict(tmp_path, ranks):
    """Said once, not at every run, and again after clear."""
    text = write(**{**STOCK, "pair": f"suffix off\n{PAIR}", "run": "suffix on\nrun 1\nrun 1"})
    output = suffixed(tmp_path, text + "clear\n" + text, np=ranks).stdout
    assert output.count(NOTHING) == 2, output
    assert "nothing to predict" not in run(text.replace("suffix on", ""), tmp_path, np=ranks).stdout


def test_what_is_predicted(tmp_path):
    assert "nothing to predict" not in suffixed(tmp_path, write(**STOCK)).stdout
    assert "nothing to predict" not in suffixed(tmp_path, write(**{**STOCK, "pair": f"suffix off\n{PAIR}"})).stdout


@pytest.mark.parametrize("ranks", [1, 2])
def test_nothing_to_move(tmp_path, ranks):
    """Bodies move all particles: at many steps per contact time auto leaves them to the host, and says so, once."""
    text = write(**{**STOCK, "integrator": "fix bodies all rigid single", "run": "run 1\nrun 1"})
    output = suffixed(tmp_path, text, np=ranks).stdout
    assert output.count(NOTHING_TO_MOVE) == 1, output
    assert "nothing to predict" not in run(text, tmp_path, np=ranks).stdout


@pytest.mark.parametrize("integrator", ["fix i all nve/noforce", f"{STOCK_INTEGRATOR}\nfix r one nve/noforce"])
def test_no_word_where_forces_move_nothing_else(tmp_path, integrator):
    changes = {"integrator": integrator.replace("all nve/sphere", "two nve/sphere")}
    assert "nothing to predict" not in suffixed(tmp_path, write(**{**STOCK, **changes})).stdout
