# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run to the last bit whether contacts are computed one by one or several at a time."""

import pytest
from harness.instruction_sets import check_refusal, check_same_bits

CASES = {
    "exact": {},
    "no_history": {"tangential history": "tangential no_history"},
    "rk2": {"predict exact": "predict rk2"},
    "without_tension": {"predict exact\n": "predict exact limitForce on\n"},
}


@pytest.mark.parametrize("case", CASES)
def test_same_bits(tmp_path, case):
    check_same_bits("liggghts", tmp_path, CASES[case])


def test_refuses_what_it_does_not_know(tmp_path):
    check_refusal("liggghts", tmp_path)
