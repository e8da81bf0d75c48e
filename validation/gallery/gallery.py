# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the decks of docs/gallery.md, each with its recommended step on one core, and draws how they end.

Leaves a picture for each and prints the table of that page: what was run, how many grains and steps, the least number
nt of steps in a contact where the log gives it, and the processor time of the host in user mode.
"""

import argparse
import re
import resource
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from picture import View, circle, draw, edges_of_stl

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness import HOSTS  # noqa: E402
from harness.decks import deck, options  # noqa: E402
from harness.output import loops, read_dump, vectors  # noqa: E402

HOPPER = deck("liggghts", "hopper").parent / "meshes" / "hopper.stl"
UNMODIFIED = ("-predict", "impulse", "-suffix", "cfpm")
IMPULSE = {"style": "cfpm", "predict": "impulse"}
LOOK = "write_dump all custom end.dump id type x y z radius vx vy vz\n"
SIZE = np.array([520, 400])  # of a picture, at most


@dataclass(frozen=True)
class Run:
    name: str
    host: str
    deck: str
    variables: dict  # of the deck, which a reader gives too
    quick: dict  # that shorten it for a test
    view: View
    words: tuple = ()  # of the host's command line
    shade: str = "z"  # what grains are coloured by
    edges: list = field(default_factory=list)

    def command(self):
        given = [f"-var {name} {value}" for name, value in self.variables.items() if name != "mesh"]
        return " ".join(["./cfpm run", f"inputs/{self.host}/in.{self.deck}", *self.words, *given])


RUNS = (
    Run("packing", "liggghts", "packing", {**IMPULSE, "nt": 1, "n": 1000}, {"n": 50, "duration": 0.1},
        View(25, 12)),
    Run("hopper", "liggghts", "hopper", {"dt": 2e-4, "mesh": HOPPER}, {"n": 300, "fill": 0.02, "duration": 0.02},
        View(20, 15), UNMODIFIED, "speed", edges_of_stl(HOPPER)),
    Run("drum", "lammps", "granular.drum", {}, {"duration": 1e-3}, View(0, 0), ("-suffix", "cfpm"), "speed",
        [circle(0.05, 0.0, "y")]),
    Run("chute", "lammps", "chute", {**IMPULSE, "nt": 2, "duration": 10}, {"layers": 2, "duration": 0.1}, View(25, 20),
        shade="speed"),
    Run("collapse", "lammps", "collapse", {"nt": 2}, {"layers": 4, "fill": 0.02, "duration": 0.02}, View(20, 25),
        UNMODIFIED, edges=[circle(0.05, 0.0, "z"), circle(0.05, 0.07, "z")]),
    Run("two sizes", "lammps", "bidisperse", {**IMPULSE, "nt": 1}, {"columns": 2, "layers": 4}, View(25, 12),
        shade="radius"),
)


def settled(run, folder, quick):
    """What the host said, and its processor time in user mode [s]."""
    variables = {**run.variables, **(run.quick if quick else {})}
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    text = deck(run.host, run.deck).read_text() + LOOK
    said = HOSTS[run.host].run(text, folder, options=[*run.words, *options(variables)], timeout=None).stdout
    return said, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def drawn(run, dump):
    ((_, grains),) = read_dump(dump)
    shades = {
        "z": grains["z"], "radius": grains["radius"],
        "speed": np.linalg.norm(vectors(grains, "vx", "vy", "vz"), axis=1),
    }[run.shade]
    low, high = np.percentile(shades, [2, 98])
    shades = np.clip((shades - low) / max(high - low, 1e-300), 0, 1)
    return draw(vectors(grains, "x", "y", "z"), grains["radius"], 0.15 + 0.8 * shades, run.view, SIZE, run.edges)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for the pictures")
    parser.add_argument("--quick", action="store_true", help="few grains for a moment: whether all of it goes")
    parser.add_argument("--runs", nargs="+", choices=[run.name for run in RUNS], help="only these")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    print("| run | command | grains | steps | nt | user time [s] |\n|---|---|---|---|---|---|")
    for run in RUNS:
        if arguments.runs and run.name not in arguments.runs:
            continue
        with tempfile.TemporaryDirectory() as folder:
            said, seconds = settled(run, folder, arguments.quick)
            picture = drawn(run, Path(folder) / "end.dump")
        picture.quantize(128).save(arguments.out / f"{run.name.replace(' ', '-')}.png", optimize=True)
        done = loops(said)
        counts = [float(nt) for nt in re.findall(r"nt = tc/dt = ([\d.]+) to", said)]
        least = f"{min(counts):.2g}" if counts else "-"
        steps = sum(loop.steps for loop in done)
        row = (run.name, f"`{run.command()}`", done[-1].particles, steps, least, f"{seconds:.2g}")
        print("| " + " | ".join(str(cell) for cell in row) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
