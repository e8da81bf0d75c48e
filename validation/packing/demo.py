# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's packing (section 3.2.1) on 2 ranks: gran/cfpm at nt = 6 beside the stock style at nt = 30.

Same random start. Leaves energy.png (as Fig. 7 of the paper), bed.png (the settled bed), the CSV files
and summary.txt.
"""

import argparse
import shutil
import sys
import time
from pathlib import Path

import packing
import matplotlib.pyplot as plt
from PIL import Image

from exhibit import progress  # whose plots have the look of all others
from packing import ensemble

SEED = 15485863
RANKS = 2
DURATION = 1.2  # simulated time [s]
CASES = [("cfpm", 6), ("stock", 30)]


def settle(folder, style, nt):
    """One run on all ranks, never taken from an earlier demo, as long as it takes."""
    variables = {"style": style, "nt": nt, "seed": SEED, "duration": DURATION, "picture": 1}
    run = ensemble.Run("liggghts", packing.DECKS["liggghts"], variables)
    process = ensemble.start(run, folder, RANKS)
    try:
        watch(process, folder / "packing.csv", f"demo: {style}, nt = {nt}, % of the simulated time")
    finally:  # also when interrupted
        process.terminate()
        process.wait()
    log = (folder / "log").read_text(errors="replace")
    if process.returncode != 0:
        ensemble.fail(run, folder, process.returncode, log)
    steps, seconds, nanoseconds = ensemble.longest_loop(log)
    return packing.read(ensemble.Result(folder, False, None, steps, seconds, nanoseconds))


def watch(process, csv, what):
    """Shows how much of the simulated time the last line of the CSV file has reached until the process ends."""
    shown = 0
    while process.poll() is None:
        time.sleep(0.1)
        complete = csv.read_text().rpartition("\n")[0].splitlines() if csv.exists() else []
        percent = int(100 * float(complete[-1].split(",")[0]) / DURATION) if len(complete) > 1 else 0
        if shown < percent < 100:
            shown = percent
            progress(shown, 100, what)
    progress(100, 100, what)


def plot_energy(results, file):
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for (style, nt), result in results.items():
        label = f"nt = {nt} ({'new' if style == 'cfpm' else 'conventional'})"
        axes.plot(result.time, result.energy, label=label, linewidth=2.5 if style == "cfpm" else 1.2)
    axes.set(xlabel="Time, s", ylabel="Kinetic energy, J", xlim=(0, 0.8), ylim=(0, 25))
    axes.set_title("Packing of 200 spheres: kinetic energy of all particles")
    axes.legend()
    figure.tight_layout()
    figure.savefig(file)


def summary(results):
    lines = [
        f"Packing of 200 spheres from 1 m, stock LIGGGHTS with the cfpm plugin, {RANKS} ranks, seed {SEED}",
        "",
        "style            nt      steps   wall [s]   ns/particle-step   packing ratio   peak energy [J]",
    ]
    for (style, nt), r in results.items():
        lines.append(
            f"{style:15} {nt:3} {r.run.steps:10} {r.run.seconds:10.2f} {r.run.nanoseconds:18.0f} {r.ratio[-1]:15.4f} "
            f"{r.energy.max():17.1f}"
        )
    new, old = (results[case] for case in CASES)
    lines += [
        "",
        f"steps: {old.run.steps / new.run.steps:.1f} times fewer; "
        f"wall time: {old.run.seconds / new.run.seconds:.1f} times less; "
        f"packing ratio: {100 * (new.ratio[-1] / old.ratio[-1] - 1):+.2f} %",
        "One run scatters by about 1 %; './cfpm validate packing' averages over seeds.",
    ]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for plot, picture, CSV and summary")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)

    results = {}
    for style, nt in CASES:
        folder = out / f"{style}-nt{nt}"
        results[style, nt] = settle(folder, style, nt)
        shutil.copy(folder / "packing.csv", out / f"{style}-nt{nt}.csv")
    plot_energy(results, out / "energy.png")
    pictures = sorted((out / "cfpm-nt6").glob("packing.*.ppm"))
    Image.open(pictures[-1]).save(out / "bed.png")
    text = summary(results)
    (out / "summary.txt").write_text(text + "\n")
    print(f"\n{text}\n\nplot:    {out}/energy.png\npicture: {out}/bed.png")
    return 1 if any(result.blown_up for result in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
