# SPDX-License-Identifier: GPL-2.0-or-later
"""With "predict none" the pair style is the host's, to the last digit."""

import re

import pytest
from kicked_bed import LAWS, assert_equal, bed, cfpm_style, stock_style
from lammps import LAUNCHER, STOCK, run


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("law", LAWS)
def test_equals_stock(tmp_path, law, newton, ranks):
    assert_equal(tmp_path, bed(stock_style(law), newton), bed(cfpm_style(law), newton), ranks)


def test_lists_as_many_pairs(tmp_path):
    """The list follows the sizes of the particles: with the largest size for all it would be several times as long."""
    listed = []
    for program, style in ((STOCK, stock_style("hooke")), (LAUNCHER, cfpm_style("hooke"))):
        output = run(bed(style, "off"), tmp_path, program=program).stdout
        listed.append(int(re.search(r"Total # of neighbors = (\d+)", output)[1]))
    assert listed[0] == listed[1]
