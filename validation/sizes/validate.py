# SPDX-License-Identifier: GPL-2.0-or-later
"""Static friction of a fine sphere on two large ones, at size ratios of 1 to 100, in both hosts.

The three-particle case of Vyas, Ottino, Lueptow and Umbanhowar, "Improved velocity-Verlet algorithm for the discrete
element method" (2025): a fine sphere rolls off two large ones that touch; with velocity Verlet it does not come off.
"""

import sys
from math import degrees, isnan, radians
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import rolling
from rolling import HOSTS, STOCK, Case

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from exhibit import Exhibit  # noqa: E402
from host_collisions import in_parallel  # noqa: E402

METHODS = (STOCK, "exact", "rk4", "impulse")
QUICK_METHODS = (STOCK, "exact", "impulse")
RATIOS, QUICK_RATIOS = (1, 2, 3, 5, 7, 10, 20, 50, 100), (2, 20, 100)
NT, QUICK_NT = (3, 6, 12, 25, 50), (6,)
IMPULSE_NT = (1, 2, *NT)
TC = 1e-4  # of a contact, at all ratios [s]
ROLLED = radians(30)  # no contact slips before 42 degrees
RIGHT = 0.01  # of the time until it leaves
RIGHT_FROM = 6  # nt
LONGER = 1.3  # than it takes the reference to leave
SAMPLES = 500
STEPS = 50  # of the reference per contact time

# of the log of LAMMPS's example with synchronized_verlet: time [s] and kinetic energy [J] of the fine sphere, which
# rolls, slips, and falls freely from 0.146 s on
PUBLISHED = {0.06: 1.0535747e-12, 0.12: 6.2344723e-11, 0.15: 8.5696526e-10, 0.18: 1.2744453e-08}
EXAMPLE = {"ratio": 20, "kn": 1e4, "dt": 1e-6}


def find_references(ratios):
    """{case: reference}, and how much the time of leaving of any changes if their steps are halved."""
    found, change = {}, 0.0
    for case in (Case(ratio, TC) for ratio in ratios):
        duration = LONGER * case.reference(0.5, SAMPLES, STEPS).left()
        found[case], fine = (case.reference(duration, 10 * SAMPLES, n * STEPS) for n in (1, 2))
        change = max(change, abs(fine.left() / found[case].left() - 1))
    return found, change


def rolled(motion, nt):
    """Angle over that of the closed form, less one, when that is ROLLED; and how much off it may be.

    At the start the springs are empty and the sphere is above its resting place, so it is as if it began a contact time
    late, and in steps one step more: the angle is less by the factor growth times delay. Where it sinks in, p is
    shorter by at most 1 + 9/nt times the true sink (overlaps at rest, docs/pair_gran_cfpm.md); the growth differs by
    half of that part of p at most, and the angle by growth times the time times as much.
    """
    case, ideal = motion.case, motion.case.rolled(motion.t)
    k = np.argmax(ideal > ROLLED)
    late = case.growth * (TC + TC / nt)
    sunk = (1 + 9 / nt) * case.sink / case.distance
    return motion.angle[k] / ideal[k] - 1, late + case.growth * motion.t[k] * sunk / 2


def told(motion):
    left = motion.left()
    if isnan(left):
        return "stays on"
    return f"{degrees(motion.at(motion.angle, left)):.1f}"


def late(motion, reference):
    """Time until it leaves over the right one, less one."""
    return motion.left() / reference.left() - 1


def tabulate(exhibit, motions, references, methods):
    exhibit.text(
        f"""Angle from the top at which the fine sphere has left, in degrees ("stays on": it has not after {LONGER:g}
        times the time that the reference takes):"""
    )
    keys = dict.fromkeys((host, method, nt) for host, method, _, nt in motions)
    rows = [["", "reference", "", *(told(reference) for reference in references.values())]]
    rows += [[*key, *(told(motions[key[0], key[1], case, key[2]]) for case in references)] for key in keys]
    exhibit.table(["host", "method", "nt", *(f"R = {case.ratio:g}" for case in references)], rows)
    exhibit.csv(
        "sizes",
        ["host", "method", "nt", "ratio", "rolled_error", "slip", "leaves_after_s", "leaves_at_degrees", "late"],
        [
            [host, method, nt, case.ratio, f"{rolled(motion, nt)[0]:.3g}", f"{slip(motion):.2g}"]
            + [f"{motion.left():.5g}", told(motion), f"{late(motion, references[case]):.3g}"]
            for (host, method, case, nt), motion in motions.items()
        ],
    )
    rows = [[method, *(right_from(motions, method, *item) for item in references.items())] for method in methods]
    exhibit.text(f"From which nt on it leaves at the right time, within {100 * RIGHT:g} %, in both hosts:")
    exhibit.table(["method", *(f"R = {case.ratio:g}" for case in references)], rows)


def right_from(motions, method, case, reference):
    """The least nt from which on both hosts leave at the right time."""
    right = {}
    for (_, name, shape, nt), motion in motions.items():
        if (name, shape) == (method, case):
            right[nt] = right.get(nt, True) and abs(late(motion, reference)) <= RIGHT
    return min((nt for nt in right if all(good for other, good in right.items() if other >= nt)), default="none")


def slip(motion):
    """When the closed form is at ROLLED."""
    return motion.slip()[np.argmax(motion.case.rolled(motion.t) > ROLLED) - 1]


def plot(motions, references, methods, nt):
    figure, axes = plt.subplots(figsize=(7, 4.5))
    cases = list(references)
    axes.plot(
        [case.ratio for case in cases],
        [degrees(r.at(r.angle, r.left())) for r in references.values()],
        "k-",
        label="reference",
    )
    for k, method in enumerate(methods):
        own = [motions["LIGGGHTS", method, case, nt] for case in cases]
        angles = [degrees(m.at(m.angle, m.left())) for m in own]
        axes.plot([case.ratio for case in cases], angles, "sodv"[k], color=f"C{k}", label=method, markersize=5)
        stuck = [case.ratio for case, angle in zip(cases, angles) if isnan(angle)]
        axes.plot(stuck, [180] * len(stuck), "x", color=f"C{k}")
    axes.set(xscale="log", xlabel="size ratio", ylabel="leaves at, degrees from the top (x: never)")
    axes.legend()
    axes.grid(alpha=0.3)
    return figure


def judge(exhibit, motions, references, methods):
    predicted = [method for method in methods if method != STOCK]
    rolls = [rolled(motion, nt) for (_, method, _, nt), motion in motions.items() if method in predicted]
    error, allowed = max(rolls, key=lambda pair: abs(pair[0]) / pair[1])
    exhibit.verdict(
        f"predicted contacts roll without slip until {degrees(ROLLED):.0f} degrees, as static friction lets them, at "
        f"every size ratio and step: angle off by {abs(error):.1e} of it where it matters most, allowed {allowed:.1e}",
        abs(error) <= allowed,
    )
    for method in predicted:
        own = {(case, nt): m for (_, name, case, nt), m in motions.items() if name == method}
        exhibit.verdict(f"{method} leaves at every step", not any(isnan(motion.left()) for motion in own.values()))
        worst = np.max([abs(late(motion, references[case])) for (case, nt), motion in own.items() if nt >= RIGHT_FROM])
        exhibit.verdict(
            f"{method} leaves at the right time from nt = {RIGHT_FROM} on, off by {100 * worst:.2f} % at most, allowed "
            f"{100 * RIGHT:g} %",
            worst <= RIGHT,
        )
    stays = all(isnan(m.left()) for (_, method, case, _), m in motions.items() if method == STOCK and case.ratio >= 20)
    exhibit.verdict("the stock style stays on at ratios of 20 and more at every step, as the paper found", stays)


def judge_example(exhibit, methods):
    """LAMMPS's own example, step by step as published."""
    shape = Case(EXAMPLE["ratio"], 1.0)
    case = Case(shape.ratio, np.pi * np.sqrt(shape.fine.mass / EXAMPLE["kn"]))
    last = max(PUBLISHED)
    jobs = [("LAMMPS", method, case, EXAMPLE["dt"], last, 60) for method in methods]
    motions = {job[1]: motion for job, motion in in_parallel(rolling.measure, jobs, "the published example").items()}
    exhibit.text(
        f"""LAMMPS's example itself, R = 20, kn = 1e4 N/m, nt = {case.tc / EXAMPLE["dt"]:.1f}: kinetic energy of the
        fine sphere in J, beside what the log of that example says with synchronized_verlet:"""
    )
    rows = [["synchronized_verlet", *(f"{energy:.4e}" for energy in PUBLISHED.values())]]
    found = {method: [motion.at(motion.kinetic(), t) for t in PUBLISHED] for method, motion in motions.items()}
    rows += [[method, *(f"{energy:.4e}" for energy in energies)] for method, energies in found.items()]
    exhibit.table(["method", *(f"{t:g} s" for t in PUBLISHED)], rows)
    for method in (m for m in methods if m != STOCK):
        own = motions[method]
        off = max(abs(np.interp(energy, own.kinetic(), own.t) / t - 1) for t, energy in PUBLISHED.items())
        exhibit.verdict(
            f"{method} has the published energies at the published times, off by {100 * off:.2f} % at most, allowed "
            f"{100 * RIGHT:g} %",
            off <= RIGHT,
        )


def main():
    exhibit = Exhibit("Size ratios: static friction of a fine sphere", __doc__)
    methods = QUICK_METHODS if exhibit.quick else METHODS
    nts = QUICK_NT if exhibit.quick else NT
    ratios = QUICK_RATIOS if exhibit.quick else RATIOS
    exhibit.text(
        f"""Two held spheres of 10 mm touch, a fine one touches both at rest, {degrees(rolling.START):.0f} degree from
        the top (e = {rolling.RESTITUTION:g}, mu = {rolling.FRICTION:g}, ks/kn = {rolling.TANGENTIAL:g}, no tangential
        dashpot). It should roll without slip, slip, and leave. R is the ratio of the radii, nt the number of steps per
        contact of the fine sphere. Geometry, material and start are those of the example that the authors added to
        LAMMPS, which has R = 20. Ours: the other ratios, and stiffnesses such that a contact takes {TC:g} s at all of
        them."""
    )
    references, change = find_references(ratios)
    exhibit.text(
        f"""While it rolls, the angle has a closed form (rolling.py). When it leaves is told by small steps of Runge and
        Kutta's method for the same law (fine_particle.cpp); halving them changes that time by {change:.1e}."""
    )
    jobs = [
        (host, method, case, TC / nt, LONGER * reference.left(), SAMPLES)
        for method in methods
        for nt in (IMPULSE_NT if method == "impulse" and not exhibit.quick else nts)
        for host in HOSTS
        for case, reference in references.items()
    ]
    found = in_parallel(rolling.measure, jobs, "size ratios")
    motions = {(host, method, case, round(TC / dt)): m for (host, method, case, dt, _, _), m in found.items()}
    tabulate(exhibit, motions, references, methods)
    shown = nts[len(nts) // 2]
    exhibit.plot(plot(motions, references, methods, shown), "leaving", f"LIGGGHTS, nt = {shown}.")
    exhibit.text(
        """Why: the stock styles stretch the springs by the velocity in the middle of a step along the tangent plane at
        its end. On a circle of radius p that adds a false stretch of about v^2 dt^2/(2 p) outwards in every step, and
        v^2 dt t/(2 p) in the time t: more than the springs have at Coulomb's limit, which are some ten nanometres long,
        long before the sphere should leave. So friction at its limit pulls it inwards. It stays where that is stronger
        than what presses it out, mu (1 - s^2)^(1/2) > s with s of rolling.py: with this friction at R > 8.5. The
        predicted contacts keep the spring in the middle of a step, where the velocity belongs, so their error is of
        second order. (True static friction holds it for a while too at such ratios, hence the angles of the
        reference.)"""
    )
    judge(exhibit, motions, references, methods)
    judge_example(exhibit, methods)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
