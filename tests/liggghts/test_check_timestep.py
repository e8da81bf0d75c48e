# SPDX-License-Identifier: GPL-2.0-or-later
"""fix check/timestep/gran of a deck under -suffix cfpm: checks against what the predictor can take, once in a run."""

import re

import pytest
from harness.liggghts import run
from harness.output import first_error
from small_deck import MODEL, PAIR, STOCK_INTEGRATOR, write

CHECK = "fix ts all check/timestep/gran 1 0.1 0.1"
HERTZ = "model hertz tangential history"
WARNING = re.compile(r"^WARNING: fix check/timestep/gran \(id ts\): (.*?) \(", re.MULTILINE)
SKIN = "neighbor 0.05 bin\nneigh_modify delay 0"


def deck(model, predict, dt, speed=0.1, check=CHECK, steps=5, **changes):
    changes = {
        "timestep": f"timestep {dt}",
        "neighbor": SKIN,
        "pair": f"{PAIR}{model}{predict}",
        "wall": f"fix floor all wall/gran {model} primitive type 1 zplane 0.0",
        "integrator": STOCK_INTEGRATOR,
        "extra": f"velocity one set {speed} 0 0\n{check}\n"
        "thermo_style custom step f_ts[1] f_ts[2] f_ts[3]\nthermo 1",
        "run": f"run {steps}",
        **changes,
    }
    return write(**changes)


def checked(folder, text, **options):
    return run(text, folder, options=("-suffix", "cfpm"), **options)


def numbers(output):
    return re.findall(r"^ +\d+ +\S+ +\S+ +\S+ *$", output, re.MULTILINE)


@pytest.mark.parametrize("ranks", [1, 2])
def test_predicted_step_beyond_the_fractions(tmp_path, ranks):
    """Three contacts a step: far beyond the Rayleigh time, which impulses do not mind. The output is the host's."""
    text = deck(MODEL, " predict impulse", 5e-3)
    output = checked(tmp_path, text, np=ranks).stdout
    assert not WARNING.findall(output), output
    stock = text.replace(PAIR, "pair_style gran ").replace(" predict impulse", "")
    stock = run(stock, tmp_path).stdout
    assert stock.count("of rayleigh time") == 5
    assert numbers(output)[1] == numbers(stock)[1] and len(numbers(output)) == 6


@pytest.mark.parametrize("ranks", [1, 2])
def test_step_beyond_the_limit(tmp_path, ranks):
    output = checked(tmp_path, deck(MODEL, " predict exact", 2e-2), np=ranks).stdout
    assert WARNING.findall(output) == ["time step too large for the predictor; see the nt and their limits above"]
    error = first_error(checked(tmp_path, deck(MODEL, "", 2e-2, check=CHECK + " error yes"), np=ranks, check=False))
    assert "fix check/timestep/gran (id ts): time step too large for the predictor" in error
    assert not WARNING.findall(checked(tmp_path, deck(MODEL, "", 2e-2, check=CHECK + " warn no"), np=ranks).stdout)


def test_fast_hertz_contacts(tmp_path):
    """The report times them at the characteristicVelocity of 1 m/s, at which they last 3.2 steps; the limit is at
    2.015. The host's estimate is below that at 60 m/s."""
    slow = checked(tmp_path, deck(HERTZ, " predict rk4", 1e-3)).stdout
    assert not WARNING.findall(slow), slow
    fast = checked(tmp_path, deck(HERTZ, " predict rk4", 1e-3, check=CHECK + " vmax 60")).stdout
    (found,) = WARNING.findall(fast)
    assert "of the Hertz time at the largest speeds; expected at most 49.62 % for predict rk4" in found


def test_skin(tmp_path):
    (found,) = WARNING.findall(checked(tmp_path, deck(MODEL, "", 1e-3, check=CHECK + " vmax 30")).stdout)
    assert "particles come together by more than the skin in a step" in found


def test_without_prediction_the_fractions_count(tmp_path):
    output = checked(tmp_path, deck(MODEL, " predict none", 5e-4, integrator="fix i all nve/noforce")).stdout
    assert len(WARNING.findall(output)) == 1 and "of the Rayleigh time; expected at most 10 %" in output


BAD = {
    "check/timestep/gran 1 0.1": "expected [check_every_time] N fraction_rayleigh fraction_hertz",
    "check/timestep/gran 1 x 0.1": "fraction_rayleigh is 'x'; expected a number",
    "check/timestep/gran 1 0.1 0.1 warm yes": "unknown keyword 'warm'; expected warn, error or vmax",
    "check/timestep/gran check_every_time 1 0.1 0.1 warn": "missing value after 'warn'",
    "check/timestep/gran 1 0.1 0.1 error maybe": "error is 'maybe'; expected yes or no",
}


@pytest.mark.parametrize("words", BAD)
def test_arguments(tmp_path, words):
    text = deck(MODEL, "", 1e-5, extra=f"fix ts all {words}")
    error = first_error(checked(tmp_path, text, check=False, timeout=20))
    assert "fix check/timestep/gran (id ts): " + BAD[words] in error


def test_beside_a_pair_style_of_the_host(tmp_path):
    """Which -suffix leaves alone where the deck switches it off."""
    pair = f"suffix off\npair_style gran {MODEL}\nsuffix on"
    text = deck(MODEL, "", 1e-5, pair=pair, wall="", integrator="fix i all nve/noforce")
    error = first_error(checked(tmp_path, text, check=False))
    assert "fix check/timestep/gran: needs 'pair_style gran/cfpm', found pair_style gran" in error
