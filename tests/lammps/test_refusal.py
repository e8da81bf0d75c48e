# SPDX-License-Identifier: GPL-2.0-or-later
"""A host for which the plugin was not built is refused with a message, before it can do harm."""

import pytest
from lammps import LAUNCHER, STOCK  # which makes the next one found
from changed_host import check_refusal, library_of, place_in_file

LIBRARY = library_of(STOCK, "liblammps.so.0")


def other_version(code):
    """The number of the version is read off this date, where the host starts. Its beginning is also in the code."""
    assert b"29 Sep 2021" in code
    code[:] = code.replace(b"29 Sep 2", b"28 Sep 2")


def other_integers(code):
    """The first answer of that function, the size of a bigint, is set to 4."""
    move_8_to_ebp = b"\xbd\x08\0\0\0"
    start = place_in_file(LIBRARY, "lammps_extract_setting")
    at = code.index(move_8_to_ebp, start)
    assert at < start + 0x10
    code[at + 1] = 4


CHANGES = {
    "version": (other_version, r"built for LAMMPS 20210929, this host is 20210928 \(28 Sep 2021\)"),
    "integers": (other_integers, "built for a bigint of 8 bytes, of this host it has 4"),
    "none": (lambda code: None, None),
}


@pytest.mark.parametrize("change", CHANGES)
def test_other_host(tmp_path, change):
    check_refusal(tmp_path, STOCK, LAUNCHER, LIBRARY, *CHANGES[change])
