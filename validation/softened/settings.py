# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user can choose of a deck whose material may be softened: method, stiffness, step."""

from typing import NamedTuple

STOCK = "stock"
SOFTEN = (1, 4, 16, 64, 256)  # what the stiffness is divided by
STOCK_NT = (4, 5, 6, 8, 10, 14, 20, 28, 40)
# "verlet" is the method of stock, at the price of a step of the plugin; at as many steps it gives the same
NT = {
    "verlet": STOCK_NT,
    **dict.fromkeys(("exact", "rk2", "rk4"), (3, 4, 5, 6, 8, 10, 14, 20)),
    "impulse": (1, 1.5, 2, 3, 4, 5, 6, 8, 10),
}
LINEAR = ("verlet", "exact", "impulse")
HERTZ = (*LINEAR, "rk2", "rk4")
# of a step, over stock's: roughly, for the order in which settings are tried and the time left
STEP = {STOCK: 1.0, "verlet": 0.5, "exact": 0.55, "rk2": 0.55, "rk4": 0.6, "impulse": 0.9}


class Setting(NamedTuple):
    method: str  # stock, or what the deck's pair style predicts
    soften: float  # what the stiffness is divided by
    nt: float  # steps per contact time of this material

    def __str__(self):
        return f"{self.method}, k/{self.soften:g}, nt = {self.nt:g}"

    def variables(self):
        """Of a deck."""
        style = {"style": STOCK} if self.method == STOCK else {"style": "cfpm", "predict": self.method}
        return {**style, "soften": self.soften, "nt": self.nt}

    def cost(self, exponent):
        """Expected, in any unit. exponent: with which a contact's time grows with 1/k."""
        return STEP[self.method] * self.nt / self.soften**exponent


def of_stock():
    return [Setting(STOCK, soften, nt) for soften in SOFTEN for nt in STOCK_NT]


def of_plugin(methods):
    return [Setting(method, soften, nt) for method in methods for soften in SOFTEN for nt in NT[method]]
