# SPDX-License-Identifier: GPL-2.0-or-later
"""Figs. 3-5: spheres A and C hit B, at rest between them, from both sides, C late by t* contact times.

The real host, with the stock style and with gran/cfpm, beside a reference that integrates the equations of motion of
the three spheres with error control.
"""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from exhibit import Exhibit  # noqa: E402
from host_collisions import (  # noqa: E402
    BALL,
    DIAMETER,
    HALVED,
    PHASES,
    STOCK,
    centres,
    cfpm,
    collide,
    in_parallel,
    small_step_limit,
)
from harness.host import BUILD  # noqa: E402
from harness.spheres import PREDICTORS, ROUNDING, Law, contact_time, reduced_mass, stiffness_material  # noqa: E402

GAMMA = 1.0  # damping eta = gamma sqrt(m k) with the particle's mass m
STIFFNESS = 2.3e6  # [N/m]
LAW = Law(kn=STIFFNESS, hn=GAMMA * np.sqrt(BALL.mass * STIFFNESS), ks=0.0, hs=0.0, mu=0.0)
TC = contact_time(LAW, reduced_mass(BALL, BALL))
SPEED = 1.0  # v0 [m/s]; the problem is linear, so its value does not matter
LONGEST = 5  # contact times that a run lasts: the lag of up to one and four for the collisions

NEW = cfpm("exact")
METHODS = [STOCK, *map(cfpm, PREDICTORS)]
NT = (3, 6, 10, 25, *HALVED)


def reference(last, count):
    """t* from 0 to last, velocities (t*, particle) over v0, and the largest error of the integrator."""
    program = BUILD / "bin" / "three_particles"
    command = [program, str(GAMMA), repr(last), str(count)]
    process = subprocess.run(command, capture_output=True, text=True, check=True)
    table = np.array([line.split(",") for line in process.stdout.splitlines()[1:]], dtype=float)
    return table[:, 0], table[:, 1:4], table[:, 4].max()


def figure5(velocities):
    """Error of A's velocity if the lag is taken as zero."""
    return 1.0 - velocities[:, 0] / velocities[0, 0]


def rebound_from_resting():
    """Speed of A and C over v0 at t* = 0, closed form: B rests between the two, as a wall would."""
    zeta = 0.5 * GAMMA
    root = np.sqrt(1.0 - zeta**2)
    return np.exp(-zeta * np.arctan2(2.0 * zeta * root, 2.0 * zeta**2 - 1.0) / root)


# final velocities of A, B, C over v0 from an independent program, to the four digits that it printed
EARLIER = {
    0.0: (-0.2985, 0.0, 0.2985),
    0.2: (-0.2872, -0.0113, 0.2984),
    0.4: (-0.2707, -0.0204, 0.2911),
    0.6: (-0.2538, -0.0267, 0.2806),
    0.8: (-0.2390, -0.0303, 0.2692),
}


def tabulate_reference(exhibit):
    """The values to quote, beside those known before."""
    _, exact, _ = reference(max(EARLIER), len(EARLIER))
    known = np.array(list(EARLIER.values()))
    exhibit.text("Final velocities over v0, reference and, in brackets, those of an earlier program:")
    exhibit.table(
        ["t*", "A", "B", "C"],
        [
            [f"{t:g}", *(f"{v:+.4f} ({w:+.4f})" for v, w in zip(row, before))]
            for t, row, before in zip(EARLIER, exact, known)
        ],
    )
    exhibit.text(
        f"""They differ by {np.abs(exact - known).max():.1e} at most. The earlier ones cannot all be right to their last
        digit: their momentum, A + B + C, is off by up to {np.abs(known.sum(axis=1)).max():.0e} (here
        {np.abs(exact.sum(axis=1)).max():.0e}), and at t\\* = 0 the closed form is {rebound_from_resting():.6f}."""
    )


def triplets(t_star, dt):
    """A, B, C for every t* and phase: A touches B where the phase says, in the first step."""
    spheres = []
    cases = [(lag, phase) for lag in t_star for phase in PHASES]
    for centre, (lag, phase) in zip(centres(len(cases)), cases):
        gap_a = SPEED * phase * dt
        gap_c = gap_a + SPEED * lag * TC
        for x, v in ((-DIAMETER - gap_a, SPEED), (0.0, 0.0), (DIAMETER + gap_c, -SPEED)):
            spheres.append(replace(BALL, x=tuple(centre + [x, 0, 0]), v=(v, 0, 0)))
    return spheres


def measure(t_star, method, nt):
    """Final velocities over v0: (t*, phase, particle)."""
    dt = TC / nt
    material = stiffness_material({(1, 1): LAW})
    spheres = triplets(t_star, dt)
    motion, _ = collide(method, "hooke/stiffness", "absolute_damping on", material, spheres, dt, LONGEST * nt + 1)
    x, v = (motion[:, k].reshape(len(t_star), len(PHASES), 3) for k in (0, 3))
    assert np.all(np.diff(x) > DIAMETER), f"{method.name}, nt = {nt}: still in contact"
    return v / SPEED


def plot_figures(t_star, exact, shown):
    """Figs. 4 and 5 of the paper. shown: {nt: velocities (t*, phase, particle)}, drawn as points."""
    figure, (velocity, error) = plt.subplots(1, 2, figsize=(12, 4.5))
    for k, particle in enumerate("ABC"):
        velocity.plot(t_star, exact[:, k], color=f"C{k}", label=f"{particle}, reference")
    error.plot(t_star, figure5(exact), color="C0", label="reference")
    few = slice(0, None, 4)
    for (nt, motion), marker in zip(shown.items(), "os^"):
        mean, scatter = motion.mean(axis=1), motion.std(axis=1)
        points = {"linestyle": "none", "marker": marker, "markersize": 4, "markerfacecolor": "none"}
        for k in range(3):
            label = f"CFPM, nt = {nt}" if k == 0 else None
            velocity.errorbar(t_star[few], mean[few, k], scatter[few, k], color=f"C{k}", label=label, **points)
        error.plot(t_star[few], figure5(mean)[few], color="C0", label=f"CFPM, nt = {nt}", **points)
    velocity.set(ylabel="Normalized Velocity, v/v0 (-)", ylim=(-0.45, 0.45), title="Fig. 4")
    error.set(ylabel="Error of Velocity of Particle A, |v-v0|/v0 (-)", ylim=(0, 0.25), title="Fig. 5")
    for axes in (velocity, error):
        axes.set(xlabel="Normalized Time Step, t* (-)", xlim=(0, 0.85))
        axes.grid(alpha=0.3)
    velocity.legend(fontsize=8, ncol=2, loc="center", bbox_to_anchor=(0.5, 0.65))
    error.legend(fontsize=8)
    return figure


def plot_errors(t_star, errors):
    """Error of A's speed over t*: stock beside CFPM, a band of one standard deviation over the phases."""
    figure, panels = plt.subplots(1, 2, figsize=(12, 4.5), sharey=True)
    for axes, method in zip(panels, (STOCK, NEW)):
        for colour, nt in enumerate((3, 6, 10, 25, 100)):
            mean, scatter = errors[method, nt].mean(axis=1), errors[method, nt].std(axis=1)
            axes.plot(t_star, mean, color=f"C{colour}", label=f"nt = {nt}")
            axes.fill_between(t_star, mean - scatter, mean + scatter, color=f"C{colour}", alpha=0.15, linewidth=0)
        axes.axhline(0.0, color="k", linewidth=0.8)
        axes.set(xlabel="Normalized Time Step, t* (-)", title=method.name, ylim=(-0.5, 1.5))
        axes.grid(alpha=0.3)
    panels[0].set(ylabel="Error of the Speed of Particle A, over |vA(0)| (-)")
    panels[1].legend(fontsize=8, loc="upper right")
    return figure


def write_tables(exhibit, t_star, exact, results, errors):
    allowed = [figure5(reference(1 / nt, 2)[1])[1] for nt in NT]
    exhibit.text("Error of the speed of A in % of its speed at t\\* = 0: mean, and scatter over the phases.")

    def cell(error):
        return f"{100 * error.mean():+.1f} +- {100 * error.std(axis=1).mean():.1f}"

    exhibit.table(
        ["method", *(f"nt = {nt}" for nt in NT)],
        [[m.name, *(cell(errors[m, nt]) for nt in NT)] for m in dict.fromkeys(method for method, _ in errors)]
        + [["Fig. 5 at t* = 1/nt", *(f"{100 * a:.1f}" for a in allowed)]],
    )
    exhibit.text(
        """The last row is what the paper allows a large step: the error made by taking contacts as simultaneous that
        begin a step apart (section 2.2)."""
    )
    size = {job: np.sqrt(np.mean(error**2)) for job, error in errors.items()}
    closer = [nt for nt in NT if size[NEW, nt] < size[STOCK, nt]]
    within = {m.name: [nt for nt, a in zip(NT, allowed) if size[m, nt] <= a] for m in (STOCK, NEW)}
    exhibit.text(
        f"""By the root mean square over lag and phase, {NEW.name} is closer to the reference than velocity Verlet at
        nt = {", ".join(map(str, closer)) or "none"} of {", ".join(map(str, NT))}. Within what Fig. 5 allows:
        {"; ".join(f"{name} at nt = {', '.join(map(str, nts)) or 'none'}" for name, nts in within.items())}."""
    )
    exhibit.csv(
        "velocities",
        ["method", "nt", "t_star", *(f"v{particle}{what}" for particle in "ABC" for what in ("", "_scatter"))],
        [["reference", "", t, *np.column_stack([v, np.zeros(3)]).ravel()] for t, v in zip(t_star, exact)]
        + [
            [method.name, nt, t, *np.column_stack([v.mean(axis=0), v.std(axis=0)]).ravel()]
            for (method, nt), motion in results.items()
            for t, v in zip(t_star, motion)
        ],
    )


def judge(exhibit, exact, reference_error, results):
    closed = rebound_from_resting()
    off = np.abs(np.abs(exact[0]) - [closed, 0.0, closed]).max()
    exhibit.verdict(
        f"at t* = 0 the reference is the closed form {closed:.6f} v0, off by {off:.0e}; its error for all t* is "
        f"estimated at {reference_error:.0e}",
        off <= reference_error,
    )
    # a velocity below v0 is rounded four times a step at most (two kicks, each a product and a sum)
    drift = max(np.abs(motion.sum(axis=2)).max() for motion in results.values())
    allowed = 3 * 4 * LONGEST * max(NT) * ROUNDING
    exhibit.verdict(f"momentum is conserved to rounding: {drift:.0e} v0, allowed {allowed:.0e} v0", drift <= allowed)
    for method in dict.fromkeys(method for method, _ in results):
        errors = [results[method, nt] - exact[:, None] for nt in HALVED]
        size = [np.sqrt(np.mean(error**2)) for error in errors]
        limits, _ = small_step_limit(*(error.mean(axis=1) for error in errors))
        mean, change = small_step_limit(*(error.mean(axis=(0, 1)) for error in errors))
        # C begins at an arbitrary phase of the step for every lag, which leaves a standard error
        bound = change + 3 * limits.std(axis=0, ddof=1) / np.sqrt(len(exact)) + reference_error
        k = np.argmax(np.abs(mean) / bound)
        exhibit.verdict(
            f"{method.name} tends to the reference: from nt = {HALVED[1]} to {HALVED[2]} the rms error falls by "
            f"2^{np.log2(size[1] / size[2]):.2f}; means over the lags, extrapolated to small steps, are off by "
            f"{np.abs(mean[k]):.0e} v0 ({'ABC'[k]}), allowed {bound[k]:.0e} v0",
            np.all(np.abs(mean) <= bound),
        )


def main():
    exhibit = Exhibit("Figures 3-5: collision of three particles", __doc__)
    exhibit.text(
        """Spheres A and C hit B, at rest between them, from both sides with speed v0; C comes late by t\\* contact
        times of a pair. Ice of the paper's Table 1 without tension, damping eta = gamma sqrt(m k), gamma = 1. The
        reference integrates the equations of motion with error control (Boost odeint). The host runs every t\\* at
        16 phases of the step."""
    )
    # lags of 1/prime: whatever nt is, they put C at all phases of the step
    t_star, exact, reference_error = reference(1.0, 1 + (11 if exhibit.quick else 41))
    jobs = [(method, nt) for nt in NT for method in ([STOCK, NEW] if exhibit.quick else METHODS)]
    results = in_parallel(lambda method, nt: measure(t_star, method, nt), jobs, "figure4-5")
    errors = {job: (exact[:, :1] - motion[:, :, 0]) / -exact[0, 0] for job, motion in results.items()}

    exhibit.plot(
        plot_figures(t_star, exact, {nt: results[NEW, nt] for nt in (10, 100)}),
        "figure4-5",
        "Left: final velocities, as Fig. 4. Right: error of A's velocity if the lag is taken as zero, as Fig. 5. "
        f"Points are means over the phases, bars their standard deviations ({NEW.name}).",
    )
    tabulate_reference(exhibit)
    write_tables(exhibit, t_star, exact, results, errors)
    exhibit.plot(
        plot_errors(t_star, errors),
        "error",
        "Error of the speed of A over the lag: mean and a band of one standard deviation over the phases.",
    )
    judge(exhibit, exact, reference_error, results)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
