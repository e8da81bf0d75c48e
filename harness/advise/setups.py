# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the setups of a deck, without its steps, in a copy of its folder, and reads what the plugin tells of them."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from harness import HOSTS, host as hosts

SECONDS = 120  # for all setups of a deck: one that loops until something happens would never end
LARGEST_FOLDER = 1 << 30  # bytes that are copied
ERROR = re.compile(r"^ERROR(?: on proc \d+)?: (.*?)(?: \(\S+:\d+\))?$", re.MULTILINE)
NOTHING = re.compile(r"^WARNING: (.*?finds nothing to predict.*?)(?: \(\S+:\d+\))?$", re.MULTILINE)
WARNING = re.compile(r"^WARNING: (.*?cfpm.*?)(?: \(\S+:\d+\))?$", re.MULTILINE)


class Unknown(Exception):
    """Why there is nothing to advise, as text."""


@dataclass(frozen=True)
class Setups:
    with_contacts: list  # facts of each setup with contacts, in the order of the deck's runs
    remark: str  # why there may be more of them, or ""
    warnings: list  # of the plugin


def setups_of(deck, host, np=1, options=()):
    """options: of the host's command line. Raises Unknown."""
    suffixed = run(deck, host, np, ("-suffix", "cfpm", *options))
    with_contacts = [setup for setup in suffixed.facts if setup["contacts"]]
    if with_contacts:
        remark = f"after these setups the deck, without its steps, stopped: {suffixed.ended}" if suffixed.ended else ""
        return Setups(with_contacts, remark, suffixed.warnings)
    if suffixed.nothing:
        raise Unknown(suffixed.nothing)
    if suffixed.ended:
        stock = run(deck, host, np, options)
        if stock.ended:
            more = "; give the ranks that it is made for: -np N" if "processor" in stock.ended else ""
            raise Unknown(f"the deck does not run without the plugin either: {stock.ended}{more}")
        raise Unknown(f"refused with -suffix cfpm: {suffixed.ended}")
    if suffixed.facts:
        raise Unknown("the deck has no particles at the start of any of its runs, nor templates of them, so sizes are "
                      "not known; ./cfpm run DECK -suffix cfpm says nt when they have come")
    raise Unknown("no run of the deck has contacts that the plugin sees; expected a 'run' with a granular pair style")


def refusal(deck, host, method, np=1, options=()):
    """Why the plugin does not take the deck with that method, or ""."""
    tried = run(deck, host, np, ("-predict", method, "-suffix", "cfpm", *options))
    return "" if any(setup["contacts"] for setup in tried.facts) else tried.ended or tried.nothing


@dataclass(frozen=True)
class Outcome:
    facts: list
    ended: str  # the error with which the host stopped, or that it took too long; "" if it did not
    nothing: str
    warnings: list


def run(deck, host, np, options):
    size = sum(file.stat().st_size for file in deck.parent.rglob("*") if file.is_file())
    if size > LARGEST_FOLDER:
        raise Unknown(f"the folder of the deck, {deck.parent}, is copied, as a deck may write to it: found "
                      f"{size / 1e9:.1f} GB, expected at most 1; put the deck and what it reads into one of its own")
    with tempfile.TemporaryDirectory() as folder:
        work, facts = Path(folder) / "deck", Path(folder) / "facts"
        shutil.copytree(deck.parent, work, ignore_dangling_symlinks=True)
        (work / "post" / "restart").mkdir(parents=True, exist_ok=True)  # where LIGGGHTS's tutorials write
        command = [*hosts.command(HOSTS[host].LAUNCHER, np), "-in", deck.name, "-log", "none", *options]
        environment = {**hosts.environment(work, np), "CFPM_FACTS": str(facts)}
        try:
            done = subprocess.run(command, cwd=work, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace", timeout=SECONDS)
            said, code = done.stdout, done.returncode
        except subprocess.TimeoutExpired as late:
            said, code = (late.stdout or b"").decode(errors="replace"), None
        ended = f"its setups take longer than {SECONDS} s" if code is None else ""
        if code:
            error = ERROR.search(said)
            ended = error.group(1) if error else f"the host ended with {code}: {said.strip()[-200:]}"
        nothing = NOTHING.search(said)
        lines = facts.read_text().splitlines() if os.path.exists(facts) else []
        return Outcome([json.loads(line) for line in lines], ended, nothing.group(1) if nothing else "",
                       list(dict.fromkeys(WARNING.findall(said))))
