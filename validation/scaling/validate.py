# SPDX-License-Identifier: GPL-2.0-or-later
"""Two sizes of particle and many of them (section 4): what a step costs up to ten million particles.

Each host settles one small bed of two sizes (kept) and sets copies of it side by side, from tens of thousands of
particles to ten million or as many as the free memory holds. Both styles continue each bed in turn, stock, cfpm, stock,
cfpm ..., on 1 rank and on 2.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import bidisperse  # noqa: E402
import ensemble  # noqa: E402
from bidisperse import NT  # noqa: E402
from exhibit import Exhibit, progress  # noqa: E402
from step_cost import StepCost, of_last_loop  # noqa: E402

HOSTS = {"liggghts": "LIGGGHTS", "lammps": "LAMMPS"}
STYLES = ("stock", "cfpm")
RANKS = (1, 2)
CONTACT_TIME = 2.0e-4  # theirs [s], as in the deck

PAPER_PARTICLES = 10**7  # "useful for two sizes of particle at a number of approximately 10 million"
PAPER_LIMIT = 10**8  # "the number of particles calculated in DEM will be limited to 100 million"
PAPER_COST = 1.2  # of a step, new over conventional, in the packing
SIZES = {20_000: 5, 200_000: 5, 2_000_000: 3, PAPER_PARTICLES: 1}  # particles: how often each style is timed
QUICK_SIZES = {5_000: 2, 20_000: 2}
TIMED, QUICK_TIMED = 4_000_000, 1_000_000  # particle-steps of a run, but not fewer steps than
LEAST_STEPS = 10
SHARE = 0.7  # of the free memory that a bed may take
LARGEST_GROWTH = 1.5  # of the time per particle-step from the smallest bed to the largest: else nothing is extrapolated


class Case(NamedTuple):
    host: str
    size: int  # particles that are wanted
    ranks: int


def count(bed):
    """Particles of a data file."""
    with open(bed) as file:
        return next(int(line.split()[0]) for line in file if line.strip().endswith(" atoms"))


def measure(exhibit, case, style, bed):
    copies = case.size / count(bed)
    nx = max(1, round(copies**0.5))
    steps = max(LEAST_STEPS, round((QUICK_TIMED if exhibit.quick else TIMED) / case.size))
    ny = max(1, round(copies / nx))
    run = bidisperse.timed(case.host, bed, nx, ny, style=style, nt=NT, steps=steps)
    log, _ = ensemble.alone(run, exhibit.runs, case.ranks)
    return of_last_loop(log, case.ranks)


def free_memory():
    """Bytes that new processes can have."""
    lines = Path("/proc/meminfo").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("MemAvailable"))


def measure_all(exhibit, beds, sizes):
    """{case: array of (turn, style, quantity of StepCost)} and the bytes that were free before the largest beds.

    A bed that would not fit is made as large as fits, as long as it is larger than the ones before.
    """
    samples, done = {}, []
    for size, repetitions in sizes.items():
        free = free_memory()
        if done:
            need = max(table[:, :, 2].max() for case, table in samples.items() if case.size == done[-1])
            size = min(size, int(SHARE * free / need))
            if size <= done[-1]:
                break
        done.append(size)
        cases = [Case(host, size, ranks) for host in beds for ranks in RANKS]
        for k, case in enumerate(cases, 1):
            bed = beds[case.host]
            turns = [[measure(exhibit, case, style, bed) for style in STYLES] for _ in range(repetitions)]
            samples[case] = np.array(turns)
            progress(k, len(cases), f"scaling, {size} particles, hosts and ranks")
    return samples, free


def ratios(table):
    """Of the time of a step, cfpm over stock, turn by turn."""
    return table[:, 1, 1] / table[:, 0, 1]


def summarise(exhibit, samples):
    rows, shown = [], []
    for (host, _, ranks), table in sorted(samples.items(), key=lambda item: (item[0].host != "liggghts", *item[0][1:])):
        particles = int(table[0, 0, 0])
        low, ratio, high = np.quantile(ratios(table), (0, 0.5, 1))
        (_, stock, stock_bytes), (_, cfpm, cfpm_bytes) = np.median(table, axis=0)
        rows.append([host, particles, ranks, len(table), stock, cfpm, ratio, low, high, stock_bytes, cfpm_bytes])
        shown.append(
            [HOSTS[host], f"{particles:,}", ranks, len(table), f"{stock:.0f}", f"{cfpm:.0f}"]
            + [f"{ratio:.2f} ({low:.2f} - {high:.2f})", f"{stock_bytes:.0f}", f"{cfpm_bytes:.0f}"]
        )
    names = "host particles ranks turns stock_ns cfpm_ns ratio ratio_min ratio_max stock_bytes cfpm_bytes"
    exhibit.csv("scaling", names.split(), [[f"{x:.6g}" if isinstance(x, float) else x for x in row] for row in rows])
    exhibit.table(
        ["host", "particles", "ranks", "turns", "stock, ns", "cfpm, ns", "cfpm/stock, median and range"]
        + ["stock, bytes", "cfpm, bytes"],
        shown,
    )


def largest(samples, host, ranks=RANKS[-1]):
    """Of all samples of the largest bed the medians over the turns, {style: StepCost}."""
    case = max(case for case in samples if case.host == host and case.ranks == ranks)
    return {style: StepCost(*row) for style, row in zip(STYLES, np.median(samples[case], axis=0))}


def extrapolate(exhibit, samples, hosts):
    """Memory and time for the paper's numbers of particles."""
    steps = NT / CONTACT_TIME
    rows = []
    for host in hosts:
        for style, cost in largest(samples, host).items():
            row = [HOSTS[host], style, f"{cost.nanoseconds:.0f}", f"{cost.bytes:.0f}"]
            for n in (PAPER_PARTICLES, PAPER_LIMIT):
                hours = cost.nanoseconds * 1e-9 * n * steps / 3600
                row += [f"{cost.bytes * n / 2**30:.0f}", f"{hours:,.0f}"]
            rows.append(row)
    exhibit.text(
        f"""What this comes to for the paper's 10 and 100 million particles on {RANKS[-1]} ranks: memory, and hours for
        one simulated second at nt = {NT}, {steps:,.0f} steps. It takes the time and the memory per particle of the
        largest bed here as the same for any number. That leaves out building neighbour lists, which a bed at rest
        hardly does, and what more ranks cost and win. Hours go with nt and with the ranks."""
    )
    columns = [f"{n:.0e} particles: {what}" for n in (PAPER_PARTICLES, PAPER_LIMIT) for what in ("GiB", "hours")]
    exhibit.table(["host", "style", "ns", "bytes", *(name.replace("e+0", "e") for name in columns)], rows)


def plot(samples, hosts):
    figure, panels = plt.subplots(1, len(hosts), figsize=(5.5 * len(hosts), 4), sharey=True, squeeze=False)
    for axes, host in zip(panels[0], hosts):
        for k, style in enumerate(STYLES):
            for ranks in RANKS:
                tables = [table[:, k] for case, table in samples.items() if (case.host, case.ranks) == (host, ranks)]
                particles, time = np.transpose([np.median(table, axis=0)[:2] for table in tables])
                spread = np.abs(np.transpose([np.quantile(table[:, 1], (0, 1)) for table in tables]) - time)
                line = {"color": f"C{3 * k}", "marker": "os"[k], "linestyle": ("-", "--")[ranks - 1], "capsize": 3}
                axes.errorbar(particles, time, spread, label=f"{style}, {ranks} rank" + "s" * (ranks > 1), **line)
        axes.set(title=HOSTS[host], xscale="log", xlabel="Particles", ylim=(0, None))
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    panels[0, 0].set(ylabel="ns per particle and step")
    figure.tight_layout()
    return figure


def judge(exhibit, samples, hosts):
    allowed = 2 * PAPER_COST if exhibit.quick else PAPER_COST  # a quick answer is a test, on whatever machine
    for host in hosts:
        own = {case: table for case, table in samples.items() if case.host == host}
        worst = max(np.median(ratios(table)) for table in own.values())
        claim = f"{HOSTS[host]}: a step of cfpm takes at most {worst:.2f} times stock's, allowed {allowed:g}"
        exhibit.verdict(claim, worst <= allowed)
        if exhibit.quick:
            continue
        sizes = [case.size for case in own]
        few, many = (own[Case(host, size, 1)] for size in (min(sizes), max(sizes)))
        small, large = (np.median(table[:, 1, 1]) for table in (few, many))
        exhibit.verdict(
            f"{HOSTS[host]}, 1 rank: cfpm takes {large:.0f} ns per particle-step at the most particles, {small:.0f} ns "
            f"at the fewest, allowed {LARGEST_GROWTH:g} times as much",
            large <= LARGEST_GROWTH * small,
        )
        most = int(many[0, 1, 0])
        exhibit.verdict(
            f"{HOSTS[host]}: cfpm runs {most:,} particles of two sizes; the paper: about {PAPER_PARTICLES:,}",
            most >= 0.98 * PAPER_PARTICLES,
        )


def add_arguments(parser):
    parser.add_argument("--hosts", nargs="+", choices=HOSTS, help="default both, quick liggghts")
    parser.add_argument("--largest", type=int, default=PAPER_PARTICLES, help="particles at most (default 1e7)")


def main():
    exhibit = Exhibit("Many particles of two sizes (section 4)", __doc__, add_arguments)
    hosts = exhibit.arguments.hosts or (["liggghts"] if exhibit.quick else list(HOSTS))
    sizes = QUICK_SIZES if exhibit.quick else SIZES
    sizes = {n: turns for n, turns in sizes.items() if n <= exhibit.arguments.largest}
    if not sizes:
        sys.exit(f"validate scaling: --largest is below {min(SIZES):,}, the smallest bed")
    beds = bidisperse.settle(hosts, exhibit.runs)
    samples, free = measure_all(exhibit, beds, sizes)

    most = max(int(table[0, 0, 0]) for table in samples.values())
    gibibytes = max(table[0, :, 0].max() * table[0, :, 2].max() for table in samples.values()) / 2**30
    exhibit.text(
        f"""Spheres of 50 and 100 mm, half of the volume each, mixed at random and settled on a floor between periodic
        sides: {count(beds[hosts[0]]):,} in {HOSTS[hosts[0]]}, then copies of that bed. The law is the packing's, nt =
        {NT} for two small spheres. Contact history begins anew with the copies; the steps that are timed come after
        some that are not. Time on the clock per particle and step, medians; stock and cfpm in turn. Bytes per
        particle over all ranks as the host counts them. A bed may take {100 * SHARE:.0f} % of the free memory, which
        was {free / 2**30:.1f} GiB; the largest one, {most:,} particles, took {gibibytes:.1f} GiB."""
    )
    summarise(exhibit, samples)
    exhibit.plot(plot(samples, hosts), "scaling", "Time of a step per particle over the number of particles.")
    extrapolate(exhibit, samples, hosts)
    judge(exhibit, samples, hosts)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
