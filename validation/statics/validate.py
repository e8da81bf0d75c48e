# SPDX-License-Identifier: GPL-2.0-or-later
"""States at rest: how well they stay there, over the time step, in the stock LIGGGHTS and with the predictors.

Settled beds whose gravity is tilted, a block on an incline around the angle of friction, a sphere and a column on the
floor, and the energy of beds without damping and friction. What can be derived for them is in expected.py.
"""

import sys
from pathlib import Path

import expected
import matplotlib.pyplot as plt
import numpy as np
import states
from states import COLUMN, DIAMETER, SINK, STOCK, TC, Case, Method

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from averages import mean_and_error  # noqa: E402
from cases import number  # noqa: E402
from exhibit import Exhibit  # noqa: E402

STOCK_NT = (5, 10, 30)
NT = (1, 2, 3, 5, 10, 30)
QUICK_STOCK_NT = (5, 30)
QUICK_NT = (2, 3, 10)
ANGLES = (5, 10)  # of the beds [degrees]
TILTED = 0.5  # [s]
SEEDS = {"full": 4, "quick": 1}

ABOVE = 1.05  # tangent of an incline over mu
BELOW = (0.8, 0.85, 0.9, 0.95)
SLIDING = 0.2  # [s]

STEPS, QUICK_STEPS = 20 * 5003, 20 * 503  # of spheres at rest; primes between snapshots, to see any cycle
RESTLESS = 1e-3  # of mg/k
ELASTIC = 1000 * TC  # [s]


def make_plan(methods, quick):
    """{method: all its nt}"""
    stock, predicted = (QUICK_STOCK_NT, QUICK_NT) if quick else (STOCK_NT, NT)
    return {method: stock if method == STOCK else predicted for method in methods}


def second_half(motion):
    return len(motion.time) // 2


def rate(motion, values):
    """Mean change per time in the second half, when nothing is left of the start."""
    half = second_half(motion)
    return (values[-1] - values[half]) / (motion.time[-1] - motion.time[half])


def unsteady(motion):
    """Whether the spheres of a sliding block move against each other, by more than a thousandth of its speed."""
    v = motion.v[second_half(motion) :]
    return np.ptp(v, axis=1).max() > 1e-3 * np.abs(v).max() or np.abs(v[:, :, 1:]).max() > 1e-3 * np.abs(v).max()


def curves_over_nt(axes, plan, points, derived=None):
    """For each method points(method, nt) = (value, error), NaN for none; derived(method, nt): a line."""
    for k, (method, nts) in enumerate(plan.items()):
        found = [(nt, *points(method, nt)) for nt in nts]
        found = np.array([(nt * 1.02**k, y, e) for nt, y, e in found if np.isfinite(y)]).reshape(-1, 3)
        x, y, error = np.nan_to_num(found).T
        axes.errorbar(x, y, error, fmt="sod^v"[k % 5], color=f"C{k}", label=str(method))
        if derived and expected.derived(method):
            dense = np.geomspace(min(nts), max(nts), 200)
            axes.plot(dense, [derived(method, nt) for nt in dense], color=f"C{k}", linewidth=0.8)
    axes.set(xscale="log", xlabel="nt", xticks=NT, xticklabels=NT)
    axes.minorticks_off()
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3)


def tilt_beds(exhibit, plan, beds):
    angles = ANGLES[-1:] if exhibit.quick else ANGLES
    cases = [Case(m, nt, angle) for m, nts in plan.items() for nt in nts for angle in angles]
    jobs = {(case, k): (case, case.run(bed, TILTED)) for k, bed in enumerate(beds) for case in cases}
    motions = states.execute(jobs, exhibit.runs, "statics, tilted beds")
    own = {case: [motions[case, k] for k in range(len(beds))] for case in cases}
    creep = {case: over_beds(own[case], lambda motion: motion.downhill()[-1] / DIAMETER) for case in cases}
    tell_beds(exhibit, own, creep, angles, len(beds))
    figure, panels = plt.subplots(1, len(angles), figsize=(5.5 * len(angles), 4.2), sharey=True, squeeze=False)
    for axes, angle in zip(panels[0], angles):
        curves_over_nt(axes, plan, lambda m, nt, angle=angle: mean_and_error(creep[Case(m, nt, angle)]))
        axes.set(title=f"tilted by {angle} degrees", yscale="log")
    panels[0, 0].set(ylabel=f"Creep in {TILTED:g} s, diameters")
    exhibit.plot(
        figure, "creep", f"Mean way downhill in {TILTED:g} s after the tilt, standard errors over {len(beds)} beds."
    )


def told_mean(values, form):
    mean, error = mean_and_error(values)
    return number(mean, form, error)


def over_beds(motions, quantity):
    """NaN where a run blew up."""
    return np.array([np.nan if motion.blown_up else quantity(motion) for motion in motions])


def tell_beds(exhibit, motions, creep, angles, count):
    smallest = max(case.nt for case in creep if case.method == STOCK)
    exhibit.text(
        f"""**Tilted beds.** Beds of in.packing, settled by the stock style at nt = {states.outlet.BED_NT}, rest for
        0.1 s with the method and step under test; then gravity is tilted, for {TILTED:g} s. The sides are periodic.
        Creep: mean way downhill of all spheres in diameters, mean and standard error over {count} beds; beside it the
        difference to the stock style at nt = {smallest}, paired by bed, and the root mean square speed at the end. A
        run blew up if the host lost spheres or they moved faster than gravity can have made them; such runs are left
        out."""
    )
    late = {case: over_beds(own, lambda m: rate(m, m.downhill()) / DIAMETER) for case, own in motions.items()}
    speed = {case: over_beds(own, final_speed) for case, own in motions.items()}
    blown = {case: np.count_nonzero(np.isnan(values)) for case, values in creep.items()}
    rows = []
    for method, nt in dict.fromkeys((case.method, case.nt) for case in creep):
        own = [Case(method, nt, angle) for angle in angles]
        row = [method, nt, f"{sum(blown[case] for case in own)} of {count * len(own)}"]
        for case in own:
            difference = creep[case] - creep[Case(STOCK, smallest, case.angle)]
            row += [told_mean(creep[case], ".4f"), told_mean(difference, "+.4f")]
            row.append(number(1000 * mean_and_error(speed[case])[0], ".2g"))
        rows.append(row)
    names = [f"{angle} degrees: {name}" for angle in angles for name in ("creep", "minus stock's", "speed, mm/s")]
    exhibit.table(["method", "nt", "blown up", *names], rows)
    found = {"creep": creep, "late_per_s": late, "speed_m_per_s": speed}
    columns = [f"{name}{end}" for name in found for end in ("", "_error")]
    exhibit.csv(
        "tilted",
        ["method", "nt", "angle", "runs", "blown_up", *columns],
        [
            [*map(str, case), count, blown[case]]
            + [f"{x:.5g}" for values in found.values() for x in mean_and_error(values[case])]
            for case in creep
        ],
    )


def final_speed(motion):
    """Root mean square [m/s]."""
    return np.sqrt((motion.v[-1] ** 2).sum(axis=1).mean())


def slide_block(exhibit, plan):
    below = BELOW[-1:] if exhibit.quick else BELOW
    start = states.write_block(exhibit.out / "block.data")
    inclines = {part: expected.incline(part) for part in (*below, ABOVE)}
    cases = {
        (m, nt, part): Case(m, nt, angle) for m, nts in plan.items() for nt in nts for part, angle in inclines.items()
    }
    jobs = {key: (case, case.run(start, SLIDING, rest=0.02, bond=states.BOND)) for key, case in cases.items()}
    motions = states.execute(jobs, exhibit.runs, "statics, blocks")
    speed, acceleration, shaking = {}, {}, set()
    for key, motion in motions.items():
        if motion.blown_up:
            continue
        velocity = motion.v[:, :, 0].mean(axis=1)
        if key[2] == ABOVE:
            acceleration[key[:2]] = rate(motion, velocity)
            if unsteady(motion):
                shaking.add(key)
        else:
            speed[key] = rate(motion, motion.downhill())
            if expected.derived(key[0]) and abs(velocity[-1] - speed[key]) > 2 * expected.creep_tolerance(cases[key]):
                shaking.add(key)
    tell_block(exhibit, plan, below, speed, acceleration, shaking)
    judge_block(exhibit, cases, {k: v for k, v in speed.items() if k not in shaking}, acceleration, shaking)
    figure = plot_creep([method for method in plan if method != STOCK], speed)
    exhibit.plot(figure, "block", "Creep of a block below the angle of friction; lines: derived.")


def plot_creep(methods, speed):
    figure, axes = plt.subplots(figsize=(6.5, 4.2))
    dense = np.linspace(min(BELOW), 1, 201)[:-1]
    for k, nt in enumerate(NT):
        for j, method in enumerate(methods):
            parts = [part for part in BELOW if (method, nt, part) in speed]
            if not parts:
                continue
            found = [speed[method, nt, part] / DIAMETER for part in parts]
            axes.plot(parts, found, "od^v"[j % 4], color=f"C{k}", label=f"{method}, nt = {nt}")
            if expected.derived(method):
                speeds = [expected.creep_speeds(Case(method, nt, expected.incline(part))) for part in dense]
                line = [max(own, default=np.nan) / DIAMETER for own in speeds]
                axes.plot(dense, line, color=f"C{k}", linewidth=0.8)
    axes.set(xlabel="Tangent of the incline over mu", ylabel="Creep, diameters per second")
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3)
    return figure


def tell_block(exhibit, plan, below, speed, acceleration, shaking):
    exhibit.text(
        f"""**A block on an incline.** A single sphere would roll: no fix of the host holds the spin alone, and its
        rigid bodies have integrators of their own. Piles roll as gears. So the block is a row of {states.ROW} spheres
        along the slope that the periodic side closes to a ring: pressed together with {states.PRESSED} weights, they
        cannot all turn the same way, and the friction between them holds far more than the floor's can ask for. The
        weight rests on the floor alone. Contacts of the row have {states.BOND:g} of the stiffness of the floor's, so
        that it is the floor that the step has to resolve. An incline whose tangent is below mu = {states.MU:g} should
        hold the block; above it should slide with g (sin a - mu cos a). Creep in diameters per second over the last
        {SLIDING / 2:g} s, and in brackets as derived (expected.py); holds to: the tangent over mu from which on it
        creeps, derived. Shakes: no steady state, as the speed at the end is not the mean one, or the spheres of a
        sliding block move against each other."""
    )
    wanted = expected.sliding_acceleration(expected.incline(ABOVE))
    rows = []
    for method, nts in plan.items():
        for nt in nts:
            held = f"{expected.friction_held(Case(method, nt)):.3f}" if expected.derived(method) else "-"
            creep = [told_creep(Case(method, nt, expected.incline(p)), speed.get((method, nt, p))) for p in below]
            creep = [f"{told}, shakes" if (method, nt, p) in shaking else told for p, told in zip(below, creep)]
            found = acceleration.get((method, nt))
            sliding = "blew up" if found is None else f"{found / wanted - 1:+.1e}"
            if (method, nt, ABOVE) in shaking:
                sliding += ", shakes"
            rows.append([method, nt, held, *creep, sliding])
    header = [*(f"creep at {part:g} mu" for part in below), f"acceleration at {ABOVE:g} mu, error"]
    exhibit.table(["method", "nt", "holds to", *header], rows)
    exhibit.csv(
        "block",
        ["method", "nt", "part_of_mu", "creep_m_per_s", "acceleration_m_per_s2"],
        [[*key, f"{value:.10g}", ""] for key, value in speed.items()]
        + [[*key, ABOVE, "", f"{value:.10g}"] for key, value in acceleration.items()],
    )


def told_creep(case, speed):
    if speed is None:
        return "blew up"
    told = f"{speed / DIAMETER:.2e}"
    if not expected.derived(case.method):
        return told
    return f"{told} ({' or '.join(f'{x / DIAMETER:.2e}' if x else '0' for x in expected.creep_speeds(case))})"


def judge_block(exhibit, cases, speed, acceleration, shaking):
    """Measured and derived are apart by no more than rounding."""
    off = {}
    for key, measured in speed.items():
        case = cases[key]
        if speeds := expected.creep_speeds(case) if expected.derived(case.method) else []:
            off[key] = min(abs(measured - wanted) for wanted in speeds), expected.creep_tolerance(case)
    worst = max(off, key=lambda key: off[key][0] / off[key][1])
    exhibit.verdict(
        "below the angle of friction a block that does not shake creeps as derived, or holds: off by "
        f"{off[worst][0]:.1e} m/s at most ({worst[0]}, nt = {worst[1]}, {worst[2]:g} mu), allowed "
        f"{off[worst][1]:.1e}",
        all(error <= allowed for error, allowed in off.values()),
    )
    wanted = expected.sliding_acceleration(expected.incline(ABOVE))
    off = {
        key: (abs(a - wanted), expected.acceleration_tolerance(cases[*key, ABOVE]))
        for key, a in acceleration.items()
        if expected.derived(key[0])
        and expected.growth(cases[*key, ABOVE], expected.BETWEEN_TWO) < 1
        and (*key, ABOVE) not in shaking
    }
    worst = max(off, key=lambda key: off[key][0] / off[key][1])
    exhibit.verdict(
        f"above it the block accelerates by g (sin a - mu cos a) = {wanted:.4f} m/s2: off by {off[worst][0]:.1e} at "
        f"most ({worst[0]}, nt = {worst[1]}), allowed {off[worst][1]:.1e}",
        all(error <= allowed for error, allowed in off.values()),
    )


def rest_columns(exhibit, plan):
    steps = QUICK_STEPS if exhibit.quick else STEPS
    start = states.write_columns(exhibit.out / "columns.data")
    cases = [Case(m, nt) for m, nts in plan.items() for nt in nts]
    jobs = {case: (case, case.run(start, steps * case.dt, rest=0)) for case in cases}
    motions = states.execute(jobs, exhibit.runs, "statics, columns")
    overlaps, drift = {}, {}
    for case, motion in motions.items():
        if not motion.blown_up:
            late = slice(second_half(motion), None)
            heights = motion.x[late, :, 2]
            overlaps[case] = states.overlaps(heights) / SINK
            drift[case] = *np.split(np.ptp(heights, axis=0) / DIAMETER, [1]), np.abs(motion.v[late, 1:, 2])
    tell_columns(exhibit, cases, overlaps, drift, steps)
    judge_columns(exhibit, cases, overlaps, steps)
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
    for axes, title, contact, load in (
        (panels[0], "sphere on the floor", 0, 1),
        (panels[1], "lowest pair in the column", 2, COLUMN - 1),
    ):

        def points(method, nt, contact=contact, load=load):
            found = overlaps.get(Case(method, nt))
            return (np.nan, np.nan) if found is None else (found[:, contact].mean() / load, 0.0)

        def derived(method, nt, contact=contact, load=load):
            return expected.column_overlaps(Case(method, nt))[contact] / load

        curves_over_nt(axes, plan, points, derived)
        axes.set(title=title)
    panels[0].set(ylabel="Overlap over its static load/k")
    exhibit.plot(figure, "overlaps", f"Overlaps at rest, mean over the last {steps // 2} steps; lines: derived.")


def tell_columns(exhibit, cases, overlaps, drift, steps):
    exhibit.text(
        f"""**Spheres at rest.** A sphere on the floor and a column of {COLUMN} start with the overlaps of small
        steps, mg/k and its multiples, and are left alone for {steps} steps. Overlaps in these units at the end, and
        in brackets what follows from the method for a state at rest; drift: the largest range of a height during the
        second half, in diameters; speed: the largest in that time. Growth: of a disturbance of the column, a factor
        per step, derived; above 1 the column cannot rest. A column that does not may swing from step to step: with
        stock in positions and the velocities of half steps, with predicted forces in velocities alone, as a step that
        turns v around leaves x."""
    )
    names = ["sphere", "column, floor", "lowest pair", "highest pair"]
    which = [0, 1, 2, -1]
    load = np.array([1, COLUMN, COLUMN - 1, 1])
    rows = []
    for case in cases:
        derived = expected.derived(case.method)
        grows = f"{expected.growth(case, expected.column_felt(COLUMN)):.4f}" if derived else "-"
        if case not in overlaps:
            rows.append([case.method, case.nt, grows, *len(which) * ["blew up"], "-", "-", "-"])
            continue
        told = [f"{x:.4f}" for x in overlaps[case][-1, which] / load]
        if derived:
            told = [f"{x} ({y:.4f})" for x, y in zip(told, expected.column_overlaps(case)[which] / load)]
        rows.append([case.method, case.nt, grows, *told, *(f"{x.max():.1e}" for x in drift[case])])
    header = ["method", "nt", "growth", *names, "drift, sphere", "drift, column", "speed, m/s"]
    exhibit.table(header, rows)
    exhibit.csv(
        "columns",
        ["method", "nt", "drift_sphere", "drift_column", "speed_m_per_s", "sphere"]
        + [f"contact_{k}" for k in range(COLUMN)],
        [
            [c.method, c.nt, *(f"{x.max():.3g}" for x in drift[c]), *(f"{x:.10g}" for x in o[-1])]
            for c, o in overlaps.items()
        ],
    )


def judge_columns(exhibit, cases, overlaps, steps):
    derived = [case for case in cases if expected.derived(case.method)]
    steady = [case for case in derived if expected.growth(case, expected.column_felt(COLUMN)) < 1]
    restless = [case for case in derived if case not in steady]
    away = {case: distance_from_rest(case, overlaps) for case in derived}
    off = {case: (away[case][-1], expected.column_tolerance(case, steps)) for case in steady}
    worst = max(off, key=lambda case: off[case][0] / off[case][1])
    exhibit.verdict(
        f"where the column can rest ({names_of(steady)}), all overlaps are as derived: off by "
        f"{off[worst][0]:.1e} mg/k at most ({worst.method}, nt = {worst.nt}), allowed {off[worst][1]:.1e}",
        all(error <= allowed for error, allowed in off.values()),
    )
    # rounding, 1e-9 mg/k, grows until a contact or its prediction is clamped: after few of the steps
    if restless:
        largest = {case: away[case].max() for case in restless}
        least = min(restless, key=largest.get)
        exhibit.verdict(
            f"where it cannot ({names_of(restless)}), it does not: off by {largest[least]:.1e} mg/k at least "
            f"({least.method}, nt = {least.nt}), more than {RESTLESS:g}",
            largest[least] > RESTLESS,
        )


def names_of(cases):
    nts = {case.method: [other.nt for other in cases if other.method == case.method] for case in cases}
    return "; ".join(f"{method}, nt = {', '.join(map(str, own))}" for method, own in nts.items())


def distance_from_rest(case, overlaps):
    """Of the overlaps, the largest of them at each time of the second half, in mg/k."""
    if case not in overlaps:
        return np.array([np.inf])
    return np.abs(overlaps[case] - expected.column_overlaps(case)).max(axis=1)


def keep_energy(exhibit, plan, beds):
    cases = [Case(m, nt) for m, nts in plan.items() for nt in nts]
    jobs = {
        (case, k): (case, case.run(bed, ELASTIC, rest=0, elastic=1)) for k, bed in enumerate(beds) for case in cases
    }
    motions = states.execute(jobs, exhibit.runs, "statics, elastic beds")
    smallest = Case(STOCK, max(plan[STOCK]))
    unit = []  # for each bed
    for k in range(len(beds)):
        reference = motions[smallest, k]
        unit.append(reference.kinetic()[second_half(reference) :].mean())
    drifts, blown = {}, {}
    for case in cases:
        blown[case] = sum(motions[case, k].run.blown_up for k in range(len(beds)))
        drifts[case] = []
        for k, bed in enumerate(beds):
            if not motions[case, k].run.blown_up:
                energy = states.total_energy(motions[case, k], states.box_side(bed))
                drifts[case].append(100 * (energy - energy[0]) / unit[k])
    tell_energy(exhibit, drifts, blown, np.mean(unit), smallest)
    plot_energy(exhibit, plan, drifts, np.linspace(0, ELASTIC / TC, len(motions[smallest, 0].time)))


def tell_energy(exhibit, drifts, blown, unit, smallest):
    exhibit.text(
        f"""**Beds without damping and friction.** The contacts of the same beds lose their damping and friction: the
        spheres slide into denser places and stay in motion. Kinetic energy, that of the height and the elastic one of
        all contacts should not change together. Drift after {ELASTIC / TC:g} tc in percent of the kinetic energy that
        the stock style has at nt = {smallest.nt} in the second half of that time ({unit:.3g} J in the mean), mean and
        standard error over the beds. Blown up: the host lost spheres."""
    )
    ends = {case: mean_and_error([d[-1] for d in own]) for case, own in drifts.items()}
    rows = [
        [case.method, case.nt, f"{blown[case]} of {blown[case] + len(drifts[case])}"]
        + [number(mean, "+.3g"), number(error, ".2g")]
        for case, (mean, error) in ends.items()
    ]
    exhibit.table(["method", "nt", "blown up", "energy drift, %", "standard error"], rows)
    exhibit.csv(
        "energy",
        ["method", "nt", "blown_up", "drift_percent", "drift_error"],
        [[case.method, case.nt, blown[case], *(f"{x:.5g}" for x in ends[case])] for case in drifts],
    )


def plot_energy(exhibit, plan, drifts, time):
    figure, panels = plt.subplots(1, len(plan), figsize=(5.5 * len(plan), 4.2), sharey=True, squeeze=False)
    for axes, (method, nts) in zip(panels[0], plan.items()):
        for k, nt in enumerate(NT):
            if own := drifts.get(Case(method, nt)):
                axes.plot(time, np.mean(own, axis=0), color=f"C{k}", linewidth=1.2, label=f"nt = {nt}")
        axes.set(title=str(method), xlabel="Time, tc")
        axes.set_yscale("symlog", linthresh=1)
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    panels[0, 0].set(ylabel="Drift of the energy, % of the kinetic")
    figure.tight_layout()
    exhibit.plot(figure, "energy", "Energy of beds without damping and friction over time, mean over the beds.")


def add_arguments(parser):
    parser.add_argument("--predict", nargs="+", default=["exact", "impulse"], help="predictors beside the stock style")
    parser.add_argument("--seeds", type=int, help="beds (default {full}, quick {quick})".format(**SEEDS))


def main():
    exhibit = Exhibit("States at rest", __doc__, add_arguments)
    methods = [STOCK, *(Method(predict) for predict in exhibit.arguments.predict)]
    plan = make_plan(methods, exhibit.quick)
    beds = states.beds(exhibit.arguments.seeds or SEEDS["quick" if exhibit.quick else "full"], exhibit)
    exhibit.text(
        """Contacts of in.packing in LIGGGHTS: linear, damped with gamma = 1, mu = 0.3, with the tangential dashpot.
        Stock is velocity Verlet. nt is that of a pair; a contact with the floor lasts sqrt(2) times as long."""
    )
    tilt_beds(exhibit, plan, beds)
    slide_block(exhibit, plan)
    rest_columns(exhibit, plan)
    keep_energy(exhibit, plan, beds)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
