# SPDX-License-Identifier: GPL-2.0-or-later
"""One and the same bed in stock LIGGGHTS, stock LAMMPS, YADE and the plugin: what a step and a simulated second cost.

LIGGGHTS settles the bed of the bench once. All read the same positions and velocities and continue copies of it side
by side, on one core: linear springs and dashpots with Coulomb friction, a floor, periodic sides. The time is user time
of a long run less that of a short one, so that neither reading nor what else a program does once is in it. All codes
run in turn, so that a change in the machine's speed hits all.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import pyplot as plt

HERE = Path(__file__).resolve().parent
sys.path[:0] = map(str, (HERE, HERE.parent, HERE.parent / "bench", HERE.parents[1]))
import bed as beds  # noqa: E402
from codes import BASE, CODES, SINKING, user_seconds  # noqa: E402
from exhibit import Exhibit, progress  # noqa: E402
from plots import number_axis  # noqa: E402
from state import State, same_bed  # noqa: E402

CONTACT_TIME = 2.0e-4  # of the bed [s]
SPHERES, QUICK_SPHERES = 23_400, 600
SHORT, LONG, QUICK_LONG = 20, 220, 520  # steps of the two runs
TURNS, QUICK_TURNS = 5, 1


class Timed(NamedTuple):
    """Of one code."""

    step: np.ndarray  # user time per particle and step [ns], of each turn
    second: np.ndarray  # user time of the bed per simulated second [s]
    state: State  # after the first long run


def measure_all(exhibit, bed, codes, turns):
    """{name of a code: Timed}"""
    short, long = SHORT, QUICK_LONG if exhibit.quick else LONG
    seconds, states = {name: [] for name in codes}, {}
    for turn in range(turns):
        for k, (name, code) in enumerate(codes.items(), 1):
            less, _ = user_seconds(code, bed, short)
            more, state = user_seconds(code, bed, long)
            seconds[name].append((more - less) / (long - short))
            states.setdefault(name, state)
            progress(k, len(codes), f"peers, turn {turn + 1} of {turns}")
    found = {}
    for name, state in states.items():
        of_step = np.array(seconds[name])
        found[name] = Timed(1e9 * of_step / state.spheres, of_step * name.nt / CONTACT_TIME, state)
    return found


def quantiles(values):
    """Median, least, most."""
    return np.quantile(values, (0.5, 0, 1))


def two_digits(value):
    return f"{value:#.2g}" if value < 10 else f"{value:.0f}"


def shown(values):
    return "{} ({} - {})".format(*map(two_digits, quantiles(values)))


def summarise(exhibit, found):
    base = found[BASE]
    rows, lines = [], []
    for name, own in found.items():
        row, line = [*name, len(own.step), *own.state], [*name, f"{own.state.touches:.2f}"]
        for what in ("step", "second"):
            values = getattr(own, what)
            ratios = values / getattr(base, what)
            row += [np.median(values), *quantiles(ratios)]
            line += [f"{np.median(values):.0f}", shown(ratios)]
        rows.append([f"{x:.4g}" if isinstance(x, float) else x for x in row])
        lines.append(line)
    names = "program style nt turns spheres touches kinetic_energy step_ns step_ratio step_ratio_min step_ratio_max"
    exhibit.csv("peers", [*names.split(), *"second_s second_ratio second_ratio_min second_ratio_max".split()], rows)
    times = ["ns per particle-step", "over LIGGGHTS", "s per simulated second", "over LIGGGHTS"]
    exhibit.table(["program", "style", "nt", "touches per sphere", *times], lines)


def plot(found):
    figure, panels = plt.subplots(1, 2, figsize=(10, 0.3 * len(found) + 1), sharey=True)
    ticks = {"step": [0.5, 1, 2, 5], "second": [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5]}
    for axes, what, title in zip(panels, ticks, ("One step", "One simulated second")):
        ratios = [quantiles(getattr(own, what) / getattr(found[BASE], what)) for own in found.values()]
        middle, low, high = np.transpose(ratios)
        axes.errorbar(middle, [str(name) for name in found], xerr=[middle - low, high - middle], fmt="o", capsize=3)
        axes.axvline(1.0, color="0.5", linewidth=0.8)
        axes.set(title=title, xlabel="user time over stock LIGGGHTS's", xscale="log")
        number_axis(axes.xaxis, ticks[what])
    panels[0].invert_yaxis()
    return figure


def judge(exhibit, found):
    other = found[BASE].state
    for name, timed in found.items():
        own = timed.state
        exhibit.verdict(
            f"{name}: {own.spheres:,} spheres with {own.touches:.2f} touches and {1e6 * own.energy:.3g} uJ each, "
            f"stock LIGGGHTS {other.spheres:,} with {other.touches:.2f} and {1e6 * other.energy:.3g} uJ",
            same_bed(own, other, name.nt == BASE.nt),
        )


def add_arguments(parser):
    default = f"(default {TURNS}, quick {QUICK_TURNS})"
    parser.add_argument("--turns", type=int, help=f"how often each code is timed {default}")


def main():
    exhibit = Exhibit("Beside other codes", __doc__, add_arguments)
    turns = exhibit.arguments.turns or (QUICK_TURNS if exhibit.quick else TURNS)
    folder = exhibit.out.resolve() / ("bed-tiny" if exhibit.quick else "bed")
    beds.settle("liggghts", folder, 1, exhibit.quick)
    bed = beds.copies("liggghts", folder, 1, QUICK_SPHERES if exhibit.quick else SPHERES)

    codes = {name: code for name, code in CODES.items() if not code.missing}
    left_out = [f"{name.program} is not installed: {name.style} is left out." for name in CODES if name not in codes]
    for line in left_out:
        print(line, flush=True)
    found = measure_all(exhibit, bed, codes, turns)
    exhibit.text(
        f"""{bed.spheres:,} spheres on a floor between periodic sides, {bed.nx} by {bed.ny} copies of a bed that
        LIGGGHTS settled, continued by each code from the same positions and velocities, at dt = tc/nt, in one process
        with one thread. User time of the steps after the first {SHORT}; median and range of {turns} turns, ratios turn
        by turn. Contacts are linear springs and dashpots with Coulomb friction, the same numbers in all; LIGGGHTS and
        YADE limit the spring's part of friction to mu fn, the others its sum with the dashpot's. Lists reach 5 mm
        beyond contact. cfpm `verlet` is the host's own method, `impulse` one for steps as long as a contact, at which
        it has larger overlaps: the bed sinks to these for {SINKING} steps before it is timed. Touches are those after
        the last step. {" ".join(left_out)}"""
    )
    summarise(exhibit, found)
    exhibit.text(
        """Stock needs no nt = 30 everywhere: beds that settle are right from nt = 6 on, and its time per simulated
        second goes as nt. ESyS-Particle 2.3.5 is not among the codes as it cannot hold this bed: its walls have neither
        friction nor damping, its linear law with friction no dashpot."""
    )
    exhibit.plot(plot(found), "peers", "User time of a step and of a simulated second, over stock LIGGGHTS's.")
    judge(exhibit, found)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
