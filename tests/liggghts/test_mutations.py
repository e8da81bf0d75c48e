# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests notice what they claim to: see tests/mutations/mutation.py."""

import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "mutations"))
from mutation import assert_noticed  # noqa: E402

# patch, the test that must fail, what it must say
MUTATIONS = [
    (
        "drop_history_at_rebuild",
        "test_stock_equality.py::test_equals_stock[hooke-plane-1]",
        "bed.dump differs from stock, first in line",
    ),
    (
        "drop_history_of_predicted_pairs",
        "test_passive_output.py::test_output_is_passive[exact-1]",
        "output changed the run, first in line",
    ),
]


@pytest.mark.parametrize("patch, test, message", MUTATIONS, ids=[m[0] for m in MUTATIONS])
def test_is_noticed(tmp_path, patch, test, message):
    assert_noticed(tmp_path, patch, ("cfpm_liggghts", "cfpm_liggghts_preload"), HERE / test, message)
