# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against CPU time of all settings of a case, with the front of stock and that of the plugin."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from search import front
from settings import STOCK

MARKERS = {STOCK: "o", "verlet": "s", "exact": "^", "rk2": "<", "rk4": ">", "impulse": "D"}
LOWEST = 0.05  # of the axis of errors
NAMED = 3  # points of the fronts above this error are left without a name, as nobody would take them


def point(measured):
    """CPU time and error as drawn: the mean's and one standard error of it, over the tolerance."""
    mean, error = measured.error
    return measured.cpu, mean + error


def draw(case, sides, chosen):
    """sides: {"stock": {Setting: Measured}, "cfpm": ...}; chosen: the settings that are reported, at most one of each.

    Told apart by fill, marker and line, so that a print in grey will do.
    """
    figure, axes = plt.subplots(figsize=(7.5, 5.2))
    reference = case.reference
    for side, color, line, size in (("stock", "black", "-", 6), ("cfpm", "0.45", "--", 7)):
        shown = [m for s, m in sides[side].items() if not m.failed and s != reference and np.isfinite(m.error[0])]
        for method in dict.fromkeys(m.setting.method for m in shown):
            own = [m for m in shown if m.setting.method == method]
            x, y, e = np.array([(m.cpu, *m.error) for m in own]).T
            fill = color if side == "stock" else "white"
            style = {"fmt": MARKERS[method], "color": color, "markerfacecolor": fill, "markersize": size}
            axes.errorbar(x, np.maximum(y, LOWEST), e, capsize=2, elinewidth=0.7, label=method, **style)
        edge = front([point(m) for m in shown])
        if edge:
            x, y = np.array([*edge, (max(m.cpu for m in shown), edge[-1][1])]).T
            label = f"front of {side}"
            axes.step(x, np.maximum(y, LOWEST), where="post", color=color, linestyle=line, linewidth=1.6, label=label)
        for m in shown:
            if m.setting not in chosen and (point(m) not in edge or m.error[0] > NAMED):
                continue
            text = f"k/{m.setting.soften:g}, {m.setting.nt:g}"
            weight = "bold" if m.setting in chosen else "normal"
            at = (m.cpu, max(m.error[0], LOWEST))
            offset = (5, 5) if side == "stock" else (5, -11)
            axes.annotate(text, at, xytext=offset, textcoords="offset points", fontsize=7, weight=weight, color=color)
    axes.axhline(1, color="black", linestyle=":", linewidth=1)
    axes.set(xscale="log", yscale="log", title=case.title, ylim=(LOWEST, None))
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="CPU time of a run, s", ylabel="error over the tolerance")
    axes.grid(alpha=0.3, which="both")
    if axes.has_data():
        axes.legend(fontsize=8, loc="best")
    figure.tight_layout()
    return figure
