# SPDX-License-Identifier: GPL-2.0-or-later
"""Many runs of a deck on a real host, one on every core, kept so that none is repeated.

A finished run is a folder with run.json (what was run, what it cost, whether it blew up) and the files that the deck
wrote and the caller wants. The folder's name holds a hash of everything that decides the outcome: host, deck,
variables and, if the deck uses it, the plugin. So nothing out of date is ever found. A run that is under way has a
folder of another name, *.unfinished; it is started anew if it was interrupted.
"""

import contextlib
import fcntl
import hashlib
import json
import math
import os
import shutil
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from exhibit import progress

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from harness import HOSTS, host  # noqa: E402
from harness.decks import options  # noqa: E402
from harness.output import loops  # noqa: E402

# what a host or the plugin says when it stops for that: an outcome, not a failure
BLOWN_UP = ("Lost atoms", "Non-numeric", "of its radius in a step")


@dataclass(frozen=True)
class Run:
    host: str
    deck: Path
    variables: dict  # of the deck; style stock needs no plugin; a Path is a file that the deck reads
    cost: float = 1.0  # expected, in any unit: for the time left
    keep: tuple = ("*.csv",)  # which of the files that the deck writes; "log" is what the host said
    words: tuple = ()  # of the host's command line, with which a deck that has no style is predicted

    @property
    def predicted(self):
        return bool(self.words) or self.variables.get("style", "stock") != "stock"

    def identity(self):
        """All that decides the outcome, as it goes into run.json and the hash."""
        variables = {k: f"content {digest(v)}" if isinstance(v, Path) else v for k, v in self.variables.items()}
        return {
            "host": self.host,
            "deck": digest(self.deck),
            "variables": variables,
            "plugin": digest(HOSTS[self.host].PLUGIN) if self.predicted else None,
            "keep": self.keep,
            **({"words": self.words} if self.words else {}),
        }

    def name(self):
        text = json.dumps(self.identity(), sort_keys=True)
        return f"{self.deck.name.removeprefix('in.')}-{self.host}-{hashlib.sha256(text.encode()).hexdigest()[:16]}"

    def __str__(self):
        words = [*self.words, *(f"{k}={v}" for k, v in self.variables.items())]
        return f"{self.host} {self.deck.name} {' '.join(words)}"


@dataclass(frozen=True)
class Result:
    folder: Path  # with the files that were kept
    blown_up: bool  # the host lost particles or found that a coordinate is no number, and stopped
    cpu_seconds: float  # of the whole process
    steps: int  # of the longest time loop: a deck may fill or settle in others; None if blown up
    seconds: float  # of that loop, on the clock
    nanoseconds: float  # the same per particle and step; None if no particle is left
    user_seconds: float = math.nan  # of cpu_seconds without those in the kernel; not known of older runs


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def longest_loop(log):
    """Steps, seconds on the clock and nanoseconds per step and particle that is there at the end; None if none is."""
    loop = max(loops(log), key=lambda loop: loop.steps)
    return loop.steps, loop.seconds, loop.nanoseconds


def run(runs, folder, what, cores=os.cpu_count()):
    """The results of the runs, in their order; only those that are not in the folder yet are started."""
    folder = Path(folder).resolve()
    with claimed(folder):
        names = [run.name() for run in runs]
        missing = {name: run for name, run in zip(names, runs) if not (folder / name).exists()}
        kept = len(set(names)) - len(missing)
        if kept:
            print(f"{what}: {kept} finished before, {len(missing)} to run", flush=True)
        with resumable(what):
            execute(missing, folder, what, cores)
        return [read(folder / name) for name in names]


@contextlib.contextmanager
def resumable(what):
    """Ends the program when it is interrupted, with a word on how it goes on."""
    try:
        yield
    except KeyboardInterrupt:
        print(f"\n{what}: interrupted; the same command goes on from here", flush=True)
        sys.exit(130)


def read(folder):
    return Result(folder, **json.loads((folder / "run.json").read_text())["result"])


@contextlib.contextmanager
def claimed(folder):
    """One ensemble at a time in a folder: two would share the cores and overwrite each other's unfinished runs."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = open(folder / "lock", "w")
    except OSError as error:
        sys.exit(f"cannot write to the results folder {folder}: {error.strerror}")
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print(f"waiting for another ensemble that uses {folder} ...", flush=True)
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def execute(runs, folder, what, cores):
    """Runs {name: run}, as many at a time as cores."""
    waiting = list(runs.items())
    active = []  # of (name, process)
    begin, done, spent, total = time.monotonic(), 0, 0.0, sum(run.cost for run in runs.values())
    try:
        while waiting or active:
            while waiting and len(active) < cores:
                name, one = waiting.pop(0)
                active.append((name, start(one, folder / f"{name}.unfinished")))
            name, process, usage = first_to_end(active)
            active.remove((name, process))
            finish(runs[name], folder / name, process.returncode, usage)
            done, spent = done + 1, spent + runs[name].cost
            left = (time.monotonic() - begin) * (total / spent - 1)
            progress(done, len(runs), what, f", about {duration(left)} left" if done < len(runs) else "")
    finally:
        for _, process in active:
            process.kill()
            process.wait()


def together(runs, folder, what):
    """The results of runs that are timed against each other, in their order: one after the other, nothing beside them.

    They are kept when all of them have finished, so that what is compared met the same load of the machine.
    """
    folder = Path(folder).resolve()
    by_name = {run.name(): run for run in runs}
    if len(by_name) < len(runs):
        raise ValueError(f"{what}: the same run twice")
    group = folder / f"together-{hashlib.sha256(' '.join(by_name).encode()).hexdigest()[:16]}"
    with claimed(folder):
        if not group.exists():
            unfinished = group.with_name(f"{group.name}.unfinished")
            shutil.rmtree(unfinished, ignore_errors=True)
            unfinished.mkdir()
            with resumable(what):
                execute(by_name, unfinished, what, cores=1)
            unfinished.rename(group)
        return [read(group / name) for name in by_name]


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"


def alone(run, folder, ranks=1):
    """Runs it anew with nothing beside it, for a measurement: its log and what the host used, as wait4 tells it.

    No other ensemble may use the folder meanwhile. Nothing is kept.
    """
    folder = Path(folder).resolve()
    with claimed(folder):
        own = folder / f"{run.name()}.unfinished"
        process = start(run, own, ranks)
        try:
            _, _, usage = first_to_end([(run.name(), process)])
        except KeyboardInterrupt:
            process.terminate()
            process.wait()
            sys.exit(130)
        log = (own / "log").read_text(errors="replace")
        if process.returncode != 0:
            fail(run, own, process.returncode, log)
        shutil.rmtree(own)
        return log, usage


class Timing(NamedTuple):
    cpu_seconds: float  # of the whole process
    log: str


def in_turn(runs, folder, turns, what):
    """{key: Timing of each turn}. runs: {key: run}; each runs alone, and all of them before any does again."""
    found = {key: [] for key in runs}
    for turn in range(turns):
        for k, (key, one) in enumerate(runs.items(), 1):
            log, usage = alone(one, folder)
            found[key].append(Timing(cpu_seconds(usage), log))
            progress(k, len(runs), f"{what}, turn {turn + 1}")
    return found


def start(run, folder, ranks=1):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    program = HOSTS[run.host].LAUNCHER if run.predicted else HOSTS[run.host].STOCK
    return host.start(program, run.deck.resolve(), folder, ranks, [*run.words, *options(run.variables)])


def first_to_end(active):
    """Waits for it: its name, the process and what it used of the machine, which only wait4 tells of a single child."""
    while True:
        for name, process in active:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                process.returncode = os.waitstatus_to_exitcode(status)
                return name, process, usage
        time.sleep(0.02)


def cpu_seconds(usage):
    return usage.ru_utime + usage.ru_stime


def fail(run, folder, returncode, log):
    sys.exit(f"\nthe host failed ({returncode}): {run}\n{log[-2000:]}\nall it said: {folder / 'log'}")


def finish(run, folder, returncode, usage):
    """Makes a finished run of an unfinished one: complete first, then renamed."""
    unfinished = folder.with_name(f"{folder.name}.unfinished")
    log = (unfinished / "log").read_text(errors="replace")
    blown_up = returncode != 0 and any(words in log for words in BLOWN_UP)
    if returncode != 0 and not blown_up:
        fail(run, unfinished, returncode, log)
    if run.name() != folder.name:
        sys.exit(f"\nthe deck, a file that it reads or the plugin changed during the run: {run}")
    steps, seconds, nanoseconds = (None, None, None) if blown_up else longest_loop(log)
    result = {
        "blown_up": blown_up,
        "cpu_seconds": cpu_seconds(usage),
        "steps": steps,
        "seconds": seconds,
        "nanoseconds": nanoseconds,
        "user_seconds": usage.ru_utime,
    }
    kept = {file for pattern in run.keep for file in unfinished.glob(pattern)}
    for file in set(unfinished.iterdir()) - kept:
        shutil.rmtree(file) if file.is_dir() else file.unlink()
    (unfinished / "run.json").write_text(json.dumps({**run.identity(), "result": result}, indent=1) + "\n")
    unfinished.rename(folder)
