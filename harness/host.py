# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a host program, whichever it is: launcher, ranks, arguments, environment, time limit."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ.get("CFPM_BUILD", ROOT / "build"))

ENVIRONMENT = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_pml": "ob1",  # no search for networks: most of the start-up time
    "OMPI_MCA_btl": "self,vader",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",  # no grace period for the other ranks after an error of one
    "OMP_NUM_THREADS": "1",
}


def environment(cwd, np=1):
    """Of a host that runs on np ranks in the folder cwd."""
    # a rank that waits spins, or with this yields; on Linux it then loses a time slice for every message to whatever
    # else wants the core, so only ranks that lack cores of their own do
    yields = {"OMPI_MCA_mpi_yield_when_idle": str(int(np > len(os.sched_getaffinity(0))))}
    # a single rank needs no daemon; without one all of them share a job number, so each gets its own session folder
    alone = {
        "OMPI_MCA_ess_singleton_isolated": "1",
        "OMPI_MCA_orte_tmpdir_base": str(Path(cwd).resolve()),
        "OMPI_MCA_btl": "self",
    }
    return {**ENVIRONMENT, **(alone if np == 1 else yields)}


def command(program, np=1):
    """The words that start the program on np ranks, for options of the host to follow."""
    return ["mpirun", "-np", str(np), program] if np > 1 else [program]


def run(program, deck, cwd, np=1, options=(), check=True, stdin=False, env=None, timeout=600):
    """Runs a deck (its text, or a Path) in the folder cwd and returns the finished process.

    options: further host options, for example ("-var", "nt", "6").
    stdin: feed the deck through standard input instead of -in.
    check: fail if the host reports an error; with False the caller looks at returncode and stdout.
    env: environment variables beside ENVIRONMENT.
    timeout: in seconds, for a test; None for work that a user waits for.
    """
    cwd = Path(cwd)
    if not isinstance(deck, Path):
        (cwd / "in.deck").write_text(deck)
        deck = cwd / "in.deck"
    process = subprocess.run(
        [*command(program, np), *([] if stdin else ["-in", str(deck)]), *(str(o) for o in options)],
        cwd=cwd,
        env={**environment(cwd, np), **(env or {})},
        input=deck.read_text() if stdin else None,
        stdin=None if stdin else subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=timeout,
    )
    if check:
        assert process.returncode == 0 and "ERROR" not in process.stdout, process.stdout[-4000:]
    return process


def start(program, deck, cwd, np=1, options=()):
    """As run(), but returns at once, with the process; what it says goes to the file log in the folder cwd."""
    with open(Path(cwd) / "log", "w") as log:
        return subprocess.Popen(
            [*command(program, np), "-in", str(deck), *(str(o) for o in options)],
            cwd=cwd,
            env=environment(cwd, np),
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
