# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of decks that others wrote, kept so that none is repeated: what the host said and the figures of its dump."""

import hashlib
import json
import os
import re
import shutil
import signal
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import NamedTuple

import figures
from decks import Deck
from rewriting import DUMP, Rewriting, has_seed

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness import HOSTS, host  # noqa: E402

# of the starts of a deck beside its own: primes, as LIGGGHTS wants them
SEEDS = (49979687, 67867967, 86028121, 104395301, 122949823, 141650939, 160481183, 179424673)
STEPS = (1.0, 0.99, 1.01, 0.98, 1.02, 0.97)  # of the starts of a deck without a seed, over its own step
STARTS = min(len(SEEDS), len(STEPS))  # at most; no deck has three of the seeds
NT = re.compile(r"nt = tc/dt = (\S+)")
ERROR = re.compile(r"^ERROR(?: on proc \d+)?: (.*?)(?: \(\S+:\d+\))?$", re.MULTILINE)
WARNING = re.compile(r"^WARNING: (.*?)(?: \(\S+:\d+\))?$", re.MULTILINE)
NOTHING = "finds nothing to predict"


class Mode(NamedTuple):
    ratio: float  # of the step to the deck's own
    options: tuple  # of the host; without any it is the stock program
    dashpot: bool = True  # as the deck has it; False: none in friction, with which stock and the plugin have one law


STOCK = Mode(1.0, ())
AUTO = Mode(1.0, ("-suffix", "cfpm"))
IMPULSE3 = Mode(3.0, ("-predict", "impulse", "-suffix", "cfpm"))
STOCK3 = Mode(3.0, ())
STOCK_OFF = STOCK._replace(dashpot=False)
IMPULSE3_OFF = IMPULSE3._replace(dashpot=False)


@dataclass(frozen=True)
class Run:
    deck: Deck
    mode: Mode
    part: float  # of the length of the deck's run
    start: int = 0  # which of the seeds

    def texts(self):
        """Of the deck and of the one whose restart file it reads, in the order of their runs."""
        seed, step = self._beginning()
        decks = [deck for deck in (self.deck.before(), self.deck) if deck]
        return [Rewriting(deck, step * self.mode.ratio, self.part, seed, self.mode.dashpot).text() for deck in decks]

    def _beginning(self):
        """Seed (None: the deck's own) and step over that of the mode."""
        if not has_seed(self.deck):
            return None, STEPS[self.start]
        words = set(" ".join(self.deck.commands).split())
        return [None, *(seed for seed in SEEDS if str(seed) not in words)][self.start], 1.0

    def name(self):
        """With a hash of all that decides the outcome."""
        plugin = HOSTS[self.deck.host].PLUGIN.read_bytes() if self.mode.options else b""
        evaluation = Path(figures.__file__).read_bytes()
        digests = [hashlib.sha256(content).hexdigest() for content in (plugin, evaluation)]
        identity = [self.deck.name, self.texts(), self.mode.options, digests]
        return f"deck-{hashlib.sha256(json.dumps(identity).encode()).hexdigest()[:16]}.json"


@dataclass(frozen=True)
class Outcome:
    error: str  # with which the host stopped; empty if it did not
    nothing: bool  # there was nothing to predict, as the log says
    warnings: list  # of the plugin
    nt: float  # the smallest of pairs that the log tells of; None without one
    seconds: float
    dump: str  # its hash; empty if there is none
    figures: dict  # {name: [value, change of it in one step]}


def execute(runs, folder, progress):
    """{run: outcome}; as many runs at a time as cores, those that are in the folder not again."""
    folder.mkdir(parents=True, exist_ok=True)
    pool = ThreadPoolExecutor(len(os.sched_getaffinity(0)))
    try:
        found = {}
        for run, outcome in zip(runs, pool.map(lambda run: kept(run, folder), runs)):
            found[run] = outcome
            progress(len(found), len(runs))
        return found
    except KeyboardInterrupt:
        pool.shutdown(cancel_futures=True)
        print("\ninterrupted; the same command goes on from here", flush=True)
        sys.exit(130)


def kept(run, folder):
    file = folder / run.name()
    if not file.exists():
        outcome = execute_one(run, folder)
        if outcome is None:
            return None
        unfinished = file.with_suffix(".unfinished")
        unfinished.write_text(json.dumps(asdict(outcome)))
        unfinished.rename(file)
    return Outcome(**json.loads(file.read_text()))


def execute_one(run, folder):
    """None if it was interrupted."""
    with tempfile.TemporaryDirectory(dir=folder) as work:
        work = Path(work) / "deck"
        shutil.copytree(run.deck.path.parent, work)
        (work / "post" / "restart").mkdir(parents=True, exist_ok=True)  # where the tutorials write
        programs = HOSTS[run.deck.host]
        begin = time.monotonic()
        for text in run.texts():
            (work / DUMP).unlink(missing_ok=True)
            process = host.run(
                programs.LAUNCHER if run.mode.options else programs.STOCK,
                text,
                work,
                np=run.deck.ranks,
                options=("-log", "none", *run.mode.options),
                check=False,
                timeout=None,
            )
            if process.returncode:
                break
        if process.returncode == -signal.SIGINT:
            return None
        said = process.stdout
        error = ""
        if process.returncode:
            found = ERROR.search(said)
            error = found.group(1) if found else f"the host ended with {process.returncode} and without a word"
        dump = work / DUMP
        good = not error and dump.exists()
        return Outcome(
            error=error,
            nothing=NOTHING in said,
            warnings=[warning for warning in WARNING.findall(said) if "cfpm" in warning],
            nt=min(map(float, NT.findall(said)), default=None),
            seconds=time.monotonic() - begin,
            dump=hashlib.sha256(dump.read_bytes()).hexdigest() if good else "",
            figures=figures.read(dump, run.deck.granular) if good else {},
        )
