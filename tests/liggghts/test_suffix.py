# SPDX-License-Identifier: GPL-2.0-or-later
"""-suffix cfpm tells where a deck has nothing that it predicts."""

import pytest
from harness.liggghts import run
from small_deck import MODEL, STOCK_INTEGRATOR, STOCK_WALL, write

PAIR = f"pair_style gran {MODEL}"
NOTHING = "WARNING: -suffix cfpm finds nothing to predict: pair_style gran has no predicted form"
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
