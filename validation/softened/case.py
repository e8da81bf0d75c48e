# SPDX-License-Identifier: GPL-2.0-or-later
"""A problem that settings are tried on."""

import numpy as np
import settings
from settings import STOCK, Setting

AT_REST = 1e-3  # kinetic energy per sphere over m g d, see resting()
# Settings are reported with more starts than they are chosen with. Who takes the cheapest within tolerance takes one
# near its edge: of |d| + t s < T there is little left. With 4 times as many starts s is half, so that a setting whose
# true difference is below T by half of what was left for the scatter can be told from one that is not.
OTHERS = {"full": 4, "quick": 1}
BLEW_UP, SHAKES = "blew up", "not at rest"


class Case:
    """A deck, how it is started, and which of its figures must come out right.

    A case that needs beds to start from says so by bed(); their files are then handed to run().
    """

    name: str  # of files, and behind --cases
    title: str
    text: str  # what is run, for the report
    host: str
    figures: dict  # {name: tolerance in percent}
    methods = settings.LINEAR  # of the plugin
    exponent = 0.5  # with which the time of a contact grows with 1/k
    reference = Setting(STOCK, 1, 40)
    starts = {"full": 8, "quick": 2}  # that settings are chosen with

    def __init__(self, quick):
        self.quick = quick
        self.folder = None  # for files that are made for the deck, as meshes; set by who runs it
        size = "quick" if quick else "full"
        self.count = self.starts[size]
        self.others = OTHERS[size] * self.count
        self.stock = [Setting(STOCK, 1, 10), Setting(STOCK, 16, 10)] if quick else settings.of_stock()
        self.plugin = [Setting(m, 16, 10) for m in self.methods] if quick else settings.of_plugin(self.methods)
        if quick:  # whether all of it runs, not how right it is
            self.reference = self.reference._replace(nt=20)
            self.figures = dict.fromkeys(self.figures, np.inf)

    def bed(self, seed):
        """The run that makes the bed of a start and leaves it in bed.data; None if the case needs no bed."""
        return None

    def settled(self, result):
        """Whether that run made a bed at rest."""
        raise NotImplementedError

    def run(self, setting, seed, bed):
        """ensemble.Run. bed: the file, None without one."""
        raise NotImplementedError

    def read(self, result):
        """{figure: value} of a run that did not blow up, or why it is none: BLEW_UP, SHAKES."""
        raise NotImplementedError


def resting(energy, spheres, mass, diameter, gravity=9.81):
    """Whether spheres have come to rest, by their kinetic energy.

    All of it would lift them by AT_REST of a diameter, which is far below what the figures of beds are known to.
    """
    return bool(energy <= AT_REST * spheres * mass * gravity * diameter)
