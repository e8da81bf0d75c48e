# SPDX-License-Identifier: GPL-2.0-or-later
"""Packing ratio of gran/cfpm against the stock style at nt = 30, over an ensemble of random starts.

A bed is chaotic: one run scatters by about 1 %, so every seed is run with each method from the same
start and the differences are averaged. Prints mean and standard error and writes packing.csv.

The stock style limits only the spring's part of friction to mu fn and adds the tangential dashpot on
top; the paper, and gran/cfpm, limit the sum (Eq. 10). With the paper's dashpot the two styles therefore
have different laws at any step, and cfpm at nt = 30 is the reference that shows the effect of the step
alone. Without the dashpot the laws are the same.
"""

import argparse
import concurrent.futures
import csv
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

import packing

CASES = [("stock", 30), ("cfpm", 30), ("cfpm", 6), ("cfpm", 3)]


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
            end = "\r" if sys.stdout.isatty() and done < len(jobs) else "\n"
            print(f"packing, dashpot {dashpot}: {done} of {len(jobs)} runs", end=end, flush=True)
    return {case: np.array(values) for case, values in ratios.items()}


def mean_and_error(values):
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))


def difference(values, reference):
    """Mean and standard error of the paired differences, in percent of the reference."""
    return mean_and_error(100 * (values - reference) / reference.mean())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for packing.csv")
    parser.add_argument("--seeds", type=int, default=8, help="random starts (default 8)")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)

    rows = []
    for dashpot in ["off", "on"]:
        ratios = ensemble(arguments.seeds, CASES, dashpot)
        for (style, nt), values in ratios.items():
            against_stock = difference(values, ratios["stock", 30])
            against_cfpm = difference(values, ratios["cfpm", 30])
            rows.append([dashpot, style, nt, len(values), *mean_and_error(values), *against_stock, *against_cfpm])
    with open(arguments.out / "packing.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow("dashpot style nt seeds ratio error stock30 stock30_error cfpm30 cfpm30_error".split())
        writer.writerows(rows)
    print(f"\n{arguments.seeds} seeds                    difference [%] to")
    print("dashpot  style   nt   packing ratio        stock, nt = 30     cfpm, nt = 30")
    for dashpot, style, nt, _, ratio, error, d, de, c, ce in rows:
        print(f"{dashpot:8} {style:6} {nt:3}   {ratio:.4f} +- {error:.4f}   {d:+.2f} +- {de:.2f}     {c:+.2f} +- {ce:.2f}")


if __name__ == "__main__":
    main()
