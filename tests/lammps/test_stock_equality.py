# SPDX-License-Identifier: GPL-2.0-or-later
"""With "predict none" the pair style is the host's, to the last digit."""

import re

import pytest
from kicked_bed import LAWS, assert_equal, bed, cfpm_style, stock_style
from harness.lammps import LAUNCHER, STOCK, run


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("law", LAWS)
def test_equals_stock(tmp_path, law, newton, ranks):
    assert_equal(tmp_path, bed(stock_style(law), newton), bed(cfpm_style(law), newton), ranks)


@pytest.mark.parametrize("ranks", [1, 2])
def test_contacts_without_history_by_suffix(tmp_path, ranks):
    """An unmodified deck, whose wall has none either: at many steps auto leaves it as it is."""
    deck = bed(stock_style("hooke/nohistory"), "off").replace("wall/gran hooke/history", "wall/gran hooke")
    deck = deck.replace("timestep 2e-5", "timestep 5e-6")
    assert_equal(tmp_path, deck, "suffix cfpm\n" + deck, ranks)


def listed_pairs(folder, program, style, predicted=False):
    """After some steps, of particles of which the large ones have four times the size of the small ones."""
    deck = bed(style, "off", after="run 50").replace("set type 2 diameter 0.006", "set type 2 diameter 0.0025")
    assert "diameter 0.0025" in deck
    if predicted:
        deck = deck.replace("wall/gran hooke/history", "wall/gran/cfpm hooke").replace("nve/sphere", "nve/cfpm")
    output = run(deck, folder, program=program).stdout
    return int(re.search(r"Total # of neighbors = (\d+)", output)[1])


def test_lists_as_many_pairs(tmp_path):
    """The list follows the sizes of the particles: with the largest size for all it would be several times as long. A
    predicted bed moves a little differently in these steps."""
    stock = listed_pairs(tmp_path, STOCK, stock_style("hooke"))
    assert listed_pairs(tmp_path, LAUNCHER, cfpm_style("hooke")) == stock
    predicted = listed_pairs(tmp_path, LAUNCHER, cfpm_style("hooke").removesuffix(" predict none"), predicted=True)
    assert predicted == pytest.approx(stock, rel=0.1)
