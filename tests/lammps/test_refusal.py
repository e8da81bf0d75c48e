# SPDX-License-Identifier: GPL-2.0-or-later
"""A host for which the plugin was not built is refused with a message, before it can do harm."""

import re
from datetime import datetime

import pytest
from harness.lammps import LAUNCHER, STOCK
from harness.changed_host import check_refusal, library_of, output, place_in_file

LIBRARY = library_of(STOCK, "liblammps.so.0")


HOST = re.search(r"Simulator - (\d+ \w+ \d+)", output(STOCK, "-h"))[1]  # the date of its version
OTHER = re.sub(r"^\d+", lambda day: str(int(day[0]) - 1), HOST)


def number(date):
    return datetime.strptime(date, "%d %b %Y").strftime("%Y%m%d")


def other_version(code):
    """The number of the version is read off its date, where the host starts. Its beginning is also in the code."""
    for date, other in ((HOST, OTHER), (HOST[:8], OTHER[:8])):
        code[:] = code.replace(date.encode(), other.encode())


def other_integers(code):
    """The first answer of that function, the size of a bigint, is set to 4."""
    move_8_to_ebp = b"\xbd\x08\0\0\0"
    start = place_in_file(LIBRARY, "lammps_extract_setting")
    at = code.index(move_8_to_ebp, start)
    assert at < start + 0x10
    code[at + 1] = 4


CHANGES = {
    "version": (other_version, rf"built for LAMMPS {number(HOST)}, this host is {number(OTHER)} \({OTHER}\)"),
    "integers": (other_integers, "built for a bigint of 8 bytes, of this host it has 4"),
    "none": (lambda code: None, None),
}


@pytest.mark.parametrize("change", CHANGES)
def test_other_host(tmp_path, change):
    check_refusal(tmp_path, STOCK, LAUNCHER, LIBRARY, *CHANGES[change])
