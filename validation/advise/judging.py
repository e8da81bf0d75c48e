# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a deck gains what advise promises, and comes out as it does in stock."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from averages import spread  # noqa: E402
from measuring import AS_IS, LARGEST  # noqa: E402
from problems import USE  # noqa: E402


def judge(exhibit, problem, advice, found):
    base, largest = (next(own for way, own in found.items() if way.name == name) for name in (AS_IS, LARGEST))
    for way, own in ((way, own) for way, own in found.items() if way.lines):
        promise = advice.promise(way.lines)
        than = [("the deck is", base, promise.faster)]
        if way.is_for(USE):
            than.append((f"stock at its largest step for {USE}", largest, promise.than_stock))
        for name, other, gain in than:
            exhibit.verdict(
                f"{problem.title}, {way.name}: {spread(own.faster_than(other), '.3g')} times as fast as {name}; "
                f"advise says {gain}", not own.blown_up and gain.keeps(np.median(own.faster_than(other)))
            )
        if way.is_for(USE) and len(own.seconds) > 1:
            apart = own.apart_from(base)
            exhibit.verdict(
                f"{problem.title}, {way.name}: beside the deck as it is "
                + (", ".join(f"{d}, chance makes up to {d.allowed:.3g}" for d in apart) or "no figures: it blew up"),
                bool(apart) and not any(d.differs for d in apart)
            )
