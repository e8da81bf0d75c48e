# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper claims in sections 3.2 and 4, and what came out here: one row of text each.

The numbers come from the files of the exhibits and from the timings; the reasons are told without any.
"""

from typing import NamedTuple

import numpy as np
from cases import DASHPOT, EXACT, STOCK, number
from cases import NAMES as HOSTS

ROUNDING = 0.5  # of the paper's factors, which are whole numbers
ALIKE = 10  # percent: no big difference, which would show in Fig. 10
ALL = 0.98  # of a number of particles: copies of a bed do not come to it exactly

CROWD = "a particle of a bed has several contacts, which together are stiffer than the single one that the limit is for"
ALONE = f"the prediction is of two bodies alone; {CROWD}"
MEAN = """the mean over many random starts shows less influence of the step than the single runs of the paper's figure,
    whose scatter is as large as what is looked for"""
CONVENTIONAL = f"""here the conventional method is velocity Verlet; with Adams-Bashforth, the paper's own, a bed needs
    more steps, though not so many as in the paper (see the readings of Fig. 8); {MEAN}"""
PREDICTED = f"""fewer steps are enough; where a mean strays again at smaller steps, it does within two standard errors;
    {MEAN}"""
LAW = """with the paper's law of friction (LAMMPS) the conventional method needs many more steps than the new one;
    without the tangential dashpot (LIGGGHTS) it is right almost as soon as it is stable"""


class Claim(NamedTuple):
    claim: str
    paper: str
    ours: dict  # {host: text}
    holds: dict  # {host: whether it was reproduced}
    why: str

    def row(self):
        return [self.claim, self.paper, self.told(), self.reproduced(), " ".join(self.why.split())]

    def told(self):
        if len(set(self.ours.values())) == 1:
            return next(iter(self.ours.values()))
        return "; ".join(f"{HOSTS[host]} {text}" for host, text in self.ours.items())

    def reproduced(self):
        if len(set(self.holds.values())) == 1:
            return "yes" if next(iter(self.holds.values())) else "no"
        return "only in " + next(HOSTS[host] for host, holds in self.holds.items() if holds)


class Findings:
    """What was measured. files: {name: rows} of the CSV files; speedups and costs: one value per turn of the timing."""

    def __init__(self, hosts, files, speedups, costs):
        self.hosts, self.files, self.speedups, self.costs = hosts, files, speedups, costs

    def row(self, file, host, method, nt):
        """Of packing or discharge."""
        law = {"host": host, "dashpot": DASHPOT[host], "method": method}
        (found,) = (row for row in self.files[file] if law.items() <= row.items() and float(row["nt"]) == nt)
        return found

    def limit(self, deck, what, host, method):
        """Smallest nt. what: stable_from, agrees_at, agrees_from; infinite if it was not found."""
        law = {"host": host, "dashpot": DASHPOT[host], "method": method}
        (found,) = (row for row in self.files[f"{deck}/limits"] if law.items() <= row.items())
        return float(found[what])

    def claim(self, claim, paper, measure, tell, holds, why):
        """measure(host), of which tell makes text and holds a judgement; no host if it measures nothing."""
        found = {host: value for host in self.hosts if (value := measure(host)) is not None}
        ours = {host: tell(value) for host, value in found.items()}
        return Claim(claim, paper, ours, {host: bool(holds(value)) for host, value in found.items()}, why)

    def blow_up(self, file, method, nt, expected, why):
        row = {host: self.row(file, host, method, nt) for host in self.hosts}
        return self.claim(
            f"{file}, {method}, nt = {nt:g}: {'diverges' if expected else 'does not diverge'}",
            "diverges" if expected else "does not",
            lambda host: (int(row[host]["blown_up"]), int(row[host]["runs"])),
            lambda found: f"{found[0]} of {found[1]} runs blew up",
            lambda found: (found[0] > 0) == expected,
            why,
        )

    def constant_from(self, method, nt, why):
        return self.claim(
            f"packing ratio independent of the step, {method}",
            f"from nt = {nt}",
            lambda host: [self.limit("packing", what, host, method) for what in ("agrees_at", "agrees_from")],
            lambda found: f"at nt = {number(found[0], 'g')}, at all from {number(found[1], 'g')}",
            lambda found: nt / 2 <= found[1] <= nt * 2,
            why,
        )

    def factor(self, claim, paper, measure, why):
        """A gain of so many times, which more than that fulfils too."""
        tell = "{:.2g}".format
        return self.claim(claim, f"{paper} times", measure, tell, lambda found: found >= paper - ROUNDING, why)

    def larger(self, deck, what):
        return lambda host: self.limit(deck, what, host, STOCK) / self.limit(deck, what, host, EXACT)

    def faster(self, claim, deck, paper, why):
        def measure(host):
            return [np.median(self.speedups[deck, host, EXACT, which]) for which in ("own", "fine")]

        tell = "{:.1f} times against its own smallest nt, {:.1f} against nt = 30".format
        return self.claim(
            claim, f"{paper} times", measure, lambda f: tell(*f), lambda f: f[0] >= paper - ROUNDING, why
        )

    def packing(self):
        yield self.blow_up("packing", STOCK, 3, True, CROWD)
        yield self.blow_up("packing", EXACT, 3, False, "predicted forces allow larger steps")
        yield self.blow_up("packing", EXACT, 1.5, False, ALONE)
        yield self.constant_from(STOCK, 300, CONVENTIONAL)
        yield self.constant_from(EXACT, 30, PREDICTED)
        yield self.ratio()
        yield self.factor("packing: larger step at the same ratio", 10, self.larger("packing", "agrees_at"), LAW)
        yield self.cost()
        why = f"{LAW}; building neighbour lists and output take their time however few the steps are"
        yield self.faster("packing: faster at the same ratio", "packing", 8, why)
        yield self.factor(
            "packing: faster at the paper's own steps, nt = 30 and nt = 300",
            8,
            lambda host: 300 / 30 / np.median(self.costs["packing", host]),
            "follows from the cost of a step; but neither method needs so many of them",
        )

    def ratio(self):
        def measure(host):
            row = self.row("packing", host, STOCK, max(self.steps("packing", host, STOCK)))
            return float(row["ratio"]), float(row["ratio_error"]), int(row["runs"])

        return self.claim(
            "packing ratio at small steps",
            "0.57",
            measure,
            lambda found: number(found[0], ".4f", found[1]),
            lambda found: abs(found[0] - 0.57) <= 0.005 + 2 * found[1] * found[2] ** 0.5,
            "the paper shows single runs, which scatter by more than its last digit; the friction law matters too",
        )

    def steps(self, file, host, method):
        law = {"host": host, "dashpot": DASHPOT[host], "method": method}
        return [float(row["nt"]) for row in self.files[file] if law.items() <= row.items()]

    def cost(self):
        return self.claim(
            "cost of a step, new over conventional",
            "1.2",
            lambda host: np.quantile(self.costs["packing", host], (0.5, 0, 1)),
            lambda found: "{:.2f} ({:.2f} - {:.2f})".format(*found),
            lambda found: abs(found[0] - 1.2) < 0.1,
            """the prediction of a linear contact is one map, made once for each kind of contact; what it adds shows
            beside LAMMPS's lean loop over contacts and is hidden beside LIGGGHTS's""",
        )

    def discharge(self):
        yield self.blow_up("discharge", STOCK, 3, True, CROWD)
        yield self.blow_up("discharge", STOCK, 6, False, "as in the packing")
        yield self.blow_up("discharge", EXACT, 3, False, "as in the packing")
        yield self.blow_up("discharge", EXACT, 1.5, False, ALONE)
        why = "the new method does not reach the paper's smallest nt"
        yield self.factor("discharge: larger step, both stable", 4, self.larger("discharge", "stable_from"), why)
        yield self.faster("discharge: faster with the same outflow", "discharge", 3, why)
        yield self.claim(
            "discharge: no big difference at large steps",
            "none found",
            self.largest_difference,
            lambda found: f"at most {found:.1f} % of the number discharged, mean over time",
            lambda found: found <= ALIKE,
            "spheres on their way out forget the errors of single contacts",
        )

    def largest_difference(self, host):
        """Of the new method where it is stable, in percent."""
        stable = self.limit("discharge", "stable_from", host, EXACT)
        nts = [nt for nt in self.steps("discharge", host, EXACT) if nt >= stable]
        rows = [self.row("discharge", host, EXACT, nt) for nt in nts]
        return max(abs(float(row["percent_mean_over_time"])) for row in rows)

    def scaling(self):
        def measure(host):
            rows = [row for row in self.files["scaling"] if row["host"] == host]
            found = [(int(row["particles"]), int(row["ranks"]), float(row["ratio"])) for row in rows]
            return max(found, default=None)

        yield self.claim(
            "two sizes of particle, many of them",
            "about 10 million",
            measure,
            lambda found: "{:,} particles on {} ranks, a step costs {:.2f} of stock's".format(*found),
            lambda found: found[0] >= ALL * 1e7,
            "memory and time are the limits; both grow in proportion to the particles",
        )
