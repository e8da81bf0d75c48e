# SPDX-License-Identifier: GPL-2.0-or-later
"""-suffix cfpm tells where a deck has nothing that it predicts, and which of the deck's styles that is."""

import pytest
from harness.lammps import run
from harness.output import first_error
from test_bad_input import DECK

MODELS = "hooke 1e5 0.5 tangential linear_history 1e5 0.5 0.1 damping mass_velocity"
GRANULAR = {"pair": "pair_style granular", "coefficients": f"pair_coeff * * {MODELS}"}
WITHOUT_HISTORY = {"pair": "pair_style gran/hooke 1e5 NULL 100 NULL 0.3 1", "integrator": "fix i all nve/sphere"}
STOCK = {"pair": "pair_style gran/hooke/history 1e5 NULL 100 NULL 0.3 1", "integrator": "fix i all nve/sphere"}
NOTHING = "WARNING: -suffix cfpm finds nothing to predict: pair_style {} has no predicted form"
EXPECTED = "expected pair_style gran/hooke, gran/hooke/history, gran/hertz/history or granular"


def deck(**changes):
    return "units si\nboundary f f f\nnewton off\n" + "\n".join({**DECK, **changes}.values()) + "\n"


def suffixed(folder, text, **options):
    return run(text, folder, options=("-suffix", "cfpm"), **options)


UNPREDICTED = {
    "lj/cut": {"pair": "pair_style lj/cut 0.1", "coefficients": "pair_coeff * * 1e-9 0.05"},
    "hybrid of lj/cut": {
        "pair": "pair_style hybrid lj/cut 0.1",
        "coefficients": "pair_coeff * * lj/cut 1e-9 0.05",
    },
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("pair", UNPREDICTED)
def test_nothing_to_predict(tmp_path, pair, ranks):
    """Said once, not at every run, and again after clear."""
    text = deck(**UNPREDICTED[pair], integrator="fix i all nve/noforce", run="run 1\nrun 1")
    output = suffixed(tmp_path, text + "clear\n" + text, np=ranks).stdout
    assert output.count(NOTHING.format(pair)) == 2 and output.count(EXPECTED) == 2, output
    assert "suffix" not in run(text, tmp_path, np=ranks).stdout


PREDICTED = [STOCK, {**STOCK, "run": "suffix off\nrun 2"}, {**STOCK, **GRANULAR}, WITHOUT_HISTORY]


@pytest.mark.parametrize("changes", PREDICTED)
def test_what_is_predicted(tmp_path, changes):
    assert "finds nothing to predict" not in suffixed(tmp_path, deck(**changes)).stdout


@pytest.mark.parametrize("ranks", [1, 2])
def test_nothing_to_move(tmp_path, ranks):
    """Another integrator moves all particles: at many steps auto leaves them to the host, and says so, once."""
    text = deck(**{**STOCK, "integrator": "fix i all nve/limit 0.1", "run": "timestep 1e-6\nrun 1\nrun 1"})
    output = suffixed(tmp_path, text, np=ranks).stdout
    found = "finds nothing to predict: fix nve/limit (id i) moves the particles, so only the host's own step goes here"
    assert output.count(found) == 1, output
    assert "nothing to predict" not in run(text, tmp_path, np=ranks).stdout


def test_predicted_styles_beside_others_are_refused(tmp_path):
    changes = UNPREDICTED["lj/cut"]
    error = first_error(suffixed(tmp_path, deck(**changes, integrator="fix i all nve/sphere"), check=False))
    assert "found pair_style lj/cut; expected it, or with -suffix cfpm gran/hooke, gran/hooke/history, " in error
    wall = "fix w all wall/gran hertz 1e5 NULL 100 NULL 0.3 1 zplane -1 NULL"
    error = first_error(suffixed(tmp_path, deck(**changes, extra=wall), check=False))
    assert "fix wall/gran with 'hertz' cannot be predicted; expected hooke, hooke/history, hertz/history" in error
