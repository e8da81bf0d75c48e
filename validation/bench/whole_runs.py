# SPDX-License-Identifier: GPL-2.0-or-later
"""Times decks that others wrote from their first line to their last, at their own step: user time of stock, or of
another build, and of this one, in turn. Lists, insertion, meshes, regions and output are in it, which rows of the bench
leave out."""

import csv
import resource
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np
import tables
from harness import HOSTS, host
from timing import name_of_other

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "decks"))
from decks import FOLDERS, PARTS, Deck  # noqa: E402
from rewriting import Rewriting  # noqa: E402

DECKS = {
    "liggghts": [  # walls on all sides, then meshes that rest, are moved, and move by themselves
        "packing/in.packing",
        "meshGran/in.meshGran",
        "chute_wear/in.chute_wear",
        "movingMeshGran/in.movingMeshGran",
        "contactModels/in.newModels",
    ],
    "lammps": [  # small hoppers and mixers, of regions
        "granregion/in.granregion.funnel",
        "granregion/in.granregion.mixer",
        "granregion/in.granregion.box",
        "pour/in.pour",
    ],
}
PREDICT = ("auto", "impulse")  # auto: at these decks' steps the host's own method
QUICK_PART = 0.01
HEADER = "host deck predict other other_s cfpm_s ratio ratio_min ratio_max"


def user_time(program, deck, options, part):
    """In seconds, of all ranks."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder) / "deck"
        shutil.copytree(deck.path.parent, work)
        (work / "post" / "restart").mkdir(parents=True, exist_ok=True)  # where the tutorials write
        text = Rewriting(deck, part=part).text()
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        host.run(program, text, work, np=deck.ranks, options=("-log", "none", *options), timeout=None)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def pair(name, predict, build):
    """Program and its options: of stock or of the other build, and of this one."""
    launcher = Path(HOSTS[name].LAUNCHER)
    options = ("-predict", predict, "-suffix", "cfpm")
    other = (build.resolve() / "bin" / launcher.name, options) if build else (HOSTS[name].STOCK, ())
    return other, (launcher, options)


def time_all(arguments):
    other = name_of_other(arguments.against)
    print(f"{'host':9} {'deck':34} {'predict':8} | user time in s, {other} and cfpm, and their ratio (min - max)")
    with open(arguments.out / "decks.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(HEADER.split())
        for name in arguments.hosts:
            if not FOLDERS[name].is_dir():  # dpkg may be told to leave out documentation
                print(f"no folder {FOLDERS[name]}: its decks are left out", flush=True)
                continue
            decks = [Deck(name, FOLDERS[name] / path) for path in DECKS[name][: 1 if arguments.quick else None]]
            for deck, predict in [(deck, predict) for deck in decks for predict in PREDICT]:
                part = PARTS.get(deck.name, 1.0) * (QUICK_PART if arguments.quick else 1.0)
                times = []
                for turn in range(arguments.pairs):
                    tables.progress(f"{deck.name} {predict}: pair {turn + 1} of {arguments.pairs}")
                    programs = pair(name, predict, arguments.against)
                    times.append([user_time(str(path), deck, options, part) for path, options in programs])
                low, middle, high = np.quantile(np.divide(*np.transpose(times)[::-1]), (0, 0.5, 1))
                seconds = np.median(times, axis=0)
                tables.progress("")
                print(
                    f"{name:9} {deck.name:34} {predict:8} | {seconds[0]:7.2f} {seconds[1]:7.2f}   "
                    f"{middle:.2f} ({low:.2f} - {high:.2f})",
                    flush=True,
                )
                numbers = (*seconds, middle, low, high)
                table.writerow([name, deck.name, predict, other, *(f"{x:.4g}" for x in numbers)])
