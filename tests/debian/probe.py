# SPDX-License-Identifier: GPL-2.0-or-later
"""What the plugins do on this Debian, as JSON on standard output: run after ./cfpm build, compared by table.py.

For each host its version, whether the plugin loads, which decks of inputs/ end without an error, the last line of the
packing in serial and on 2 ranks, and where the 50 spheres of tests/lammps/test_two_hosts.py end, with the bound within which rounding may move them.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "lammps"), str(HERE.parent / "liggghts")]
import lammps  # noqa: E402
import liggghts  # noqa: E402
import test_two_hosts as spheres  # noqa: E402

HOSTS = {"liggghts": (liggghts, spheres.in_liggghts), "lammps": (lammps, spheres.in_lammps)}
LAWS = ("linear", "hertz", "impulse")
MESH = liggghts.ROOT / "inputs" / "liggghts" / "meshes" / "floor_with_hole.stl"
# in this order, in one folder: beds that later decks start from
DECKS = (
    ("packing", {"duration": 0.3, "bed": 1}),
    ("discharge", {"duration": 0.1, "mesh": MESH}),
    ("bed", {"columns": 6, "layers": 4}),
    ("bed", {"columns": 6, "layers": 4, "phase": "time"}),
    ("bidisperse", {"columns": 2, "layers": 4}),
    ("bidisperse", {"phase": "time"}),
    ("chute", {"layers": 2, "duration": 0.1}),
)


def last_line(output):
    """The last row of thermo output, without the CPU time at its end."""
    lines = output.splitlines()
    (end,) = [k for k, line in enumerate(lines) if line.startswith("Loop time")][-1:]
    return " ".join(lines[end - 1].split()[:-1])


def packing(host, module, ranks):
    with tempfile.TemporaryDirectory() as folder:
        return last_line(module.run(liggghts.ROOT / "inputs" / host / "in.packing", folder, np=ranks).stdout)


def decks(host, module):
    """How each run of a deck that the host has ended: the name of the deck and whether it was without an error."""
    ends = []
    with tempfile.TemporaryDirectory() as folder:
        for name, variables in DECKS:
            deck = liggghts.ROOT / "inputs" / host / f"in.{name}"
            if not deck.exists():
                continue
            options = [word for variable in variables.items() for word in ("-var", *variable)]
            process = module.run(deck, folder, options=options, check=False)
            ends.append((name, process.returncode == 0 and "ERROR" not in process.stdout))
    return ends


def motion(move, law):
    """Where the spheres are at the end, and the bound of a difference by rounding alone."""
    ends = []
    for disturbance in (0.0, spheres.DISTURBANCE):
        with tempfile.TemporaryDirectory() as folder:
            side = spheres.SIDE / 2
            data = Path(folder) / "spheres.data"
            spheres.write_data(data, spheres.start(disturbance), low=-side, high=side, types=1)
            ends.append(spheres.vectors(move(Path(folder), law), "x", "y", "z"))
    growth = np.abs(ends[1] - ends[0]).max() / spheres.DISTURBANCE
    bound = spheres.STEPS * spheres.TERMS * np.finfo(float).eps * spheres.SIDE * max(growth, 1.0)
    return {"ends": ends[0].tolist(), "bound": bound}


def probe(host):
    module, move = HOSTS[host]
    version = subprocess.check_output(["dpkg-query", "-W", "-f", "${Version}", host], text=True)
    found = {"version": version, "builds": Path(module.PRELOAD).exists(), "loads": False}
    with tempfile.TemporaryDirectory() as folder:
        found["loads"] = module.run('print "read"\n', folder, check=False).returncode == 0
    if found["loads"]:
        found["decks"] = decks(host, module)
        found["packing"] = {ranks: packing(host, module, ranks) for ranks in (1, 2)}
        found["motion"] = {law: motion(move, law) for law in LAWS}
    return found


if __name__ == "__main__":
    json.dump({host: probe(host) for host in HOSTS}, sys.stdout)
