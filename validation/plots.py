# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the plots of docs/validation.md and docs/speed.md from validation/results, where the commands they name left
what they measured. Nothing is run.
"""

import argparse
import csv
from pathlib import Path

import style  # the look
from matplotlib import pyplot as plt
from matplotlib.ticker import FuncFormatter, NullLocator

RESULTS = Path(__file__).resolve().parent / "results"
STOCK, EXACT, IMPULSE = (  # in grey they differ by shade, mark and line
    {"color": colour, "marker": mark, "linestyle": line, "markersize": 5}
    for colour, mark, line in zip(style.COLOURS, "sod", ("--", ":", "-"))
)


def rows(name, **wanted):
    """Of a table those rows that have the values wanted."""
    with open(RESULTS / f"{name}.csv", newline="") as file:
        return [row for row in csv.DictReader(file) if all(row[key] == value for key, value in wanted.items())]


def column(table, name):
    return [float(row[name]) for row in table]


def number_axis(axis, ticks):
    """A logarithmic axis with these numbers on it."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_ticks(ticks)


def nt_axis(axes, ticks):
    axes.set(xscale="log", xlabel="nt, steps per contact")
    number_axis(axes.xaxis, ticks)


def packing():
    """Density of beds over the step, ./cfpm validate beyond."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    axes.axhspan(-0.5, 0.5, color="0.92", zorder=0)
    for method, name, look in (
        ("conventional", "stock", STOCK), ("cfpm exact", "exact", EXACT), ("cfpm impulse", "impulse", IMPULSE)
    ):
        table = rows("beyond/packing", host="liggghts", dashpot="off", method=method)
        table = [row for row in table if row["blown_up"] == "0" and float(row["nt"]) <= 30]
        values, errors = column(table, "difference_percent"), column(table, "difference_error")
        axes.errorbar(column(table, "nt"), values, errors, capsize=2, label=name, **look)
    nt_axis(axes, [1, 1.5, 2, 3, 4, 6, 10, 30])
    axes.set(ylabel="packing ratio, % off stock at small steps")
    axes.legend()
    return figure


def oblique():
    """Tangential velocity after impacts over the step, ./cfpm validate oblique."""
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True)
    for axes, (contact, title) in zip(panels, (("Hooke, e = 0.2", "linear, e = 0.2"), ("Hertz, e = 0.9",) * 2)):
        for method, name, look in (
            ("velocity Verlet", "stock", STOCK), ("CFPM exact", "exact", EXACT), ("CFPM impulse", "impulse", IMPULSE)
        ):
            worst = {}
            for row in rows("oblique/oblique", contact=contact, method=method):
                step = fraction(row["dt_over_tc"])
                worst[step] = max(worst.get(step, 0.0), float(row["tangential_velocity_rms_error"]))
            axes.plot(worst.keys(), worst.values(), label=name, **look)
        axes.set(xscale="log", yscale="log", xlabel="dt/tc", title=title)
        number_axis(axes.xaxis, [0.05, 0.1, 0.33, 1, 3])
    panels[0].set(ylabel="error of the tangential velocity\nover the impact speed")
    panels[0].legend()
    return figure


def fraction(text):
    whole, _, parts = text.partition("/")
    return float(whole) / float(parts or 1)


def onset():
    """Restitution over the step, ./cfpm validate collisions."""
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True)
    for axes, (law, method) in zip(panels, (("Hooke", "exact"), ("Hertz", "rk4"))):
        for name, label, look in (
            ("velocity Verlet", "stock", STOCK), (f"CFPM {method}", method, EXACT),
            (f"CFPM {method} onset on", f"{method} onset on", IMPULSE)
        ):
            (row,) = rows("collisions/onset", law=law, e="0.9", quantity="restitution", method=name)
            counts = [key for key in row if key.startswith("nt_")]
            axes.plot([float(key[3:]) for key in counts], [float(row[key]) for key in counts], label=label, **look)
        axes.set(yscale="log", title=f"{law}, e = 0.9")
        nt_axis(axes, [3, 4, 6, 10, 25])
        axes.legend()
    panels[0].set(ylabel="error of the restitution, rms")
    return figure


def agitated():
    """Energy of a cooling gas over the step, ./cfpm validate agitated."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    axes.axhspan(-3, 3, color="0.92", zorder=0)
    looks = {"stock": STOCK, "exact": EXACT, "exact onset on": {**EXACT, "markerfacecolor": "none"}, "impulse": IMPULSE}
    for method, look in looks.items():
        table = rows("agitated/gas", solid_fraction="0.34", method=method)
        values, errors = column(table, "percent_at_0.5"), column(table, "percent_error_at_0.5")
        axes.errorbar(column(table, "nt"), values, errors, capsize=2, label=method, **look)
    nt_axis(axes, [1, 2, 3, 4, 6, 10, 20, 30, 60])
    axes.set(ylabel="energy after half of the time, % off")
    axes.legend()
    return figure


def sizes():
    """When a fine grain comes off two large ones, ./cfpm validate sizes."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    for method, look in (("stock", STOCK), ("exact", EXACT), ("impulse", IMPULSE)):
        table = rows("sizes/sizes", host="LIGGGHTS", method=method, nt="6")
        free = [row for row in table if row["leaves_at_degrees"] != "stays on"]
        axes.plot(column(free, "ratio"), [100 * late for late in column(free, "late")], label=method, **look)
        stuck = [row for row in table if row not in free]
        if stuck:
            label = f"{method}: stays on for good"
            axes.plot(column(stuck, "ratio"), [1.0] * len(stuck), "x", color=look["color"], label=label)
    axes.set(xscale="log", xlabel="ratio of the radii", ylabel="late, % of the time")
    number_axis(axes.xaxis, [1, 2, 5, 10, 20, 50, 100])
    axes.legend()
    return figure


def speed():
    """CPU time of whole runs at equal accuracy, ./cfpm validate beyond."""
    figure, axes = plt.subplots(figsize=(6, 2.6))
    names, fills = [], {"conventional": "0.75", "cfpm exact": style.COLOURS[1], "cfpm impulse": style.COLOURS[0]}
    for row in rows("beyond/speed"):
        if row["method"] not in fills:
            continue
        middle, least, most = (float(row[f"faster_than_conventional_own{end}"]) for end in ("", "_min", "_max"))
        method = row["method"].replace("conventional", "stock").removeprefix("cfpm ")
        names.append(f"{row['deck']}: {method}, nt = {row['nt']}")
        ends = [[middle - least], [most - middle]]
        axes.barh(names[-1], middle, xerr=ends, color=fills[row["method"]], capsize=2, height=0.65)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set(xlabel="times as fast as stock at its own least nt")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=RESULTS.parents[1] / "docs" / "images", help="default docs/images")
    out = parser.parse_args().out
    for draw in (packing, oblique, onset, agitated, sizes, speed):
        figure = draw()
        figure.savefig(out / f"{draw.__name__}.png")
        plt.close(figure)


if __name__ == "__main__":
    main()
