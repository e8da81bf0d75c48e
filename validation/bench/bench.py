# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of a step: gran/cfpm beside the stock style, or beside another build of itself, on one and the same bed.

Each host settles a small bed once (kept in the result folder). Copies of it side by side are continued in turn, stock,
cfpm, stock, cfpm ..., so that a change in the machine's speed hits both. At 30 steps per contact time both keep the bed
at rest; how many others a sphere touches at the end is printed beside the cost, which grows with it. Prints the median
time per particle and step on the clock, the ratio pair by pair, median and range, and that of the fastest run of each,
for each set of instructions; or, with --memory, what a particle takes; or, with --decks, the user time of decks of the
hosts' packages from begin to end. With --against steps as long as a contact are
timed too, of the bed at rest and of one on which spheres still land.
"""

import argparse
import sys
from pathlib import Path

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])
import bed  # noqa: E402
import memory  # noqa: E402
import tables  # noqa: E402
import timing  # noqa: E402
import whole_runs  # noqa: E402
from harness import HOSTS  # noqa: E402
from rows import ROWS, chosen  # noqa: E402

QUICK = {"ranks": [1], "pairs": 1, "steps": 10, "spheres": [600]}
WEIGHED = (100_000, 10_000)  # spheres for memory, and with --quick


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for the beds, costs.csv and memory.csv")
    parser.add_argument("--hosts", nargs="+", choices=HOSTS, default=list(HOSTS), help="default both")
    parser.add_argument("--rows", nargs="+", metavar="WORD", help="only those with one of these: hertz, impulse ...")
    parser.add_argument("--spheres", nargs="+", type=int, default=[timing.STEPS_OF], help="about; default 23400")
    parser.add_argument("--sizes", nargs="+", type=int, choices=[0, 1, 2], default=[1], help="0: any; default 1")
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2], help="default 1 2")
    parser.add_argument("--simd", nargs="+", default=[None], help="values of CFPM_SIMD; default the plugin's choice")
    parser.add_argument("--pairs", type=int, default=9, help="measurements of each style (default 9)")
    parser.add_argument("--steps", type=int, default=200, help="of a measurement (default 200); fewer of a large bed")
    parser.add_argument("--against", type=Path, metavar="BUILD", help="folder of another build, in place of stock")
    parser.add_argument("--memory", action="store_true", help="bytes per particle on one rank, in place of time")
    parser.add_argument("--decks", action="store_true", help="user time of whole decks of others, in place of steps")
    parser.add_argument("--quick", action="store_true", help="tiny beds, once: whether all rows run, as the tests ask")
    arguments = parser.parse_args()
    if arguments.quick:
        vars(arguments).update(QUICK)
    arguments.out = arguments.out.resolve()
    return arguments


def make_beds(arguments, spheres):
    """{host: its beds of about as many spheres}"""
    beds = {}
    for host in arguments.hosts:
        beds[host] = []
        for sizes in arguments.sizes:
            folder = arguments.out / f"{host}-{sizes}{'-tiny' if arguments.quick else ''}"
            bed.settle(host, folder, sizes, arguments.quick)
            beds[host] += [bed.copies(host, folder, sizes, count) for count in spheres]
    return beds


def time_all(arguments, rows):
    beds = make_beds(arguments, arguments.spheres)
    with open(arguments.out / "costs.csv", "w", newline="") as file:
        table = tables.CostTable(file, arguments.simd, timing.name_of_other(arguments.against))
        for row in rows:
            pairs = [timing.pair(row.host, simd, arguments.against) for simd in arguments.simd]
            for own in beds[row.host]:
                for ranks in arguments.ranks:
                    case = row, own, ranks, arguments.steps
                    table.add(*case[:3], timing.in_turn(pairs, arguments.pairs, *case))


def weigh_all(arguments, rows):
    beds = make_beds(arguments, [WEIGHED[arguments.quick]])
    with open(arguments.out / "memory.csv", "w", newline="") as file:
        table = tables.MemoryTable(file, timing.name_of_other(arguments.against))
        for row in filter(ROWS.__contains__, rows):
            pair = timing.pair(row.host, None, arguments.against)
            for own in beds[row.host]:
                table.add(row, own, *(memory.per_particle(program, row, own) for program in pair))


def main():
    arguments = read_arguments()
    arguments.out.mkdir(parents=True, exist_ok=True)
    if arguments.decks:
        return whole_runs.time_all(arguments)
    rows = chosen(arguments.hosts, arguments.rows, arguments.against)
    if not rows:
        sys.exit(f"bench: no row has any of {' '.join(arguments.rows)}; expected a word of the table's first columns")
    if arguments.memory:
        weigh_all(arguments, rows)
    else:
        time_all(arguments, rows)


if __name__ == "__main__":
    main()
