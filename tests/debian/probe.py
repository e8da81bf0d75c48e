# SPDX-License-Identifier: GPL-2.0-or-later
"""What the plugins do on this Debian, as JSON on standard output: run after ./cfpm build, compared by table.py.

For each host its version, whether the plugin loads, which decks of inputs/ end without an error, the last line of the
packing in serial and on 2 ranks, and where the 50 spheres of harness/fifty_spheres.py end, with the bound within which
rounding may move them.
"""

import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness import HOSTS, fifty_spheres  # noqa: E402
from harness.decks import MESH, deck, options  # noqa: E402
from harness.programs import version_of  # noqa: E402

LAWS = ("linear", "hertz", "impulse")
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


def packing(host, ranks):
    with tempfile.TemporaryDirectory() as folder:
        return last_line(HOSTS[host].run(deck(host, "packing"), folder, np=ranks).stdout)


def decks(host):
    """How each run of a deck that the host has ended: the name of the deck and whether it was without an error."""
    ends = []
    with tempfile.TemporaryDirectory() as folder:
        for name, variables in DECKS:
            if not deck(host, name).exists():
                continue
            process = HOSTS[host].run(deck(host, name), folder, options=options(variables), check=False)
            ends.append((name, process.returncode == 0 and "ERROR" not in process.stdout))
    return ends


def motion(host, law):
    """Where the spheres are at the end, and the bound of a difference by rounding alone."""
    ends = []
    for disturbance in (0.0, fifty_spheres.DISTURBANCE):
        with tempfile.TemporaryDirectory() as folder:
            ends.append(fifty_spheres.end(host, Path(folder), law, disturbance))
    return {"ends": ends[0].tolist(), "bound": fifty_spheres.bound(*ends)}


def probe(host):
    found = {"version": version_of(host), "builds": Path(HOSTS[host].PRELOAD).exists(), "loads": False}
    with tempfile.TemporaryDirectory() as folder:
        found["loads"] = HOSTS[host].run('print "read"\n', folder, check=False).returncode == 0
    if found["loads"]:
        found["decks"] = decks(host)
        found["packing"] = {ranks: packing(host, ranks) for ranks in (1, 2)}
        found["motion"] = {law: motion(host, law) for law in LAWS}
    return found


if __name__ == "__main__":
    json.dump({host: probe(host) for host in HOSTS}, sys.stdout)
