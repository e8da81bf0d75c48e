# SPDX-License-Identifier: GPL-2.0-or-later
"""A host for which the plugin was not built is refused with a message, before it can do harm."""

import shutil

import pytest
from harness.changed_host import DECK, check_refusal, code_length, library_of, place_in_file
from harness.liggghts import LAUNCHER, PRELOAD, STOCK, run

LIBRARY = library_of(STOCK, "libliggghts.so.3")
MOVE_TO_EDI = b"\xbf"  # x86-64: the first argument of operator new

CREATE = "_ZN9LAMMPS_NS6LAMMPS6createEv"
CREATE_WALL = "_ZN9LAMMPS_NS6Modify11fix_creatorINS_11FixWallGranEEEPNS_3FixEPNS_6LAMMPSEiPPc"
SIZE_OF_ATOM = 0x5C8  # class Atom as Debian builds it; tests/liggghts/abi_check.cpp compares it with the headers


def enlarge(code, symbol, size):
    """A host with a larger class: it allocates 64 bytes more, and still runs. size: None for the first allocated."""
    begin = place_in_file(LIBRARY, symbol)
    load = MOVE_TO_EDI + (size.to_bytes(4, "little") if size else b"")
    at = code.index(load, begin, begin + code_length(LIBRARY, symbol)) + 1
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
    check_refusal(tmp_path, STOCK, LAUNCHER, LIBRARY, *CHANGES[change])


def test_plugin_file_missing(tmp_path):
    alone = shutil.copy(PRELOAD, tmp_path)
    process = run(DECK, tmp_path, program=STOCK, env={"LD_PRELOAD": alone}, check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    assert f"ERROR: cfpm loader: cannot load the plugin: {tmp_path}/cfpm_liggghts.so" in process.stdout
