# SPDX-License-Identifier: GPL-2.0-or-later
"""What Tables 2 and 3 share: the programs one_contact and step_cost run, and what they measured beside what the
paper prints and what follows from its equations."""

import csv
import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness.host import BUILD  # noqa: E402

PROGRAMS = BUILD / "bin"

UNSTABLE = 0.0
UNCONDITIONAL = math.inf
BOUNDED = "bounded"
CONSERVED = "conserved"

WHAT_COSTS_MEAN = (
    "The numbers are for the arithmetic of one contact alone, a chain of operations that wait for each other, a "
    "division by the mass for every acceleration among them; in a bed, finding contacts and fetching particles come on "
    "top and bring all ratios closer to 1."
)


@dataclass
class Expected:
    """What the paper prints of a method, and what its equations give."""

    method: str  # as the programs call it
    title: str
    paper_limit: str
    limit: float  # of t* for an undamped contact
    derivation: str  # of the limit
    paper_energy: str
    energy: object  # change per step as (Fraction, power of theta), BOUNDED or CONSERVED
    order_undamped: float
    order_damped: float


def run(program, *options):
    process = subprocess.run([PROGRAMS / program, *options], check=True, stdout=subprocess.PIPE, text=True)
    return process.stdout


def measure(exhibit, families):
    """{(family, method): {quantity: {at: value}}}, as the head of one_contact.cpp describes it."""
    header, *rows = csv.reader(run("one_contact").splitlines())
    rows = [row for row in rows if row[0] in families]
    exhibit.csv("one_contact", header, rows)
    measured = {}
    for family, method, quantity, at, value in rows:
        measured.setdefault((family, method), {}).setdefault(quantity, {})[float(at)] = float(value)
    return measured


def yes(holds):
    return "yes" if holds else "NO"


def paper_column(family):
    return "paper, of the prediction" if family == "whole" else "paper"


def limits(exhibit, family, expected, measured):
    """Limits of stability on t*, which hold if both ends of the measured bracket do so within 0.5 %."""
    rows = []
    held = []
    for e in expected:
        m = measured[family, e.method]
        stable, unstable = m["stable_to"][0], m["unstable_from"][0]
        if stable == 0:
            found = f"unstable at {unstable:g}"
            held.append(e.limit == UNSTABLE)
        elif unstable == 0:
            found = f"stable to {stable:.0f}"
            held.append(e.limit == UNCONDITIONAL)
        else:
            found = f"{stable:.4f} - {unstable:.4f}"
            held.append(all(math.isclose(end, e.limit, rel_tol=0.005) for end in [stable, unstable]))
        rows.append([e.title, e.paper_limit, e.derivation, found, yes(held[-1])])
    exhibit.table(["limit on t*", paper_column(family), "derived", "measured", "as derived"], rows)
    exhibit.verdict("every limit is the derived one, within 0.5 %", all(held))


def energies(exhibit, family, expected, measured):
    """Energy change per step of an undamped contact, at theta = 0.05 and 0.1.

    A law holds if its coefficient does within 5 % at both: its next term is smaller by about theta^2. A bounded
    energy holds if it swings as much over all steps as over the first periods; the extremes fall between two steps,
    where the swing is cut by up to theta^2/2 = 0.5 % at either end. 1e-9 is the rounding of a million steps.
    """
    rows = []
    held = []
    for e in expected:
        m = measured[family, e.method]
        (low, low_rate), (high, high_rate) = sorted(m["energy_per_step"].items())
        if e.energy in (BOUNDED, CONSERVED):
            allowed = {at: 1.01 * early if e.energy == BOUNDED else 0.0 for at, early in m["early_swing"].items()}
            held.append(all(swing <= allowed[at] + 1e-9 for at, swing in m["swing"].items()))
            derived = "0, swings" if e.energy == BOUNDED else "0"
            found = f"0, swings by {m['swing'][high]:.1e}" if m["swing"][high] > 1e-9 else "0"
        else:
            coefficient, power = e.energy
            ratios = [rate / (math.pi * at) ** power for at, rate in [(low, low_rate), (high, high_rate)]]
            held.append(all(abs(ratio - coefficient) <= 0.05 * abs(coefficient) for ratio in ratios))
            measured_power = math.log(high_rate / low_rate) / math.log(high / low)
            derived = f"{coefficient} theta^{power} ({float(coefficient):.5f})"
            found = f"{ratios[0]:.5f} theta^{measured_power:.2f}"
        rows.append([e.title, e.paper_energy, derived, found, yes(held[-1])])
    exhibit.table(["energy per step", paper_column(family), "derived", "measured", "as derived"], rows)
    exhibit.verdict("every change of energy is the derived one, within 5 %, or bounded over a million steps", all(held))


def order(errors):
    """From halving the step; infinite where only rounding is left."""
    (_, coarse), (_, fine) = sorted(errors.items())
    return math.inf if coarse < 1e-12 else math.log2(coarse / fine)


def orders(exhibit, family, expected, measured):
    """Orders of accuracy inside a contact. The error's next term, of relative size theta = 0.016, may shift them by
    a few hundredths; 0.1 tells whole numbers apart."""
    rows = []
    held = []
    for e in expected:
        m = measured[family, e.method]
        found = [order(m["error_undamped"]), order(m["error_damped"])]
        derived = [e.order_undamped, e.order_damped]
        held.append(all(f == d or abs(f - d) <= 0.1 for f, d in zip(found, derived)))
        cells = [cell for d, f in zip(derived, found) for cell in (f"{d}", f"{f:.2f}")]
        rows.append([e.title, *cells, yes(held[-1])])
    header = ["order of accuracy", "undamped, derived", "measured", "damped, derived", "measured", "as derived"]
    exhibit.table(header, rows)
    exhibit.verdict("every order is the derived one, within 0.1", all(held))


def step_costs(exhibit, families):
    """{benchmark: costs of a step over explicit Euler's}, one per repetition, all measured in turns."""
    wanted = f"filter=^({'|'.join(['conventional/euler', *families])})"
    repetitions, seconds = (5, 0.005) if exhibit.quick else (40, 0.02)
    options = [wanted, "enable_random_interleaving=true", f"repetitions={repetitions}", f"min_time={seconds}"]
    report = json.loads(run("step_cost", *[f"--benchmark_{option}" for option in [*options, "format=json"]]))
    times = {}
    for one in sorted(report["benchmarks"], key=lambda one: one.get("repetition_index", -1)):
        if one["run_type"] == "iteration":
            times.setdefault(one["run_name"], []).append(1e9 / one["items_per_second"])
    times = {name: np.array(values) for name, values in times.items()}
    euler = times["conventional/euler"]
    print(f"step of explicit Euler: {np.median(euler):.1f} ns", flush=True)
    exhibit.csv(
        "step_cost",
        ["benchmark", "repetition", "ns_per_step", "over_euler"],
        [
            [name, k, f"{time:.4f}", f"{time / of_euler:.4f}"]
            for name, values in times.items()
            for k, (time, of_euler) in enumerate(zip(values, euler))
        ],
    )
    return {name: values / euler for name, values in times.items()}


def median_and_range(ratios):
    return f"{np.median(ratios):.2f} ({ratios.min():.2f} - {ratios.max():.2f})"


def plot_growth(exhibit, panels, expected, measured, caption):
    """ln(energy) per step over t*, a panel per family {family: title}."""
    figure, axes = plt.subplots(1, len(panels), figsize=(6.2 * len(panels), 4.2), sharey=True, squeeze=False)
    styles = ["-", "--", "-.", ":"]
    for ax, (family, title) in zip(axes[0], panels.items()):
        for e, style in zip(expected, styles):
            t_star, growth = zip(*sorted(measured[family, e.method]["growth"].items()))
            ax.plot(t_star, growth, style, label=e.title, linewidth=2)
        ax.set_yscale("symlog", linthresh=1e-4)
        ax.set_yticks([-1, -1e-2, -1e-4, 0, 1e-4, 1e-2, 1])
        ax.set(xlabel="t* = dt/tc", xlim=(0, 1.2), title=title)
        ax.grid(alpha=0.3)
    axes[0][0].set_ylabel("change of ln(energy) per step")
    axes[0][0].legend()
    figure.tight_layout()
    exhibit.plot(figure, "energy", caption)
    plt.close(figure)
