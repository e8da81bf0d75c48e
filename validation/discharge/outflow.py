# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers discharged of an ensemble beside those of the conventional method from the same beds."""

import numpy as np
import outlet
from averages import mean_and_error, paired_difference
from cases import DASHPOT, HOSTS, SIGMA, STOCK, Case, Outcome, execute

REFERENCE = 30  # nt of the conventional method
END = 2.0  # [s]
TIMES = (0.5, 1.0, 2.0)  # at which the discharged are counted [s]
GRID = np.linspace(0, END, 201)  # for curves and their means
BAND = 5  # percent
QUANTITIES = {
    **{f"at {t:g} s": lambda d, t=t: d.number(t) for t in TIMES},
    "mean over time": lambda d: d.number(GRID).mean(),
}
JUDGED = ("at 1 s", "mean over time")


def discharge(cases, seeds, runs_folder, what):
    """{case: Outcome}. cases: {case: number of beds}; seeds: of the random starts of the beds."""
    laws = {Case(case.host, case.dashpot, STOCK, outlet.BED_NT): len(seeds) for case in cases}

    def make_bed(law, k):
        return outlet.settling(law.host, law.dashpot, seeds[k])

    settled = execute(laws, make_bed, runs_folder, f"{what}, beds")
    beds = {law.host: [outlet.bed(result) for result in results] for law, results in settled.items()}

    def make_run(case, k):
        return outlet.discharging(case.host, beds[case.host][k], **case.variables())

    found = execute(cases, make_run, runs_folder, f"{what}, runs")
    return {case: Outcome([outlet.read(*pair) for pair in zip(own, beds[case.host])]) for case, own in found.items()}


class Compared:
    """An outcome beside the conventional method's at the reference step, from the same beds."""

    def __init__(self, outcome, reference):
        self.outcome, self.reference = outcome, reference

    def pairs(self, quantity):
        values = self.outcome.values(quantity)
        return values, self.reference.values(quantity)[: len(values)]

    def spheres(self, name):
        """Mean difference and its standard error."""
        values, reference = self.pairs(QUANTITIES[name])
        return mean_and_error(values - reference)

    def percent(self, name):
        return paired_difference(*self.pairs(QUANTITIES[name]))

    def agrees(self):
        found = [self.percent(name) for name in JUDGED]
        return self.outcome.blown_up == 0 and all(abs(d) <= min(BAND, SIGMA * error) for d, error in found)


def compare(outcomes, reference=REFERENCE):
    """{case: Compared}, in the order of the tables. reference: nt of the conventional method."""
    references = {host: outcomes.get(Case(host, DASHPOT[host], STOCK, reference)) for host in HOSTS}
    ordered = sorted(outcomes.items(), key=lambda item: item[0].order())
    return {case: Compared(outcome, references[case.host]) for case, outcome in ordered}


def scatter(comparisons, name):
    """Standard deviation, in percent, of the difference between two runs from one bed; mean over the stable cases."""
    found = []
    for case, compared in comparisons.items():
        error = compared.percent(name)[1]
        if compared.outcome.blown_up == 0 and error > 0:
            found.append(error * np.sqrt(len(compared.outcome.runs)))
    return np.mean(found)


def mean_curve(outcome):
    """Number discharged over GRID: mean and standard error of the runs that did not blow up, or of all if all did."""
    runs = [d for d in outcome.runs if not d.blown_up] or outcome.runs
    mean, error = np.transpose([mean_and_error(numbers) for numbers in np.transpose([d.number(GRID) for d in runs])])
    return mean, error
