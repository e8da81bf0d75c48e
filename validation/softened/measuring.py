# SPDX-License-Identifier: GPL-2.0-or-later
"""What is measured of a setting on a case, and the runs that it takes."""

from dataclasses import dataclass

import ensemble
import numpy as np
from case import BLEW_UP
from settings import Setting
from tolerance import difference


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


class Runner:
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

    def pair(self, settings, seeds):
        """[Measured] of settings that are timed against each other, from these starts; who runs first alternates."""
        results = {setting: [] for setting in settings}
        for k, seed in enumerate(seeds):
            order = settings if k % 2 == 0 else settings[::-1]
            runs = [self.make(setting, seed) for setting in order]
            found = ensemble.together(runs, self.folder, f"{self.case.name}: timed, start {k + 1} of {len(seeds)}")
            for setting, result in zip(order, found):
                results[setting].append(result)
        return [self.measured(setting, own, seeds) for setting, own in results.items()]
