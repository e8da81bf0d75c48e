# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts at any step: stock, predicted forces and predicted impulses beside a reference with tiny steps.

Pairs of equal spheres and spheres on a plane, from nearly head-on to grazing, with and without spin, in LIGGGHTS.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from impacts import (
    FRICTION,
    LONGEST,
    POISSON,
    SPEED,
    SPINS,
    Hertz,
    Hooke,
    expected,
    impacts,
    labels,
    measure,
    sliding,
)

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from exhibit import Exhibit  # noqa: E402
from experiment import order, phase_error  # noqa: E402
from host_collisions import HALVED, STOCK, cfpm, in_parallel, small_step_limit  # noqa: E402

MATERIALS = (Hooke(0.2), Hooke(0.9), Hooke(0.2, dashpot=True), Hertz(0.5), Hertz(0.9))
IMPULSE = cfpm("impulse")
METHODS = (STOCK, cfpm("exact"), IMPULSE)
STEPS = (0.05, 0.1, 1 / 3, 1, 2, 3)  # dt over tc
QUICK_STEPS = (0.1, 1 / 3, 1, 3)
ANGLES = (5, 15, 30, 45, 60, 75, 85)
QUICK_ANGLES = (15, 45, 75, 85)
QUICK_SPINS = ("none", "across")
DENSE = range(1, 90, 2)  # angles of the line in the plot
REFERENCE_STEPS, QUICK_REFERENCE_STEPS = 4000, 1000  # per tc
ROUNDING = 1e-6  # what tests/liggghts/test_impulse.py allows head-on collisions

QUANTITIES = {
    "normal velocity": slice(2, 3),
    "tangential velocity": slice(0, 2),
    "spin": slice(3, 6),
}


def told(step):
    return "1/3" if step == 1 / 3 else f"{step:g}"


class Findings:
    """results: {(material, method, step): (impacts, phases, 6)}; references: {material: ((impacts, 6), error)}."""

    def __init__(self, angles, spins, results, references):
        self.labels = labels(angles, spins)
        self.cases = impacts(angles, spins)
        self.results, self.references = results, references

    def off(self, material, method, step):
        return self.results[material, method, step] - self.references[material][0][:, None]

    def rms(self, quantity, material, method, step):
        """Of each impact over the phases."""
        return np.sqrt((self.off(material, method, step)[..., QUANTITIES[quantity]] ** 2).sum(axis=2).mean(axis=1))

    def mean(self, quantity, material, method, step):
        """Size of the mean error of each impact."""
        return np.linalg.norm(self.off(material, method, step)[..., QUANTITIES[quantity]].mean(axis=1), axis=-1)

    def limit(self, material, method):
        """Error of what the phase means tend to for small steps, and its bound: (impacts, 6)."""
        samples = [self.off(material, method, 1 / nt) for nt in HALVED]
        q = order(material, method)
        limit, change = small_step_limit(*(s.mean(axis=1) for s in samples), q)
        _, middle, fine = (phase_error(np.moveaxis(s, 1, 2)) for s in samples)
        return np.abs(limit), change + (2**q * fine + middle) / (2**q - 1) + self.references[material][1]


def tabulate(exhibit, found, steps):
    for quantity in QUANTITIES:
        exhibit.text(
            f"""Error of the {quantity} over dt/tc: root mean square over the phases, the largest of all impacts, and
            in brackets the root mean square over all:"""
        )
        rows = []
        for material in MATERIALS:
            for method in METHODS:
                own = [found.rms(quantity, material, method, step) for step in steps]
                cells = [f"{e.max():.2g} ({np.sqrt((e**2).mean()):.2g})" for e in own]
                rows.append([material, method.name, *cells])
        exhibit.table(["contact", "method", *map(told, steps)], rows)
    exhibit.csv(
        "oblique",
        ["contact", "method", "dt_over_tc", "body", "angle", "spin"]
        + [f"{quantity.replace(' ', '_')}_{what}_error" for quantity in QUANTITIES for what in ("mean", "rms")],
        [
            [material, method.name, told(step), *label, *(f"{e[k]:.4g}" for e in errors)]
            for material in MATERIALS
            for method in METHODS
            for step in steps
            for errors in [[size(q, material, method, step) for q in QUANTITIES for size in (found.mean, found.rms)]]
            for k, label in enumerate(found.labels)
        ],
    )


def plot(found, angles, lines, steps):
    figure, panels = plt.subplots(
        len(steps), len(MATERIALS), figsize=(3.2 * len(MATERIALS), 3 * len(steps)), sharex=True, squeeze=False
    )
    own = [k for k, (body, _, spin) in enumerate(found.labels) if body == "pair" and spin == "none"]
    for row, step in zip(panels, steps):
        for axes, material in zip(row, MATERIALS):
            axes.plot(DENSE, lines[material], "k-", linewidth=1, label="reference")
            for k, method in enumerate(METHODS):
                tangential = found.results[material, method, step][own, :, 0]
                x = np.array(angles) + 0.6 * (k - 1)
                style = {"fmt": "sod"[k], "color": ("C0", "C2", "C3")[k], "markersize": 4, "label": method.name}
                axes.errorbar(x, tangential.mean(axis=1), tangential.std(axis=1), **style)
            axes.set(ylim=(-0.25, 1.25), title=f"{material}, dt = {told(step)} tc".replace("1 tc", "tc"))
            axes.title.set_fontsize(9)
            axes.grid(alpha=0.3)
    for axes in panels[-1]:
        axes.set(xlabel="angle [degrees]")
    for axes in panels[:, 0]:
        axes.set(ylabel="tangential velocity after\nthe impact, over its speed")
    panels[0, 0].legend(fontsize=7)
    figure.tight_layout()
    return figure


def judge_limits(exhibit, found):
    """Of every contact the worst impact: a single one may change little from step to step by chance."""
    for method in METHODS:
        limits = [[part.max() for part in found.limit(m, method)] for m in MATERIALS]
        error, bound = max(limits, key=lambda pair: pair[0] / pair[1])
        exhibit.verdict(
            f"{method.name} tends to the reference for small steps: extrapolated, off by {error:.1e} where it "
            f"matters most, allowed {bound:.1e}",
            error <= bound,
        )


def judge_wall(exhibit, found, steps):
    """The normal of a plane does not turn: along it the impact is a head-on one."""
    wall = found.cases.wall
    approach = -found.cases.velocity[wall, 2:]
    off = max(
        np.abs(found.results[material, IMPULSE, step][wall, :, 2] - material.restitution * approach).max()
        for material in MATERIALS
        for step in steps
    )
    exhibit.verdict(
        f"{IMPULSE.name}, plane: along the normal every oblique impact has the restitution of the closed form at "
        f"every step, off by {off:.1e} of the impact speed at most, allowed {ROUNDING:.0e}",
        off <= ROUNDING,
    )


def judge_sliding(exhibit, found, steps):
    """On a plane, impacts whose slip outlasts all the friction that there can be, without tangential dashpot."""
    found_off = []
    for material in (m for m in MATERIALS if not m.dashpot):
        exact, error = found.references[material]
        slides, allowed = sliding(found.cases, FRICTION, material.restitution, LONGEST, SPEED * exact)
        for step in steps:
            off = np.linalg.norm(found.off(material, IMPULSE, step)[slides, :, :2], axis=2).max(axis=1)
            found_off += zip(off, allowed / SPEED + error + ROUNDING)
    worst = max(found_off, key=lambda pair: pair[0] / pair[1])
    exhibit.verdict(
        f"{IMPULSE.name}, plane, slip that outlasts all friction: at every step the tangential velocity is off by "
        f"no more than friction falls short of mu times the normal impulse while the spring is loaded, and than the "
        f"slip turns as the lever of the spin changes; off by {worst[0]:.1e} where it matters most, allowed "
        f"{worst[1]:.1e}",
        worst[0] <= worst[1],
    )


def main():
    exhibit = Exhibit("Oblique impacts", __doc__)
    steps = QUICK_STEPS if exhibit.quick else STEPS
    angles = QUICK_ANGLES if exhibit.quick else ANGLES
    spins = QUICK_SPINS if exhibit.quick else tuple(SPINS)
    exhibit.text(
        f"""Pairs of equal spheres and single spheres on a plane hit each other at {min(angles)} to {max(angles)}
        degrees between the relative velocity and the normal at the touch, without spin and with surface velocities by
        spin of half the impact speed: {", ".join(spin for spin in spins if spin != "none")}. Friction is {FRICTION:g},
        ks = kn/(2(1 + {POISSON:g})); with the dashpot across the normal, its damping is hn (ks/kn)^(1/2). tc is the
        contact time of the undamped head-on pair; in 3 tc the impact speed covers 0.075 of a radius. Every impact is
        run with 16 phases of the step at which the contact begins. All velocities, also the surface's by spin, are over
        the impact speed and have the directions of the touch."""
    )
    exhibit.text(
        """The reference (reference.py) is independent of the host and of the plugin: Runge and Kutta's method with
        tiny steps, for a normal force without tension along the line of centres, which turns, and a spring and a
        dashpot across it. Coulomb limits the spring alone, and where it is at the limit the dashpot does nothing: the
        law of LIGGGHTS."""
    )
    cases = impacts(angles, spins)
    reference_steps = QUICK_REFERENCE_STEPS if exhibit.quick else REFERENCE_STEPS
    references = {m: expected(m, cases, reference_steps) for m in MATERIALS}
    dense = impacts(DENSE, ("none",))
    lines = {m: expected(m, dense, QUICK_REFERENCE_STEPS)[0][: len(DENSE), 0] for m in MATERIALS}
    all_steps = [*steps, *(1 / nt for nt in HALVED)]
    jobs = [(material, method, cases, step) for step in all_steps for material in MATERIALS for method in METHODS]
    measured = in_parallel(measure, jobs, "oblique impacts")
    results = {(material, method, step): result for (material, method, _, step), result in measured.items()}
    found = Findings(angles, spins, results, references)

    exhibit.text(
        f"""Halving its steps changes the reference by {max(error for _, error in references.values()):.1e} of the
        impact speed at most."""
    )
    tabulate(exhibit, found, steps)
    shown = [step for step in steps if step in (1 / 3, 1, 3)]
    exhibit.plot(
        plot(found, angles, lines, shown),
        "tangential",
        "Pairs without spin: tangential velocity after the impact, mean and standard deviation over the phases.",
    )
    judge_limits(exhibit, found)
    judge_wall(exhibit, found, steps)
    judge_sliding(exhibit, found, steps)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
