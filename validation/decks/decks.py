# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks that others wrote, where Debian's packages have them: tutorials of LIGGGHTS, granular examples of LAMMPS."""

import re
from dataclasses import dataclass
from functools import cached_property
from math import prod
from pathlib import Path

FOLDERS = {
    "liggghts": Path("/usr/share/doc/liggghts/examples/LIGGGHTS/Tutorials_public"),  # package liggghts-doc
    "lammps": Path("/usr/share/lammps/examples"),  # package lammps-examples
}
# what makes a file "in.*" a deck that is looked at
PAIR_STYLES = {"liggghts": r"^pair_style\s", "lammps": r"^pair_style\s.*\bgran"}
# Of the run of a deck that would take long, the part of every stage that is run. It ends between two insertions, so
# that the rounding of counts of steps at another step adds none.
PARTS = {
    "chute_wear/in.chute_wear": 0.245,
    "cohesion/in.cohesion": 0.5,
    "cohesion/in.noCohesion": 0.5,
    "contactModels/in.newModels": 0.4,
    "conveyor/in.conveyor": 0.48,
    "heatTransfer_1/in.heatGran": 0.5,
    "heatTransfer_2/in.heatGran": 0.5,
    "hydrogel_multicontact/in.hydrogel_default": 0.3,
    "hysteresis/in.noHysteresis": 0.5,
    "insert_stream/in.insert_stream": 0.45,
    "insert_stream/in.insert_stream_reset_timestep": 0.45,
    "meshGran/in.meshGran": 0.98,
    "mesh_tet/in.mesh_tet": 0.3,
    "movingMeshGran/in.movingMeshGran": 0.3,
    "sph_1/in.sph_1": 0.001,
    "sph_2/in.sph_2": 0.001,
    "granregion/in.granregion.funnel": 0.1,
    "granregion/in.granregion.mixer": 0.1,
    "multi/in.granular": 0.1,
    "pour/in.pour": 0.5,
}


@dataclass(frozen=True)
class Deck:
    host: str
    path: Path

    @property
    def name(self):
        return str(self.path.relative_to(FOLDERS[self.host]))

    @cached_property
    def commands(self):
        """One in a string, with single blanks and without comments; files that it includes are in their places."""
        return commands_of(self.path)

    @property
    def granular(self):
        return any(re.match(r"pair_style .*\bgran", line) for line in self.commands)

    @property
    def ranks(self):
        """As many as its command "processors" asks for."""
        numbers = [word for line in self.commands if line.startswith("processors ") for word in line.split()[1:4]]
        return prod(int(word) for word in numbers if word != "*")

    def before(self):
        """The deck in the same folder that writes the restart file that this one reads; None if it reads none."""
        read = self._files("read_restart")
        others = (Deck(self.host, path) for path in sorted(self.path.parent.glob("in.*")) if path != self.path)
        return next((deck for deck in others if read & deck._files("write_restart")), None) if read else None

    def _files(self, command):
        return {line.split()[1] for line in self.commands if line.startswith(f"{command} ")}


def commands_of(path):
    text = re.sub(r"&[ \t]*\n", " ", path.read_text(errors="replace"))
    lines = [" ".join(line.split("#")[0].split()) for line in text.splitlines()]
    found = []
    for line in filter(None, lines):
        included = re.match(r"include (\S+)$", line)
        found += commands_of(path.parent / included.group(1)) if included else [line]
    return found


def all_decks(host):
    paths = [path for path in sorted(FOLDERS[host].rglob("in.*")) if path.is_file()]
    pattern = re.compile(PAIR_STYLES[host], re.MULTILINE)
    return [Deck(host, path) for path in paths if pattern.search(path.read_text(errors="replace"))]
