# SPDX-License-Identifier: GPL-2.0-or-later
"""Why the packing ratio needs far smaller steps in the paper than here: other readings of its Fig. 8.

The paper calls the second-order Adams-Bashforth method conventional; the hosts have velocity Verlet. Here the stock
LAMMPS settles the same beds with Adams-Bashforth, its own styles and a small integrator for its fix python/move. The
paper does not say which mass its damping is made of either: two other readings are run. Runs of the exhibit "packing"
are used where they are there.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "packing")]
import ensemble  # noqa: E402
import packing  # noqa: E402
from averages import difference, mean_and_error  # noqa: E402
from exhibit import Exhibit  # noqa: E402

HOST = "lammps"  # whose stock style has the paper's law of friction
METHODS = {"Adams-Bashforth": "stock", "velocity Verlet": "stock", "cfpm exact": "cfpm"}
NT = (3, 6, 10, 30, 100)
LARGE = 300  # for the method of which the paper says that it needs it
QUICK_NT = (6, 30)
DAMPING = {  # eta over that of the decks, gamma sqrt(m k)
    "gamma sqrt(m* k)": np.sqrt(0.5),
    "2 gamma sqrt(m* k)": np.sqrt(2.0),
}
DAMPING_NT = (3, 6, 30)
ROUGH = 30
SIGMA = 2


def changed_deck(folder, name, changes):
    """The packing deck with some of its words replaced."""
    text = packing.DECKS[HOST].read_text()
    for old, new in changes.items():
        assert text.count(old) == 1, f"the deck has '{old}' {text.count(old)} times"
        text = text.replace(old, new)
    folder.mkdir(parents=True, exist_ok=True)
    deck = folder / f"in.{name}"
    deck.write_text(text)
    return deck


def adams_bashforth_deck(folder):
    method = (HERE / "adams_bashforth.py").read_text()
    return changed_deck(
        folder,
        "packing-adams-bashforth",
        {
            "units           si\n": f'python AdamsBashforth source """\n{method}"""\nunits           si\n',
            "fix integrate all nve/sphere": "fix integrate all python/move AdamsBashforth",
            "atom_modify     map array": "atom_modify     map array sort 0 0",
        },
    )


def damping_deck(folder, factor):
    words = "variable eta      equal sqrt(v_m*v_kn)"
    return changed_deck(
        folder, f"packing-damping-{factor:.3f}", {words: words.replace("equal ", f"equal {factor:.15g}*")}
    )


def run_of(deck, style, nt, seed):
    variables = {"style": style, "nt": nt, "seed": seed, "dashpot": "on"}
    if style != "stock":
        variables["predict"] = "exact"
    return ensemble.Run(HOST, deck, variables, cost=nt)


def settle(cases, seeds, folder):
    """{case: final packing ratios, NaN where a run blew up}. cases: {case: (deck, style, nt)}, starts one by one."""
    jobs = [(case, run_of(*what, seed)) for seed in packing.primes(seeds) for case, what in cases.items()]
    ratios = {case: [] for case in cases}
    for (case, _), result in zip(jobs, ensemble.run([run for _, run in jobs], folder, "readings, runs")):
        bed = packing.read(result)
        ratios[case].append(np.nan if bed.blown_up else bed.ratio[-1])
    return {case: np.array(values) for case, values in ratios.items()}


def text_of(values):
    blown_up = np.count_nonzero(np.isnan(values))
    mean, error = mean_and_error(values)
    what = [f"{mean:.4f} +- {error:.4f}"] if np.isfinite(error) else []
    return ", ".join(what + [f"{blown_up} of {len(values)} blew up"] * (blown_up > 0))


def plot(ratios, nts):
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for k, method in enumerate(METHODS):
        points = [(nt * 1.04 ** (k - 1), ratios[method, nt]) for nt in nts if (method, nt) in ratios]
        points = [(nt, *mean_and_error(values)) for nt, values in points if np.isfinite(values).all()]
        axes.errorbar(*np.transpose(points), fmt="sod"[k], capsize=3, label=method)
    axes.set(xscale="log", xlabel="nt", ylabel="Packing ratio", xlim=(1, 10000), ylim=(0.55, 0.62))
    axes.legend()
    axes.grid(alpha=0.3)
    figure.tight_layout()
    return figure


def judge(exhibit, ratios, nts):
    """How far each method is from small steps of velocity Verlet, which the paper's conventional results tend to."""
    small = ratios["velocity Verlet", max(nts)]
    off = {(method, nt): difference(ratios[method, nt], small) for method in METHODS for nt in nts}
    rows = []
    for method in METHODS:
        good = {nt: abs(off[method, nt][0]) <= SIGMA * off[method, nt][1] for nt in nts}
        lasting = [nt for nt in nts if all(good[other] for other in nts if other >= nt)]
        rows.append([method, *(f"{d:+.2f} +- {error:.2f}" for d, error in (off[method, nt] for nt in nts)), min(lasting, default="-")])
    exhibit.text(
        f"""The same in percent of velocity Verlet's at nt = {max(nts)}, and the nt from which on {SIGMA} standard errors
        do not tell them apart. The paper's Fig. 8 is constant from 300 on for its conventional method, from 30 on for
        the new one."""
    )
    exhibit.table(["method", *(f"nt = {nt}" for nt in nts), "alike from nt ="], rows)
    rough = [nt for nt in nts if nt <= ROUGH and np.isfinite(off["Adams-Bashforth", nt][0])]
    worst, error = max((off["Adams-Bashforth", nt] for nt in rough), key=lambda found: found[0])
    exhibit.verdict(
        f"Adams-Bashforth packs up to {worst:.1f} +- {error:.1f} % too densely at nt <= {ROUGH}: with it, a large step "
        "shows as in the paper's Fig. 8",
        worst > (0 if exhibit.quick else SIGMA * error),
    )


def add_arguments(parser):
    parser.add_argument("--seeds", type=int, help="random starts of each case (default 8, quick 2)")


def main():
    exhibit = Exhibit("The paper's Fig. 8 read again: conventional method and damping", __doc__, add_arguments)
    seeds = exhibit.arguments.seeds or (2 if exhibit.quick else 8)
    nts = QUICK_NT if exhibit.quick else (*NT, LARGE)
    adams_bashforth = adams_bashforth_deck(exhibit.out)
    decks = {"Adams-Bashforth": adams_bashforth}
    cases = {
        (method, nt): (decks.get(method, packing.DECKS[HOST]), style, nt)
        for nt in nts
        for method, style in METHODS.items()
    }
    if not exhibit.quick:
        cases |= {
            (reading, style, nt): (damping_deck(exhibit.out, factor), style, nt)
            for reading, factor in DAMPING.items()
            for style in ("stock", "cfpm")
            for nt in DAMPING_NT
        }
    ratios = settle(cases, seeds, exhibit.runs)

    exhibit.text(
        f"""Packing ratio, mean and standard error over {seeds} random starts, stock LAMMPS with the paper's law of
        friction. The paper compares its method with Adams-Bashforth; here all three start from the same places."""
    )
    exhibit.table(
        ["method", *(f"nt = {nt}" for nt in nts)],
        [[method, *(text_of(ratios[method, nt]) for nt in nts)] for method in METHODS],
    )
    exhibit.plot(plot(ratios, nts), "ratio", "Packing ratio over nt on the axes of the paper's Fig. 8.")
    if not exhibit.quick:
        exhibit.text(
            """Damping: the decks read the paper's eta as gamma sqrt(m k) with the particle's mass, which fits its
            Figs 3-5. With either other reading the conventional method of the host, velocity Verlet, and cfpm:"""
        )
        exhibit.table(
            ["eta", "method", *(f"nt = {nt}" for nt in DAMPING_NT)],
            [
                [reading, method, *(text_of(ratios[reading, style, nt]) for nt in DAMPING_NT)]
                for reading in DAMPING
                for method, style in (("velocity Verlet", "stock"), ("cfpm exact", "cfpm"))
            ],
        )
    exhibit.csv(
        "readings",
        ["case", "nt", "runs", "blown_up", "ratio", "error"],
        [
            [" ".join(map(str, case[:-1])), case[-1], len(values), np.count_nonzero(np.isnan(values))]
            + [f"{x:.5f}" for x in mean_and_error(values)]
            for case, values in ratios.items()
        ],
    )
    judge(exhibit, ratios, nts)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
