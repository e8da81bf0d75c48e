# SPDX-License-Identifier: GPL-2.0-or-later
"""What was found of a case, and whether to switch."""

from typing import NamedTuple

from case import Case
from settings import STOCK

SIDES = STOCK, "cfpm"


class Finding(NamedTuple):
    case: Case
    found: dict  # {side: Found}, from the starts that settings are chosen with
    reported: dict  # {side: Measured} of the chosen settings, from the others; empty if a side has none
    ratio: tuple  # CPU time of stock over the plugin's, start by start: geometric mean, 95 % interval; None without

    @property
    def confirmed(self):
        return bool(self.reported) and all(m.within for m in self.reported.values())

    @property
    def same_runs(self):
        """Whether both came to one setting of stock's method: then they are as accurate, whatever that is."""
        settings = {side: self.found[side].chosen for side in SIDES}
        if None in settings.values() or settings["cfpm"].method != "verlet":
            return False
        return settings["cfpm"]._replace(method=STOCK) == settings["stock"]


def advice(finding):
    """Whether to switch, in a few words."""
    if not finding.ratio:
        return "no setting of " + " and of ".join(s for s in SIDES if not finding.found[s].chosen) + " found"
    _, low, high = finding.ratio
    if not finding.confirmed and not finding.same_runs:
        return "not settled: a chosen setting is not within tolerance from the other starts"
    if high < 1:
        return "**do not switch**: softened stock is cheaper"
    if low <= 1:
        return "**do not switch** for speed: no difference shown"
    method = finding.found["cfpm"].chosen.method
    unsettled = "" if finding.confirmed else "; that both are within tolerance is not shown from the other starts"
    return "switch" + (f": what pays is the price of a step alone{unsettled}" if method == "verlet" else "")
