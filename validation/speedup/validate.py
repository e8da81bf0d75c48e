# SPDX-License-Identifier: GPL-2.0-or-later
"""The verdict on section 3.2: speedup at equal accuracy, and each claim of the paper beside what came out here.

How many steps each method needs is read from what packing and discharge found; the decks are then run at these, one at
a time and in turn, and their CPU times compared.
"""

import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / folder) for folder in ("", "packing", "discharge")]
import ensemble  # noqa: E402
import outlet  # noqa: E402
import packing  # noqa: E402
from averages import spread  # noqa: E402
from cases import DASHPOT, EXACT, RK4, STOCK, Case  # noqa: E402
from claims import HOSTS, Findings  # noqa: E402
from exhibit import Exhibit  # noqa: E402

FILES = {"packing": ("packing", "limits"), "discharge": ("discharge", "limits"), "scaling": ("scaling",)}
NEW = {"packing": (EXACT, RK4), "discharge": (EXACT,)}  # methods that are timed
FINE = 30  # nt that practice takes for safe
QUICK_NT = {STOCK: 6, EXACT: 3, RK4: 3}  # where no exhibit has found any
QUICK_DURATION = 0.15  # [s]
LARGEST_COST = 1.2  # the paper's, of a step


def read_files(exhibit):
    """{"packing": rows, "packing/limits": rows, ...} of what the other exhibits left; in quick of those that did."""
    found = {}
    for folder, names in FILES.items():
        for name in names:
            path = exhibit.out.parent / folder / f"{name}.csv"
            if path.exists():
                with open(path, newline="") as file:
                    found[folder if name == folder else f"{folder}/{name}"] = list(csv.DictReader(file))
            elif not exhibit.quick:
                sys.exit(f"validate speedup: no {path}; './cfpm validate {folder}' makes it")
    return found


def needed(exhibit, files, deck, host, methods):
    """{method: smallest nt that gives the right answer}"""
    limits = {(row["host"], row["dashpot"], row["method"]): row for row in files.get(f"{deck}/limits", [])}
    found = {}
    for method in methods:
        row = limits.get((host, DASHPOT[host], method))
        found[method] = float(row["agrees_at"]) if row else np.inf
        if exhibit.quick and not np.isfinite(found[method]):
            found[method] = QUICK_NT[method]
        elif not np.isfinite(found[method]):
            sys.exit(f"validate speedup: {deck} found no nt at which {HOSTS[host]}, {method} agrees with the reference")
    return found


def makers(exhibit, hosts):
    """{(deck, host): function that makes the run of a case}"""
    seed = packing.primes(1)[0]
    short = {"duration": QUICK_DURATION} if exhibit.quick else {}
    beds = ensemble.run(
        [outlet.settling(host, DASHPOT[host], seed) for host in hosts], exhibit.runs, "speedup, beds of the discharge"
    )
    found = {}
    for host, bed in zip(hosts, beds):
        found["packing", host] = lambda case: packing.settling(case.host, seed=seed, **case.variables(), **short)
        start = outlet.bed(bed)
        found["discharge", host] = lambda case, start=start: outlet.discharging(
            case.host, start, **case.variables(), **short
        )
    return found


def time_all(exhibit, hosts, files):
    """{(deck, host): ({method: nt}, {(method, nt): CPU seconds, one per turn})}"""
    found = {}
    for (deck, host), make in makers(exhibit, hosts).items():
        nts = needed(exhibit, files, deck, host, (STOCK, *NEW[deck]))
        todo = dict.fromkeys([*nts.items(), (STOCK, FINE), (EXACT, FINE)])
        runs = {one: make(Case(host, DASHPOT[host], *one)) for one in todo}
        turns = exhibit.arguments.turns or (2 if exhibit.quick else 5)
        timings = ensemble.in_turn(runs, exhibit.runs, turns, f"speedup, {deck} in {HOSTS[host]}")
        found[deck, host] = nts, {one: np.array([t.cpu_seconds for t in own]) for one, own in timings.items()}
    return found


def compare(exhibit, timings):
    """{(deck, host, new method, "own" or "fine"): speedup, one per turn}, and {(deck, host): cost of a step}."""
    speedups, costs, rows, shown = {}, {}, [], []
    for (deck, host), (nts, seconds) in timings.items():
        costs[deck, host] = seconds[EXACT, FINE] / seconds[STOCK, FINE]
        for method in NEW[deck]:
            for which, nt in (("own", nts[STOCK]), ("fine", FINE)):
                old, new = seconds[STOCK, nt], seconds[method, nts[method]]
                speedups[deck, host, method, which] = gain = old / new
                low, middle, high = np.quantile(gain, (0, 0.5, 1))
                rows.append([deck, host, method, nts[method], nt, np.median(new), np.median(old), middle, low, high])
                shown.append(
                    [deck, HOSTS[host], method, f"{nts[method]:g}", f"{nt:g}" + (", its own" if which == "own" else "")]
                    + [f"{np.median(new):.2f}", f"{np.median(old):.2f}", f"{nt / nts[method]:.1f}", spread(gain)]
                )
    names = "deck host method nt conventional_nt cpu_seconds conventional_cpu_seconds speedup speedup_min speedup_max"
    exhibit.csv("speedup", names.split(), [[f"{x:.6g}" if isinstance(x, float) else x for x in row] for row in rows])
    exhibit.table(
        ["deck", "host", "method", "nt", "conventional, nt", "CPU s", "conventional, CPU s", "steps, times fewer"]
        + ["faster, median and range"],
        shown,
    )
    exhibit.text(f"CPU time of {EXACT} over the conventional method's, both at nt = {FINE}:")
    exhibit.table(
        ["deck", "host", "cost of a step, median and range"],
        [[deck, HOSTS[host], spread(cost)] for (deck, host), cost in costs.items()],
    )
    return speedups, costs


def tell_claims(exhibit, findings, files):
    """Those of which all files are there."""
    claims = []
    for section, names in FILES.items():
        if all((section if name == section else f"{section}/{name}") in files for name in names):
            claims += getattr(findings, section)()
    if not claims:
        return
    exhibit.text(
        """Each claim of sections 3.2 and 4 of the paper and what came out here. A threshold counts as reproduced within
        a factor 2, a gain if it is the paper's or more."""
    )
    columns, rows = ["claim", "paper", "here", "reproduced", "why"], [claim.row() for claim in claims]
    exhibit.csv("claims", columns, rows)
    exhibit.table(columns, rows)


def judge(exhibit, speedups, costs):
    for (deck, host), cost in costs.items():
        allowed = 2 * LARGEST_COST if exhibit.quick else LARGEST_COST  # a quick answer is a test, on whatever machine
        exhibit.verdict(
            f"{deck}, {HOSTS[host]}: a step of {EXACT} costs {np.median(cost):.2f} of a conventional one, allowed "
            f"{allowed:g}",
            np.median(cost) <= allowed,
        )
        gain = np.median(speedups[deck, host, EXACT, "fine"])
        exhibit.verdict(
            f"{deck}, {HOSTS[host]}: {EXACT} at its smallest nt is {gain:.1f} times faster than the conventional "
            f"method at nt = {FINE}",
            gain > 1,
        )


def add_arguments(parser):
    parser.add_argument("--turns", type=int, help="how often each run is timed (default 5, quick 2)")
    parser.add_argument("--hosts", nargs="+", choices=HOSTS, default=list(HOSTS), help="default both")


def main():
    exhibit = Exhibit("Speedup and the paper's claims (section 3.2)", __doc__, add_arguments)
    files = read_files(exhibit)
    hosts = exhibit.arguments.hosts
    timings = time_all(exhibit, hosts, files)
    exhibit.text(
        f"""How much less CPU time the new method takes for the same answer: each method at the smallest nt at which its
        ensemble agreed with the reference (see packing and discharge), the conventional one also at nt = {FINE}. The
        whole deck from one start, one run at a time, all in turn; each turn gives one ratio."""
    )
    if exhibit.quick:
        exhibit.text(f"Quick: only {QUICK_DURATION:g} s of each deck.")
    speedups, costs = compare(exhibit, timings)
    tell_claims(exhibit, Findings(hosts, files, speedups, costs), files)
    judge(exhibit, speedups, costs)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
