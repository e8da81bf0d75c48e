# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests notice what they claim to: see tests/mutations/mutation.py."""

import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "mutations"))
from added_predictor import check  # noqa: E402
from hosts import LIGGGHTS  # noqa: E402
from mutation import assert_noticed, build  # noqa: E402


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """One build with all mutations, each of which the environment turns on."""
    return build(tmp_path_factory.mktemp("mutated"), LIGGGHTS, ("cfpm_liggghts", "cfpm_liggghts_preload"))


@pytest.mark.parametrize("row", LIGGGHTS, ids=[row.name for row in LIGGGHTS])
def test_is_noticed(built, row):
    assert_noticed(built, HERE, row)


def test_a_predictor_is_added(built, tmp_path):
    check("liggghts", built, tmp_path)
