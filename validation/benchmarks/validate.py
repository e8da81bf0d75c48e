# SPDX-License-Identifier: GPL-2.0-or-later
"""The benchmark tests of Chung and Ooi (2011) for codes of the discrete element method at the level of one impact.

Hertz contacts with tangential springs: stock, predicted forces and predicted impulses over the number of steps per
contact, in both hosts, beside closed forms and, where a spring is loaded and unloaded, small steps.
"""

import itertools
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import paper
from paper import STEPS, TESTS, Runner

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import reference  # noqa: E402, paper has put it on the path
from exhibit import Exhibit  # noqa: E402
from host_collisions import HALVED, PHASES, STOCK, cfpm, in_parallel, small_step_limit  # noqa: E402
from experiment import phase_error  # noqa: E402
from impacts import sliding  # noqa: E402

NT, QUICK_NT = (1, 2, 3, 6, 10, 20, 50), (1, 3, 10)
ROUNDING = 1e-6  # what tests/liggghts/test_impulse.py allows head-on collisions
TURNING = (4, 5, 6, 8)  # tests in which friction turns spheres
REFERENCE_STEPS, QUICK_REFERENCE_STEPS = 2000, 400  # per tc
SHOWN = 3  # nt of the curves
STABLE = 2.015  # nt that rk4 needs for a contact (docs/pair_gran_cfpm.md); below it throws spheres out of the box

VERLET, IMPULSE = Runner("LIGGGHTS", "stock", STOCK), Runner("LIGGGHTS", "impulse", cfpm("impulse"))
GRANULAR_IMPULSE = Runner("LAMMPS", "granular, impulse", "impulse", granular=True)
RUNNERS = (
    VERLET,
    Runner("LIGGGHTS", "exact", cfpm("exact")),
    Runner("LIGGGHTS", "rk4", cfpm("rk4")),
    IMPULSE,
    Runner("LAMMPS", "stock", None),
    Runner("LAMMPS", "rk4", "rk4"),
    Runner("LAMMPS", "granular, stock", None, granular=True),
    Runner("LAMMPS", "granular, exact", "exact", granular=True),
    GRANULAR_IMPULSE,
)
IMPULSES = (IMPULSE, GRANULAR_IMPULSE)
MARKERS = "sodv^<>pP"  # of the RUNNERS


def runners(test):
    return [runner for runner in RUNNERS if runner.has(test)]


def possible(runner, nts):
    return [nt for nt in nts if runner.name != "rk4" or nt > STABLE]


def quick_tests():
    """The first material of each, and two restitutions of test 3."""
    first = {test.number: test.material for test in reversed(TESTS)}
    return [t for t in TESTS if t.material == first[t.number] and t.restitution not in (0.4, 0.6)]


def expected(tests, steps_per_contact):
    """{test: (impacts, 9)}, velocity and surface velocities by spin over the impact speed, and the error."""
    joined = reference.Impacts(
        *(np.concatenate([getattr(t.cases, name) for t in tests]) for name in ("radii", "masses", "velocity", "spins"))
    )
    counts = [len(t.cases) for t in tests]
    laws = [t.law for t in tests for _ in range(len(t.cases))]
    tc = np.repeat([t.tc for t in tests], counts)
    scale = np.repeat([[*3 * [1 / t.speed], *6 * [t.radius / t.speed]] for t in tests], counts, axis=0)
    numbers = (steps_per_contact, steps_per_contact // 2)
    fine, coarse = (scale * reference.final(joined, laws, tc / n, STEPS * n) for n in numbers)
    ends = np.cumsum(counts)[:-1]
    return dict(zip(tests, np.split(fine, ends))), np.abs(fine - coarse).max()


class Findings:
    """outcomes: {(test, runner, nt): Outcome}; references: {test: (impacts, 9)} of tests 4 to 8; error: theirs."""

    def __init__(self, outcomes, references, error):
        self.outcomes, self.references, self.error = outcomes, references, error

    def off(self, test, runner, nt):
        """Velocity and spins over the impact speed, (impacts, phases, 9), on a plane (impacts, phases, 6)."""
        found = self.outcomes[test, runner, nt]
        found = np.concatenate([found.velocity, found.spins.reshape(*found.velocity.shape[:2], 6)], axis=2)
        exact = np.zeros((1, 9))
        exact[0, 2] = test.restitution
        off = found - self.references.get(test, exact)[:, None]
        return off[..., :6] if test.plane else off

    def rms(self, test, runner, nt, columns):
        """Over the phases, the largest of all impacts."""
        return np.sqrt((self.off(test, runner, nt)[..., columns] ** 2).sum(axis=2).mean(axis=1)).max()

    def duration(self, test, runner, nt):
        """Root mean square error of the contact time over tc; of an elastic contact along the normal."""
        return np.sqrt(np.mean((self.outcomes[test, runner, nt].duration / test.tc - 1) ** 2))

    def deepest(self, test, runner, nt):
        return self.outcomes[test, runner, nt].deepest / test.deepest - 1


NORMAL, TANGENTIAL, SPIN = slice(2, 3), slice(0, 2), slice(3, 6)


def tabulate(exhibit, found, tests, nts):
    def table(title, chosen, value, form):
        exhibit.text(title)
        rows = [
            [test, runner, *(f"{value(test, runner, nt):{form}}" if nt in possible(runner, nts) else "-" for nt in nts)]
            for test in chosen
            for runner in runners(test)
        ]
        exhibit.table(["test", "method", *(f"nt = {nt}" for nt in nts)], rows)

    elastic = [test for test in tests if test.number in (1, 2)]
    table(
        """Contact time of the elastic impacts, root mean square error over the phases over 2.868 (m\\*^2/(R\\* E\\*^2
        v))^(1/5):""",
        elastic,
        found.duration,
        ".1e",
    )
    table(
        """Deepest overlap at the end of a step, of all phases, less (15 m\\* v^2/(16 E\\* R\\*^(1/2)))^(2/5), over
        that; the largest force is off by 1.5 times as much:""",
        elastic,
        found.deepest,
        "+.1e",
    )
    table(
        "Restitution, root mean square error over the phases:",
        [test for test in tests if test.number < 4],
        lambda *key: found.rms(*key, NORMAL),
        ".1e",
    )
    table(
        """Tangential velocity after the impact, error over the impact speed (tests 5 to 8: the normal one), root mean
        square over the phases, the largest of all impacts:""",
        [test for test in tests if test.number >= 4],
        lambda *key: found.rms(*key, TANGENTIAL),
        ".2g",
    )
    exhibit.csv(
        "benchmarks",
        ["test", "material", "restitution", "host", "method", "nt", "normal", "tangential", "spin", "time", "overlap"],
        [
            [test.number, test.material.name, test.restitution, runner.host, runner.name, nt]
            + [f"{found.rms(test, runner, nt, part):.3g}" for part in (NORMAL, TANGENTIAL, SPIN)]
            + ([f"{f(test, runner, nt):.3g}" for f in (found.duration, found.deepest)] if test in elastic else ["", ""])
            for test, runner, nt in found.outcomes
        ],
    )


CURVES = {  # of tests: what is on the axes, and how it comes from the tangential velocity
    4: ("angle, degrees", "tangential restitution", lambda t, v: v / np.sin(np.radians(t.varied))),
    5: ("tangential velocity, m/s", "its change over vn", lambda t, v: v - np.array(t.varied) / t.speed),
    6: ("spin, rad/s", "tangential velocity over vn", lambda t, v: v),
    8: ("spin, rad/s", "tangential velocity over vn", lambda t, v: v),
}


def plot(found, tests, nts):
    """Of the first material of each test with CURVES: these at SHOWN steps per contact, and errors over nt."""
    first = {test.number: test for test in reversed(tests) if test.number in CURVES}
    figure, panels = plt.subplots(2, len(first), figsize=(3.6 * len(first), 6.5))
    for (upper, lower), number in zip(panels.T, sorted(first)):
        test = first[number]
        across, along, value = CURVES[number]
        upper.plot(test.varied, value(test, found.references[test][:, 0]), "k-", label="reference")
        for runner in runners(test):
            k = RUNNERS.index(runner)
            curve = value(test, found.outcomes[test, runner, SHOWN].velocity[..., 0].mean(axis=1))
            upper.plot(test.varied, curve, MARKERS[k], color=f"C{k}", markersize=4, label=str(runner))
            own = possible(runner, nts)
            errors = [found.rms(test, runner, nt, TANGENTIAL) for nt in own]
            lower.plot(own, errors, MARKERS[k] + "-", color=f"C{k}", markersize=4)
        scale = "linear" if number == 4 else "log"
        upper.set(xlabel=across, ylabel=along, title=f"test {test}, nt = {SHOWN}", xscale=scale)
        lower.set(xlabel="nt", ylabel="rms error of tangential velocity", xscale="log", yscale="log")
        for axes in (upper, lower):
            axes.grid(alpha=0.3)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.legend(*panels[0, 1].get_legend_handles_labels(), loc="lower center", ncol=len(RUNNERS) + 1, fontsize=7)
    return figure


def judge(exhibit, found, tests, nts):
    for impulse in IMPULSES:
        judge_impulse(exhibit, found, tests, nts, impulse)
    judge_sliding(exhibit, found, tests, nts)
    worst = np.max(
        [
            np.abs(np.delete(found.off(test, runner, nt), 2, axis=-1)).max()
            for test in tests
            if test.number == 7
            for runner in runners(test)
            for nt in possible(runner, nts)
        ]
    )
    exhibit.verdict(
        f"test 7, surfaces that do not slip: with every method neither a tangential velocity nor a change of spin at "
        f"any step, off by {worst:.1e} of the impact speed, allowed {ROUNDING:.0e}",
        worst <= ROUNDING,
    )


def judge_impulse(exhibit, found, tests, nts, impulse):
    normal = [test for test in tests if test.number < 4]
    worst = np.max([np.abs(found.off(t, impulse, nt)[..., 2]).max() for t in normal for nt in nts])
    exhibit.verdict(
        f"{impulse}, tests 1 to 3: restitution of the closed form at every step, off by {worst:.1e} at most, "
        f"allowed {ROUNDING:.0e}",
        worst <= ROUNDING,
    )
    elastic = [test for test in tests if test.number in (1, 2)]
    worst = np.max([found.duration(t, impulse, nt) for t in elastic for nt in nts])
    exhibit.verdict(
        f"{impulse}, tests 1 and 2: contact time of the closed form at every step, off by {worst:.1e} of it, "
        f"allowed {ROUNDING:.0e}",
        worst <= ROUNDING,
    )
    # half a phase from the deepest point the overlap is less by (F/m*) t^2/2, with F d = 1.25 m* v^2 there
    missed = {
        (t, nt): 1.25 * (t.speed / t.deepest * t.tc / nt / len(PHASES) / 2) ** 2 / 2 for t in elastic for nt in nts
    }
    worst = np.max([abs(found.deepest(t, impulse, nt)) / (missed[t, nt] + ROUNDING) for t, nt in missed])
    exhibit.verdict(
        f"{impulse}, tests 1 and 2: deepest overlap of the closed form at every step, within {100 * worst:.0f} % of "
        f"what {len(PHASES)} phases may miss of it ({max(missed.values()):.1e} at nt = {min(nts)})",
        worst <= 1,
    )
    planes = [test for test in tests if test.number >= 4 and test.plane]
    worst = 0.0
    for test in planes:
        rebound = -test.restitution * test.cases.velocity[:, None, 2] / test.speed
        off = [np.abs(found.outcomes[test, impulse, nt].velocity[..., 2] - rebound).max() for nt in nts]
        worst = np.maximum(worst, np.max(off))
    exhibit.verdict(
        f"{impulse}, tests 4 to 6: along the normal of the plane the restitution of the closed form at every step, off "
        f"by {worst:.1e} of the impact speed at most, allowed {ROUNDING:.0e}",
        worst <= ROUNDING,
    )


def judge_sliding(exhibit, found, tests, nts):
    """Tests 4 to 6 where rigid bodies would slip to the end: v - mu (1 + e) vn, the paper's closed form."""
    found_off, fell_short = {impulse: [] for impulse in IMPULSES}, 0.0
    for test in (t for t in tests if t.number in (4, 5, 6)):
        exact = test.speed * found.references[test]
        slides, allowed = sliding(test.cases, test.friction, test.restitution, paper.LONGEST * test.tc, exact)
        rigid = test.cases.velocity[slides, :2].copy()
        direction = np.sign(rigid[:, 0] - test.radius * test.cases.spins[slides, 0, 1])
        most = test.friction * (1 + test.restitution) * -test.cases.velocity[slides, 2]
        rigid[:, 0] -= direction * most
        fell_short = max(fell_short, (np.abs(exact[slides, 0] - rigid[:, 0]) / most).max())
        for impulse, nt in itertools.product(IMPULSES, nts):
            off = np.linalg.norm(found.off(test, impulse, nt)[slides, :, :2], axis=2).max(axis=1)
            found_off[impulse] += zip(off, allowed / test.speed + found.error + ROUNDING)
    exhibit.text(
        f"""Where rigid bodies would slip to the end, tan(angle) > 3.5 mu (1 + e), their tangential velocity changes by
        mu (1 + e) vn; the reference, whose spring has to be loaded first, is off that by {100 * fell_short:.1g} % of it
        at most."""
    )
    for impulse, pairs in found_off.items():
        worst = max(pairs, key=lambda pair: pair[0] / pair[1])
        exhibit.verdict(
            f"{impulse}, tests 4 to 6 in gross sliding: at every step the tangential velocity is off by no more than "
            f"friction falls short of mu (1 + e) vn while the spring is loaded, and than the slip turns as the lever "
            f"of the spin changes; off by {worst[0]:.1e} of the impact speed where it matters most, allowed "
            f"{worst[1]:.1e}",
            worst[0] <= worst[1],
        )


def judge_limits(exhibit, found, tests):
    for runner in RUNNERS:
        limits = []
        for test in (t for t in tests if runner in runners(t)):
            if runner.host == "LAMMPS" and runner.stock and test.number in TURNING:
                continue  # the lever of friction is the radius there
            samples = [found.off(test, runner, nt) for nt in HALVED]
            order = 1 if runner.stock else paper.HERTZ.p / 2
            limit, change = small_step_limit(*(s.mean(axis=1) for s in samples), order)
            _, middle, fine = (phase_error(np.moveaxis(s, 1, 2)) for s in samples)
            bound = change + (2**order * fine + middle) / (2**order - 1) + found.error
            limits.append((np.abs(limit).max(), bound.max()))
        error, bound = max(limits, key=lambda pair: pair[0] / pair[1])
        exhibit.verdict(
            f"{runner} tends to the closed forms and the reference for small steps: extrapolated, off by {error:.1e} "
            f"where it matters most, allowed {bound:.1e}",
            error <= bound,
        )


def main():
    exhibit = Exhibit("Benchmarks of Chung and Ooi", __doc__)
    tests = quick_tests() if exhibit.quick else TESTS
    nts = QUICK_NT if exhibit.quick else NT
    exhibit.text(
        """Tests: 1 elastic impact of two spheres, 2 of a sphere and a rigid plane, along the normal; 3 normal impacts
        with restitutions of the deck, limitForce off; 4 oblique impacts on a plane of one speed at angles from the
        normal, 5 of one normal velocity with tangential ones, 6 with spins; 7 two spheres with opposite spins; 8 a
        spinning sphere and one of five times its radius and 125,000 times its mass. In 4 to 8 contacts are without
        tension, so that friction never has more than mu (1 + e) of the momentum, and the deck's coefficient is such
        that e comes out. No tangential dashpot. Materials, sizes and velocities: paper.py. nt is the number of steps in
        the contact time tc of an undamped impact at the test's speed along the normal; every impact is run with 16
        phases of the step in which it begins; rk4 only where a contact is stable. LAMMPS's pair_style gran has another
        damping for Hertz contacts, hence the elastic tests only; its pair_style granular has LIGGGHTS's, tsuji. The
        slip of both is that of surfaces at the radius, so stock tends to something else where spheres turn."""
    )
    oblique = [test for test in tests if test.number >= 4]
    references, error = expected(oblique, QUICK_REFERENCE_STEPS if exhibit.quick else REFERENCE_STEPS)
    exhibit.text(
        f"""Tests 1, 2, 3 and 7 have closed forms, 4 to 6 where bodies slide throughout. For the rest of 4 to 8, where
        the paper shows results of other codes, the reference is that of oblique impacts (oblique/reference.py): Runge
        and Kutta's method with tiny steps; halving them changes it by {error:.1e} of the impact speed at most."""
    )
    all_nts = nts if exhibit.quick else [*nts, *(nt for nt in HALVED if nt not in nts)]
    jobs = [(test, r, nt) for nt in all_nts for test in tests for r in runners(test) if nt in possible(r, all_nts)]
    found = Findings(in_parallel(paper.measure, jobs, "benchmarks"), references, error)
    tabulate(exhibit, found, tests, nts)
    exhibit.plot(plot(found, tests, nts), "oblique", "First materials: means over the phases, and errors.")
    judge(exhibit, found, tests, nts)
    if not exhibit.quick:
        judge_limits(exhibit, found, tests)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
