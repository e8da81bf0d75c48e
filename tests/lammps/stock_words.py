# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck for this plugin as its user wrote it before: with the words of the host."""

import re

STOCK_WORDS = {
    "wall/gran/cfpm hooke": "wall/gran hooke/history",
    "wall/gran/cfpm hertz": "wall/gran hertz/history",
    " gran/cfpm hooke": " gran/hooke/history",
    " gran/cfpm hertz": " gran/hertz/history",
    "nve/cfpm": "nve/sphere",
}


def in_stock_words(deck):
    for ours, theirs in STOCK_WORDS.items():
        deck = deck.replace(ours, theirs)
    deck = re.sub("wall/gran (.* region)", r"wall/gran/region \1", deck)
    assert "cfpm" not in deck
    return deck
