# SPDX-License-Identifier: GPL-2.0-or-later
"""The core tests notice every mutation of core.py: run_core.py PROGRAM, the tests built from the copy of mutate.py.

All of them pass while no mutation is on. With each one on, the test that its row names fails.
"""

import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

from core import CORE


def run(program, mutation="", tests="*"):
    environment = {**os.environ, "CFPM_MUTATION": mutation}
    command = (program, f"--gtest_filter={tests}", "--gtest_brief=1")
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=100)
    except subprocess.TimeoutExpired:
        return -1, [], "timed out"
    failed = re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)(?:, where .*)? \(\d+ ms\)$", done.stdout, re.MULTILINE)
    return done.returncode, failed, done.stdout + done.stderr


def main(program, everything):
    status, _, output = run(program)
    if status != 0:
        sys.exit(f"without a mutation:\n{output}")

    def attempt(row):
        return run(program, row.name, "*" if everything else row.noticed_by)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        outcomes = list(pool.map(attempt, CORE))
    survived = 0
    width = max(len(row.name) for row in CORE)
    for row, (status, failed, output) in zip(CORE, outcomes):
        noticed = status == 1 and failed
        survived += not noticed
        what = ", ".join(failed) if noticed else f"NOT NOTICED by {row.noticed_by} (exit {status}) {output[-300:]}"
        print(f"{row.name:{width}}  {what}")
    print(f"{len(CORE) - survived} of {len(CORE)} mutations noticed")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--all" in sys.argv[2:]))  # --all: which of all the tests notice
