# SPDX-License-Identifier: GPL-2.0-or-later
"""One look for all plots: colours that grow lighter one after the other, so that they differ in grey too."""

import matplotlib

matplotlib.use("Agg")

COLOURS = ("#14213d", "#a4303f", "#2f8f83", "#e39a2d", "#8fb8de", "#c9b8d8")
matplotlib.rcParams.update({
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": "medium",
    "font.size": 10,
    "grid.alpha": 0.3,
    "legend.frameon": False,
    "savefig.bbox": "tight",
    "savefig.dpi": 110,
})
