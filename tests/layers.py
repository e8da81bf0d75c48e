# SPDX-License-Identifier: GPL-2.0-or-later
"""Fails where a source includes what it must not know: see ARCHITECTURE.md."""

import re
import sys
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[1] / "src"
CORE = ("numbers", "law", "motion", "predict", "contact", "method", "step", "deck")  # each knows those before it
HOSTS = ("liggghts", "lammps", "loader")


def may_include(source, included):
    """Both as folders below src; of included "" if it stands beside the source or is a header of the host."""
    if included[:1] != ("core",):
        return included[:1] not in [(host,) for host in HOSTS]
    if source[0] != "core":
        return True
    return CORE.index(included[1]) <= CORE.index(source[1])


wrong = [
    f"{path.relative_to(SOURCES.parent)} includes {name}"
    for path in sorted(SOURCES.rglob("*.[hc]*"))
    for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.MULTILINE)
    if ".." in name or not may_include(path.relative_to(SOURCES).parts, Path(name).parts)
]
if wrong:
    sys.exit("\n".join(wrong))
