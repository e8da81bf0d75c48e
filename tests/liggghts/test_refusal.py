# SPDX-License-Identifier: GPL-2.0-or-later
"""A host for which the plugin was not built is refused with a message, before it can do harm.

The other hosts are copies of the installed library with a few bytes changed.
"""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from liggghts import LAUNCHER, PRELOAD, STOCK, run

REFUSED = "the cfpm plugin cannot be loaded"
MOVE_TO_EDI = b"\xbf"  # x86-64: the first argument of operator new

CREATE = "_ZN9LAMMPS_NS6LAMMPS6createEv"
CREATE_WALL = "_ZN9LAMMPS_NS6Modify11fix_creatorINS_11FixWallGranEEEPNS_3FixEPNS_6LAMMPSEiPPc"
SIZE_OF_ATOM = 0x5C8  # class Atom as Debian builds it; tests/liggghts/abi_check.cpp compares it with the headers


def output(*command):
    return subprocess.check_output(command, text=True)


def host_library():
    return Path(re.search(r"libliggghts\.so\.3 => (\S+)", output("ldd", shutil.which(STOCK))).group(1))


def place_in_file(symbol):
    """Where in the library's file the code of a function begins."""
    table = output("nm", "-D", "--defined-only", str(host_library()))
    address = int(re.search(rf"^(\w+) \w {symbol}$", table, re.MULTILINE).group(1), 16)
    for line in output("readelf", "-lW", str(host_library())).splitlines():
        if line.split()[:1] == ["LOAD"]:
            offset, virtual, _, size = (int(number, 16) for number in line.split()[1:5])
            if virtual <= address < virtual + size:
                return address - virtual + offset
    raise ValueError(f"{symbol} lies in no segment")


def enlarge(code, symbol, size):
    """A host with a larger class: it allocates 64 bytes more, and still runs. size: None for the first allocated."""
    at = code.index(MOVE_TO_EDI + (size.to_bytes(4, "little") if size else b""), place_in_file(symbol)) + 1
    assert at < place_in_file(symbol) + 0x280
    code[at : at + 4] = (int.from_bytes(code[at : at + 4], "little") + 64).to_bytes(4, "little")


def other_version(code):
    ours = b"LIGGGHTS-PUBLIC 3.8.0"
    assert ours in code
    code[:] = code.replace(ours, b"LIGGGHTS-PUBLIC 3.7.0")


CHANGES = {
    "version": (other_version, r"built for LIGGGHTS-PUBLIC 3\.8\.0.*this host is .*3\.7\.0"),
    "atom": (lambda code: enlarge(code, CREATE, SIZE_OF_ATOM), f"class sizes differ in {CREATE}:"),
    "wall": (lambda code: enlarge(code, CREATE_WALL, None), f"class sizes differ in {CREATE_WALL}:"),
    "none": (lambda code: None, None),
}


@pytest.mark.parametrize("change", CHANGES)
def test_other_host(tmp_path, change):
    alter, reason = CHANGES[change]
    code = bytearray(host_library().read_bytes())
    alter(code)
    (tmp_path / host_library().name).write_bytes(code)
    path = {"LD_LIBRARY_PATH": str(tmp_path)}
    deck = 'print "the deck was read"\n'

    # the copy itself runs
    assert "the deck was read" in run(deck, tmp_path, program=STOCK, env=path).stdout

    process = run(deck, tmp_path, program=LAUNCHER, env=path, check=False)
    if reason:
        assert process.returncode != 0 and "the deck was read" not in process.stdout
        assert re.search(f"ERROR: {REFUSED}: .*{reason}", process.stdout), process.stdout
    else:
        assert process.returncode == 0 and "the deck was read" in process.stdout, process.stdout


def test_plugin_file_missing(tmp_path):
    alone = shutil.copy(PRELOAD, tmp_path)
    process = run('print "the deck was read"\n', tmp_path, program=STOCK, env={"LD_PRELOAD": alone}, check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    assert f"ERROR: cfpm loader: cannot load the plugin: {tmp_path}/cfpm_liggghts.so" in process.stdout
