# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run to the last bit whether contacts are computed one by one or several at a time."""

import re

import pytest
from harness.fifty_spheres import DECKS
from harness.instruction_sets import IMPULSES, OTHER_PREDICTOR, OWN_STEP, check_refusal, check_same_bits, of_any_size

CASES = {
    "default": {},
    "newton": {"newton off": "newton on"},
    "without_tension": {" 1 predict ": " 1 limit_damping predict "},
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_same_bits(tmp_path, law, case):
    check_same_bits("lammps", tmp_path, law, CASES[case])


@pytest.mark.parametrize("law", OTHER_PREDICTOR)
def test_same_bits_of_another_predictor(tmp_path, law):
    check_same_bits("lammps", tmp_path, law, OTHER_PREDICTOR[law])


@pytest.mark.parametrize("law", OWN_STEP)
def test_same_bits_of_the_hosts_own_step(tmp_path, law):
    check_same_bits("lammps", tmp_path, law, OWN_STEP[law])


@pytest.mark.parametrize("law", IMPULSES)
def test_same_bits_of_impulses(tmp_path, law):
    check_same_bits("lammps", tmp_path, law, {})


@pytest.mark.parametrize("law", ["linear", "hertz", "impulse", "split"])
def test_same_bits_of_any_size(tmp_path, law):
    check_same_bits("lammps", tmp_path, law, {}, of_any_size())


@pytest.mark.parametrize("law", OWN_STEP)
def test_same_bits_of_the_hosts_own_step_of_any_size(tmp_path, law):
    check_same_bits("lammps", tmp_path, law, OWN_STEP[law], of_any_size())


def of_granular(predict, models):
    """The pairs of the deck with law "hertz" by pair_style granular/cfpm."""
    pairs = re.search(r"pair_style .*\npair_coeff \* \*", DECKS["lammps"]("hertz"))[0]
    return {pairs: f"pair_style granular/cfpm predict {predict}\npair_coeff * * {models}"}


@pytest.mark.parametrize("spheres", [None, of_any_size()], ids=["two_sizes", "any_size"])
@pytest.mark.parametrize(
    "predict, models",
    [
        ("exact", "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.4 damping tsuji"),
        ("exact", "hertz/material 1e7 0.4 0.3 tangential mindlin NULL 0.5 0.4 damping tsuji limit_damping"),
        ("rk4", "hertz 1e7 5e4 tangential linear_history 8e3 0.5 0.4"),
    ],
    ids=["linear", "similar", "any"],
)
def test_same_bits_of_granular(tmp_path, predict, models, spheres):
    check_same_bits("lammps", tmp_path, "hertz", of_granular(predict, models), spheres)


def test_refuses_what_it_does_not_know(tmp_path):
    check_refusal("lammps", tmp_path)
