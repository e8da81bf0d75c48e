# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of a step: gran/cfpm beside the stock style on one settled bed.

In each host, makes a bed of 23,400 spheres once (kept in the result folder), then lets both styles
continue it in turn, stock, cfpm, stock, cfpm ..., so that a change in the machine's speed hits both.
Both keep the bed at rest, at 30 steps per contact time; how many contacts they have at the end is
printed beside the cost of a step, which grows with it. Prints wall time per particle and step, the
ratio pair by pair (median and range), and memory per particle, for linear models of the host and for
Hertz, on 1 rank and on 2 ranks of which each holds half the bed.
"""

import argparse
import csv
import re
import sys
from pathlib import Path

import numpy as np

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])
import step_cost  # noqa: E402
from harness import HOSTS  # noqa: E402
from harness.decks import deck, options  # noqa: E402

STYLES = ["stock", "cfpm"]
CASES = {
    "liggghts": [
        # not impulse: its walls would not take the history of a bed that another method has settled
        ("hooke", "exact"),
        *(("hooke/stiffness", predict) for predict in ("exact", "verlet")),
        *(("hertz", predict) for predict in ("rk2", "rk4", "exact", "verlet")),
    ],
    "lammps": [
        *(("hooke", predict) for predict in ("exact", "impulse", "verlet")),
        *(("hertz", predict) for predict in ("rk2", "rk4", "verlet")),
    ],
}
NT = 30  # at which every style keeps the bed at rest
SETTLE = {"phase": "settle", "style": "cfpm", "nt": 6}
LARGEST_RATIO = 1.2  # what the paper reports for its own program (section 3.2.1)
TOUCHES = re.compile(r"^touches per sphere: (\S+)", re.MULTILINE)


def make_bed(host, folder):
    folder.mkdir(parents=True, exist_ok=True)
    if (folder / "bed.restart").exists():
        return
    print(f"bench: settling the bed of {host}, a few minutes ...", flush=True)
    HOSTS[host].run(deck(host, "bed"), folder, np=2, options=options(SETTLE), timeout=None)


def measure(host, folder, style, model, predict, ranks, steps):
    """Wall nanoseconds per particle and step, bytes per particle over all ranks, touches per sphere."""
    variables = {"phase": "time", "style": style, "model": model, "predict": predict, "nt": NT, "steps": steps}
    text = HOSTS[host].run(deck(host, "bed"), folder, np=ranks, options=options(variables), timeout=None).stdout
    cost = step_cost.of_last_loop(text, ranks)
    return cost.nanoseconds, cost.bytes, float(TOUCHES.search(text)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for the beds and bench.csv")
    parser.add_argument("--hosts", nargs="+", choices=HOSTS, default=list(HOSTS), help="default both")
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2], help="default 1 2")
    parser.add_argument("--pairs", type=int, default=9, help="measurements of each style (default 9)")
    parser.add_argument("--steps", type=int, default=200, help="steps of a measurement (default 200)")
    arguments = parser.parse_args()
    for host in arguments.hosts:
        make_bed(host, arguments.out / host)

    within = True
    with open(arguments.out / "bench.csv", "w", newline="") as file:
        writer = csv.writer(file)
        header = "host model predict ranks stock_ns cfpm_ns ratio ratio_min ratio_max stock_bytes cfpm_bytes"
        writer.writerow([*header.split(), "stock_touches", "cfpm_touches"])
        print(" " * 41 + "ns per particle-step    ratio cfpm/stock    touches per sphere  bytes per particle")
        print(
            "host      model           predict   ranks    stock     cfpm     median (min - max)"
            "     stock     cfpm     stock     cfpm"
        )
        for host, model, predict in [(host, *case) for host in arguments.hosts for case in CASES[host]]:
            for ranks in arguments.ranks:
                samples = []
                row = f"{host:10}{model:16}{predict:9} {ranks:4}"
                for k in range(arguments.pairs):
                    if sys.stdout.isatty():
                        print(f"\r{row}   pair {k + 1} of {arguments.pairs} ", end="\r", flush=True)
                    case = (model, predict, ranks, arguments.steps)
                    folder = arguments.out / host
                    samples.append([measure(host, folder, style, *case) for style in STYLES])
                table = np.array(samples)  # pair, style, (nanoseconds, bytes, touches)
                stock, cfpm = np.median(table[:, :, 0], axis=0)
                ratios = table[:, 1, 0] / table[:, 0, 0]
                ratio = np.median(ratios)
                memory, touches = table[0, :, 1], table[0, :, 2]
                within = within and ratio <= LARGEST_RATIO
                numbers = [stock, cfpm, ratio, ratios.min(), ratios.max(), *memory, *touches]
                writer.writerow([host, model, predict, ranks, *numbers])
                print(
                    f"{row} {stock:9.0f} {cfpm:8.0f}     {ratio:.2f} ({ratios.min():.2f} - {ratios.max():.2f})"
                    f"  {touches[0]:8.3f} {touches[1]:8.3f} {memory[0]:9.0f} {memory[1]:8.0f}"
                )
    print(f"the ratio is {'at most' if within else 'NOT at most'} the paper's {LARGEST_RATIO} in every row")
    return 0 if within else 1


if __name__ == "__main__":
    sys.exit(main())
