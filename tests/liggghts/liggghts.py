# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the real LIGGGHTS, stock or with the plugin, and reads back what it wrote."""

import os
import subprocess
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("CFPM_BUILD", ROOT / "build"))
STOCK = "liggghts"
LAUNCHER = str(BUILD / "bin" / "liggghts-cfpm")
PRELOAD = str(BUILD / "lib" / "cfpm_liggghts_preload.so")
ENVIRONMENT = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_pml": "ob1",  # no search for networks: most of the start-up time
    "OMPI_MCA_btl": "self,vader",
    "OMP_NUM_THREADS": "1",
}


def environment(cwd, np=1):
    """Of a host that runs in the folder cwd."""
    # a single rank needs no daemon; without one all of them share a job number, so each gets its own session folder
    alone = {
        "OMPI_MCA_ess_singleton_isolated": "1",
        "OMPI_MCA_orte_tmpdir_base": str(Path(cwd).resolve()),
        "OMPI_MCA_btl": "self",
    }
    return {**ENVIRONMENT, **(alone if np == 1 else {})}


def run(deck, cwd, np=1, program=LAUNCHER, options=(), check=True, stdin=False, env=None, timeout=600):
    """Runs a deck (its text, or a Path) in the folder cwd and returns the finished process.

    options: further host options, for example ("-var", "nt", "6").
    stdin: feed the deck through standard input instead of -in.
    check: fail if the host reports an error; with False the caller looks at returncode and stdout.
    timeout: in seconds, for a test; None for work that a user waits for.
    """
    cwd = Path(cwd)
    if not isinstance(deck, Path):
        (cwd / "in.deck").write_text(deck)
        deck = cwd / "in.deck"
    command = ["mpirun", "-np", str(np), program] if np > 1 else [program]
    command += [] if stdin else ["-in", str(deck)]
    command += [str(o) for o in options]
    process = subprocess.run(
        command,
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


def read_dump(path):
    """Snapshots of a "dump custom" text file: a list of (timestep, {column: array sorted by id})."""
    snapshots = []
    lines = iter(Path(path).read_text().splitlines())
    for line in lines:
        if line != "ITEM: TIMESTEP":
            continue
        step = int(next(lines))
        assert next(lines) == "ITEM: NUMBER OF ATOMS"
        count = int(next(lines))
        header = next(lines)
        while not header.startswith("ITEM: ATOMS"):
            header = next(lines)
        names = header.split()[2:]
        table = np.array([next(lines).split() for _ in range(count)], dtype=float)
        order = np.argsort(table[:, names.index("id")])
        snapshots.append((step, {name: table[order, k] for k, name in enumerate(names)}))
    return snapshots


def vectors(columns, *names):
    """Columns of a snapshot side by side: vectors(s, "x", "y", "z") has shape (particles, 3)."""
    return np.column_stack([columns[name] for name in names])
