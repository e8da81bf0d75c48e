# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run to the last bit whether contacts are computed one by one or several at a time."""

import pytest
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


def test_refuses_what_it_does_not_know(tmp_path):
    check_refusal("lammps", tmp_path)
