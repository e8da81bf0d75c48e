# SPDX-License-Identifier: GPL-2.0-or-later
"""A problem that settings are tried on, and what is measured of a setting from some starts."""

from dataclasses import dataclass

import ensemble
import numpy as np
import settings
from settings import STOCK, Setting
from tolerance import difference

SELECTION, REPORTED = 86028121, 122949823  # the first seeds of the starts that settings are chosen and reported with
AT_REST = 1e-3  # kinetic energy per sphere over m g d, see resting()
BLEW_UP, SHAKES = "blew up", "not at rest"


class Case:
    """A deck, how it is started, and which of its figures must come out right.

    A case that needs beds to start from says so by bed(); their files are then handed to run().
    """

    name: str  # of files, and behind --cases
    title: str
    text: str  # what is run, for the report
    host: str
    figures: dict  # {name: tolerance in percent}
    methods = settings.LINEAR  # of the plugin
    exponent = 0.5  # with which the time of a contact grows with 1/k
    reference = Setting(STOCK, 1, 40)
    starts = {"full": 8, "quick": 2}  # that settings are chosen with, and as many others that they are reported with

    def __init__(self, quick):
        self.quick = quick
        self.folder = None  # for files that are made for the deck, as meshes; set by who runs it
        self.count = self.starts["quick" if quick else "full"]
        self.stock = [Setting(STOCK, 1, 10), Setting(STOCK, 16, 10)] if quick else settings.of_stock()
        self.plugin = [Setting(m, 16, 10) for m in self.methods] if quick else settings.of_plugin(self.methods)
        if quick:  # whether all of it runs, not how right it is
            self.reference = self.reference._replace(nt=20)
            self.figures = dict.fromkeys(self.figures, np.inf)

    def bed(self, seed):
        """The run that makes the bed of a start and leaves it in bed.data; None if the case needs no bed."""
        return None

    def settled(self, result):
        """Whether that run made a bed at rest."""
        raise NotImplementedError

    def run(self, setting, seed, bed):
        """ensemble.Run. bed: the file, None without one."""
        raise NotImplementedError

    def read(self, result):
        """{figure: value} of a run that did not blow up, or why it is none: BLEW_UP, SHAKES."""
        raise NotImplementedError


def resting(energy, spheres, mass, diameter, gravity=9.81):
    """Whether spheres have come to rest, by their kinetic energy.

    All of it would lift them by AT_REST of a diameter, which is far below what the figures of beds are known to.
    """
    return bool(energy <= AT_REST * spheres * mass * gravity * diameter)


@dataclass(frozen=True)
class Measured:
    """A setting on a case, from some starts."""

    setting: Setting
    seconds: np.ndarray  # user's CPU time of each run [s]
    failed: tuple  # why a run is none, of those that are none
    differences: dict  # {figure: Difference to the reference}; empty if a run failed
    figures: dict  # {figure: tolerance in percent}

    @property
    def cpu(self):
        return float(self.seconds.mean())

    @property
    def starts(self):
        return len(self.seconds)

    @property
    def within(self):
        return not self.failed and all(d.within(self.figures[name]) for name, d in self.differences.items())

    @property
    def outside(self):
        return bool(self.failed) or any(d.outside(self.figures[name]) for name, d in self.differences.items())

    @property
    def error(self):
        """Of the figure that is off most, over its tolerance: the mean difference, and its standard error."""
        off = [(abs(d.mean) / self.figures[name], d.error / self.figures[name]) for name, d in self.differences.items()]
        return max(off, default=(np.nan, np.nan))


class Bench:
    """Runs settings of a case, keeping what is finished."""

    def __init__(self, case, folder):
        self.case, self.folder = case, folder
        case.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self._beds, self._references = {}, {}

    def _run(self, runs, what):
        return ensemble.run(runs, self.folder, f"{self.case.name}: {what}", cores=1)

    def _bed(self, seed):
        if seed not in self._beds:
            self._beds[seed] = None
            if run := self.case.bed(seed):
                (result,) = self._run([run], f"bed {seed}")
                if not self.case.quick and not self.case.settled(result):
                    raise SystemExit(f"{self.case.name}: the bed in {result.folder} is not at rest")
                self._beds[seed] = result.folder / "bed.data"
        return self._beds[seed]

    def make(self, setting, seed):
        return self.case.run(setting, seed, self._bed(seed))

    def reference(self, seed):
        """{figure: value}. A reference that fails ends all."""
        if seed not in self._references:
            (result,) = self._run([self.make(self.case.reference, seed)], f"reference, start {seed}")
            self._references[seed] = self._read(result)
            if not isinstance(self._references[seed], dict):
                raise SystemExit(f"{self.case.name}: the reference from start {seed} {self._references[seed]}")
        return self._references[seed]

    def _read(self, result):
        return BLEW_UP if result.blown_up else self.case.read(result)

    def measure(self, setting, seeds):
        """Measured, from these starts."""
        results = self._run([self.make(setting, seed) for seed in seeds], str(setting))
        return self.measured(setting, results, seeds)

    def measured(self, setting, results, seeds):
        """Of results that are there. A setting is done with when one of its runs fails."""
        read = [self._read(result) for result in results]
        failed = tuple(one for one in read if not isinstance(one, dict))
        differences = {}
        if not failed:
            references = [self.reference(seed) for seed in seeds]
            for name in self.case.figures:
                differences[name] = difference([one[name] for one in read], [one[name] for one in references])
        seconds = np.array([result.user_seconds for result in results])
        return Measured(setting, seconds, failed, differences, self.case.figures)

    def pair(self, settings_, seeds):
        """[Measured] of settings that are timed against each other, from these starts; who runs first alternates."""
        results = {setting: [] for setting in settings_}
        for k, seed in enumerate(seeds):
            order = settings_ if k % 2 == 0 else settings_[::-1]
            runs = [self.make(setting, seed) for setting in order]
            found = ensemble.together(runs, self.folder, f"{self.case.name}: timed, start {k + 1} of {len(seeds)}")
            for setting, result in zip(order, found):
                results[setting].append(result)
        return [self.measured(setting, own, seeds) for setting, own in results.items()]
