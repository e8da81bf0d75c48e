# SPDX-License-Identifier: GPL-2.0-or-later
"""The codes that are compared, and how each continues a bed: so many steps of it, on one core."""

import json
import re
import resource
import shutil
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path[:0] = map(str, (HERE.parent, HERE.parents[1], HERE.parent / "bench"))
import timing  # noqa: E402
from harness.output import loops  # noqa: E402
from harness.programs import call  # noqa: E402
from rows import REST, Row  # noqa: E402
from state import State  # noqa: E402

SINKING = 500  # steps in which a bed that rested at one nt gets the overlaps that belong to another
LAST_LINE = re.compile(r"Step +KinEng +\S*touches *\n +\d+ +(\S+) +(\S+)")


class Host(NamedTuple):
    """LIGGGHTS or LAMMPS, alone or with the plugin."""

    row: Row
    program: timing.Program
    missing = False

    def run(self, bed, steps):
        """The State after that many steps, at another nt than the bed rested at after further ones."""
        before = 0 if self.row.nt == REST else SINKING
        text = self.program.run(self.row, bed, 1, warm=before, steps=steps)
        energy, touches = map(float, LAST_LINE.search(text).groups())
        spheres = loops(text)[-1].particles
        return State(spheres, touches, energy / spheres)


class Yade:
    script = HERE / "yade_bed.py"

    @property
    def missing(self):
        return shutil.which("yade") is None

    def run(self, bed, steps):
        """The State after that many steps."""
        words = bed.folder / "bed.data", bed.nx, bed.ny, REST, steps
        text = call("yade", "-n", "-x", "-j1", self.script, *words, cwd=bed.folder)
        return State(**json.loads(next(line for line in text.splitlines() if line.startswith("{"))))


class Name(NamedTuple):
    program: str
    style: str
    nt: int = REST

    def __str__(self):
        return f"{self.program} {self.style}" + (f", nt = {self.nt}" if self.nt != REST else "")


def host(name, model, predict=None, nt=REST):
    """Stock without predict."""
    return Host(Row(name, model, predict or "verlet", nt), timing.pair(name, None, None)[predict is not None])


BASE = Name("LIGGGHTS", "gran hooke/stiffness")  # what all are compared with
CODES = {
    BASE: host("liggghts", "hooke/stiffness"),
    Name("LAMMPS", "gran/hooke/history"): host("lammps", "hooke"),
    Name("LAMMPS", "granular hooke"): host("lammps", "granular/hooke"),
    Name("YADE", "ViscElPhys"): Yade(),
    **{
        Name(program, predict, nt): host(name, model, predict, nt)
        for program, name, model in (
            ("LIGGGHTS + cfpm", "liggghts", "hooke/stiffness"), ("LAMMPS + cfpm", "lammps", "hooke")
        )
        for predict, nt in (("verlet", REST), ("impulse", REST), ("impulse", 2), ("impulse", 1))
    },
}


def user_seconds(code, bed, steps):
    """User time of a whole run, from start to end of its process, and the State that it leaves."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    state = code.run(bed, steps)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, state
