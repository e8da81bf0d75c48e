# SPDX-License-Identifier: GPL-2.0-or-later
"""What rests at few steps per contact under impulses goes on at many without being kicked."""

import pytest
from harness import column


@pytest.mark.parametrize("settled", [2, 3])
def test_rises_by_and_by(tmp_path, settled):
    before, largest = column.energies("liggghts", tmp_path, settled, 30)
    assert before < 1e-7, "it did not rest"
    assert largest < 1e-5  # at once: 8e-5 and more
