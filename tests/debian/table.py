# SPDX-License-Identifier: GPL-2.0-or-later
"""Joins what probe.py and the test suite said on several Debians in a table, each compared with the first of them.

usage: table.py SUITE=FOLDER ...   where FOLDER has probe.json and, if the suite ran, test.log
"""

import json
import re
import sys
from pathlib import Path

import numpy as np

COLUMNS = (
    "Debian",
    "host",
    "version",
    "builds",
    "loads",
    "runs of decks",
    "packing, 1 rank",
    "2 ranks",
    "50 spheres: difference / bound",
    "suite passed",
)


def passed(log):
    """How many tests passed, "n of m", and the tests that failed, of ctest's output."""
    if not log.exists():
        return "not run"
    text = log.read_text(errors="replace")
    summary = re.search(r"(\d+) tests? failed out of (\d+)", text)
    if not summary:
        return "did not end"
    failed, total = (int(number) for number in summary.groups())
    names = re.findall(r"^\s+\d+ - (\S+) \(", text.split("The following tests FAILED:")[-1], re.MULTILINE)
    return f"{total - failed} of {total}" + (f", not {', '.join(names)}" if failed else "")


def compared(found, first, ranks):
    """Whether the last line of the packing is the first Debian's, and how far off otherwise."""
    if "packing" not in found:
        return "-"
    line, expected = found["packing"][ranks], first["packing"][ranks]
    if line == expected:
        return "same last line"
    numbers, wanted = (np.array(text.split(), dtype=float) for text in (line, expected))
    off = np.abs(numbers - wanted) / np.maximum(np.abs(wanted), 1e-300)
    return f"off by {off.max():.1e}"


def ran(found):
    """How many runs of decks ended well, and which did not."""
    ends = found.get("decks", [])
    wrong = [name for name, well in ends if not well]
    return f"{len(ends) - len(wrong)} of {len(ends)}" + (f", not {', '.join(wrong)}" if wrong else "")


def moved(found, first):
    """The largest difference of the ends of the 50 spheres over its bound, for each law."""
    if "motion" not in found:
        return "-"
    words = []
    for law, motion in found["motion"].items():
        difference = np.abs(np.subtract(motion["ends"], first["motion"][law]["ends"])).max()
        verdict = "" if difference <= motion["bound"] else " FAIL"
        words.append(f"{law} {difference:.1e} / {motion['bound']:.1e}{verdict}")
    return ", ".join(words)


def main(arguments):
    folders = dict(argument.split("=", 1) for argument in arguments)
    found = {suite: json.loads((Path(folder) / "probe.json").read_text()) for suite, folder in folders.items()}
    first = next(iter(found.values()))
    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + len(COLUMNS) * "---|")
    for suite, hosts in found.items():
        suite_passed = passed(Path(folders[suite]) / "test.log")
        for host, of_host in hosts.items():
            cells = [suite, host, of_host["version"], *("yes" if of_host[key] else "NO" for key in ("builds", "loads"))]
            cells += [ran(of_host), *(compared(of_host, first[host], ranks) for ranks in ("1", "2"))]
            cells += [moved(of_host, first[host]), suite_passed]
            print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
