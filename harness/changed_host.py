# SPDX-License-Identifier: GPL-2.0-or-later
"""Copies of an installed host's library with a few bytes changed: hosts for which the plugin was not built."""

import re
import shutil
import subprocess
from pathlib import Path

from harness.liggghts import run

DECK = 'print "the deck was read"\n'
REFUSED = "the cfpm plugin cannot be loaded"


def output(*command):
    return subprocess.check_output(command, text=True)


def library_of(program, name):
    return Path(re.search(rf"{re.escape(name)} => (\S+)", output("ldd", shutil.which(program))).group(1))


def code_length(library, symbol):
    """Bytes of a function."""
    table = output("nm", "-D", "--defined-only", "--print-size", str(library))
    return int(re.search(rf"^\w+ (\w+) \w {symbol}(@\S*)?$", table, re.MULTILINE).group(1), 16)


def place_in_file(library, symbol):
    """Where in the library's file the code of a function begins."""
    table = output("nm", "-D", "--defined-only", str(library))
    address = int(re.search(rf"^(\w+) \w {symbol}(@\S*)?$", table, re.MULTILINE).group(1), 16)
    for line in output("readelf", "-lW", str(library)).splitlines():
        if line.split()[:1] == ["LOAD"]:
            offset, virtual, _, size = (int(number, 16) for number in line.split()[1:5])
            if virtual <= address < virtual + size:
                return address - virtual + offset
    raise ValueError(f"{symbol} lies in no segment")


def check_refusal(folder, stock, launcher, library, alter, reason):
    """alter(code) changes the copy; reason: a pattern of what the plugin says of it, None if it takes this host."""
    code = bytearray(library.read_bytes())
    alter(code)
    (folder / library.name).write_bytes(code)
    path = {"LD_LIBRARY_PATH": str(folder)}

    # the copy itself runs
    assert "the deck was read" in run(DECK, folder, program=stock, env=path).stdout

    process = run(DECK, folder, program=launcher, env=path, check=False)
    if reason:
        assert process.returncode != 0 and "the deck was read" not in process.stdout
        assert re.search(f"ERROR: {REFUSED}: .*{reason}", process.stdout), process.stdout
    else:
        assert process.returncode == 0 and "the deck was read" in process.stdout, process.stdout
