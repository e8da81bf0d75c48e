# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run to the last bit whether contacts are computed one by one or several at a time."""

import pytest
from harness.instruction_sets import check_refusal, check_same_bits

CASES = {
    "exact": {},
    "newton": {"newton off": "newton on"},
    "trapezoid": {"predict exact": "predict trapezoid"},
    "without_tension": {" 1 predict exact": " 1 limit_damping predict exact"},
}


@pytest.mark.parametrize("case", CASES)
def test_same_bits(tmp_path, case):
    check_same_bits("lammps", tmp_path, CASES[case])


def test_refuses_what_it_does_not_know(tmp_path):
    check_refusal("lammps", tmp_path)
