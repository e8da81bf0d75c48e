# SPDX-License-Identifier: GPL-2.0-or-later
"""Packing ratio of gran/cfpm against the stock style at nt = 30, over an ensemble of random starts.

A bed is chaotic: one run scatters by about 1 %, so every seed is run with each method from the same
start and the differences are averaged.

The stock style limits only the spring's part of friction to mu fn and adds the tangential dashpot on
top; the paper, and gran/cfpm, limit the sum (Eq. 10). With the paper's dashpot the two styles therefore
have different laws at any step, and cfpm at nt = 30 is the reference that shows the effect of the step
alone. Without the dashpot the laws are the same.
"""

import concurrent.futures
import os
import sys
import tempfile
from pathlib import Path

import numpy as np
import packing

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from exhibit import Exhibit, progress  # noqa: E402

CASES = [("stock", 30), ("cfpm", 30), ("cfpm", 6), ("cfpm", 3)]
LAWS = """With the dashpot the two styles are two laws, at any step: stock limits only the spring's part of friction to
mu fn, the paper and cfpm limit the sum (Eq. 10)."""


def ensemble(seeds, cases, dashpot, duration=1.2):
    """Final packing ratios {case: array over seeds}; NaN where a run blew up. As many runs at a time as cores."""
    jobs = [(case, seed) for seed in packing.primes(seeds) for case in cases]
    ratios = {case: [] for case in cases}
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:

        def one(job):
            (style, nt), seed = job
            cwd = Path(folder) / f"{style}-{nt}-{seed}"
            result = packing.run(cwd, style, nt, seed, duration=duration, dashpot=dashpot)
            return np.nan if result.blown_up else result.ratio[-1]

        for done, (job, ratio) in enumerate(zip(jobs, pool.map(one, jobs)), 1):
            ratios[job[0]].append(ratio)
            progress(done, len(jobs), f"packing, dashpot {dashpot}, runs")
    return {case: np.array(values) for case, values in ratios.items()}


def mean_and_error(values):
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))


def difference(values, reference):
    """Mean and standard error of the paired differences, in percent of the reference."""
    return mean_and_error(100 * (values - reference) / reference.mean())


def seeds_argument(parser):
    parser.add_argument("--seeds", type=int, help="random starts (default 8, quick 2)")


def main():
    exhibit = Exhibit("Packing ratio (section 3.2.1)", __doc__, seeds_argument)
    seeds = exhibit.arguments.seeds or (2 if exhibit.quick else 8)
    if seeds < 2:
        sys.exit("validate packing: --seeds is below 2; expected enough for a standard error")

    header = ["dashpot", "style", "nt", "seeds", "ratio", "error", "stock30", "stock30_error", "cfpm30", "cfpm30_error"]
    rows = []
    for dashpot in ["off", "on"]:
        ratios = ensemble(seeds, CASES, dashpot)
        for (style, nt), values in ratios.items():
            against_stock = difference(values, ratios["stock", 30])
            against_cfpm = difference(values, ratios["cfpm", 30])
            rows.append([dashpot, style, nt, len(values), *mean_and_error(values), *against_stock, *against_cfpm])
    exhibit.csv("packing", header, rows)
    exhibit.text(f"Mean and standard error over {seeds} random starts; differences are paired by start. {LAWS}")
    exhibit.table(
        ["tangential dashpot", "style", "nt", "packing ratio", "minus stock at nt = 30, %", "minus cfpm at nt = 30, %"],
        [
            [dashpot, style, nt, f"{ratio:.4f} +- {error:.4f}", f"{d:+.2f} +- {de:.2f}", f"{c:+.2f} +- {ce:.2f}"]
            for dashpot, style, nt, _, ratio, error, d, de, c, ce in rows
        ],
    )
    exhibit.verdict("no run blew up", all(np.isfinite(row[4]) for row in rows))
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
