# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs exhibits one after the other and joins what they found to one page, report.md.

Sections of exhibits that are not run again stay on the page as they are.
"""

import argparse
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
# in the order of the page
EXHIBITS = [
    *("table2", "table3", "figure4-5", "collisions", "oblique", "benchmarks", "statics", "sizes", "agitated"),
    *("packing", "readings", "discharge", "scaling", "speedup", "beyond", "softened", "decks", "peers", "advise"),
]
INTERRUPTED = 130


def summary(sections):
    """How many verdicts of each exhibit hold; the sections tell why."""
    rows = ["| exhibit | verdicts that hold |", "|---|---|"]
    for text in sections:
        title = text.splitlines()[0].removeprefix("## ")
        held, failed = text.count("**PASS:**"), text.count("**FAIL:**")
        rows.append(f"| {title} | {held} of {held + failed} |")
    return "\n".join(rows) + "\n"


def write_page(out):
    sections = [(out / name / "section.md").read_text() for name in EXHIBITS if (out / name / "section.md").exists()]
    intro = (
        "# Validation\n\nWhat the paper (C. Tokoro, K. Okaya, J. Sadaki, KONA 23, 2005) prints, what follows from its "
        "equations, and what is measured here. Every number comes from `./cfpm validate`.\n"
    )
    (out / "report.md").write_text("\n".join([intro, summary(sections), *sections]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for report.md and a folder per exhibit")
    parser.add_argument("exhibit", nargs="?", choices=EXHIBITS, help="one exhibit; all without it")
    arguments, options = parser.parse_known_args()
    if not arguments.exhibit and [o for o in options if o != "--quick"]:
        parser.error(f"{options[0]}: options other than --quick belong to one exhibit")

    names = [arguments.exhibit] if arguments.exhibit else EXHIBITS
    failed = []
    for k, name in enumerate(names, 1):
        print(f"validate: {name} ({k} of {len(names)})", flush=True)
        start = time.monotonic()
        script = [sys.executable, str(HERE / name / "validate.py"), "--out", str(arguments.out / name)]
        try:
            code = subprocess.run([*script, *options], check=False).returncode
        except KeyboardInterrupt:
            code = INTERRUPTED
        if code == INTERRUPTED:
            return INTERRUPTED
        if code != 0:
            failed.append(name)
        print(f"validate: {name} took {time.monotonic() - start:.0f} s\n", flush=True)
        write_page(arguments.out)
    print(f"page: {arguments.out}/report.md")
    if failed:
        print(f"validate: FAILED: {', '.join(failed)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
