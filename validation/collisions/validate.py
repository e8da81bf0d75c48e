# SPDX-License-Identifier: GPL-2.0-or-later
"""Collisions of two spheres, head-on and at 45 degrees: restitution, contact time and friction over the time step.

The real host, with the stock style and with gran/cfpm, beside closed forms. Contacts begin anywhere inside a step.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from exhibit import Exhibit  # noqa: E402
from host_collisions import HALVED, STOCK, cfpm, in_parallel  # noqa: E402
from experiment import QUANTITIES, Outcome, late_detection, measure, methods, new, references  # noqa: E402
from materials import Hertz, Hooke  # noqa: E402

MATERIALS = [Hooke(), Hertz()]
NT = (1.5, 2, 3, 4, 6, 10, 25, *HALVED)
SHOWN = (2, 3, 6, 10, 25, 100)  # in the table
REST = {
    "Contact time of head-on pairs over that of the undamped contact": "duration",
    "Restitution at 45 degrees, along the normal at the touch": "oblique restitution",
    "Contact time at 45 degrees over that of the undamped head-on contact": "oblique duration",
    "Tangential velocity after the impact at 45 degrees, over the impact speed": "tangential",
}
ONSET = (3, 4, 6, 10, 25)  # in the table of contacts that begin and end inside the step
FEW = 4  # steps per contact time, or fewer


def tabulate(exhibit, outcomes):
    def cell(values):
        return f"{values.mean():.3f} +- {values.std():.3f}"

    def table(quantity, shown):
        exhibit.table(
            ["contact", "method", *(f"nt = {nt}" for nt in SHOWN), "exact"],
            [
                [f"{material.name}, e = {e:g}", method.name]
                + [cell(outcome.results[method, nt][quantity][k]) for nt in SHOWN]
                + [f"{outcome.exact[quantity][k]:.3f}"]
                for material, outcome in outcomes.items()
                for k, e in enumerate(material.restitutions)
                for method in shown(material, outcome)
            ],
        )

    exhibit.text("Restitution of head-on pairs, mean and standard deviation over the phases:")
    table("restitution", lambda material, outcome: outcome.methods)
    for title, quantity in REST.items():
        exhibit.text(f"{title}:")
        table(quantity, lambda material, outcome: (STOCK, new(material)))


def plot(material, outcome):
    """A row of panels for each quantity, a column for each restitution."""
    figure, panels = plt.subplots(3, len(material.restitutions), figsize=(14, 9), sharex=True, sharey="row")
    main = (STOCK, new(material))
    others = [m for m in outcome.methods if m not in main]
    colours = dict(zip((*main, *others), ("C0", "C3", "C2", "C4", "C5")))
    for k, e in enumerate(material.restitutions):
        for method, colour in colours.items():
            style = {"color": colour, "label": method.name}
            style |= {"linewidth": 1.8, "zorder": 3} if method in main else {"linewidth": 0.8}
            for axes, quantity in zip(panels[:2, k], ("restitution", "duration")):
                values = np.array([outcome.results[method, nt][quantity][k] for nt in NT])
                mean, scatter = values.mean(axis=1), values.std(axis=1)
                axes.plot(NT, mean, **style)
                if method in main:
                    axes.fill_between(NT, mean - scatter, mean + scatter, color=colour, alpha=0.15, linewidth=0)
            panels[2, k].plot(NT, [100 * outcome.rms("tangential", method, nt)[k] for nt in NT], **style)
        late = [late_detection(material, material.damping[k], nt) for nt in NT]
        panels[0, k].plot(NT, late, "k--", linewidth=1, label="late detection alone")
        for axes, quantity in zip(panels[:2, k], ("restitution", "duration")):
            axes.axhline(outcome.exact[quantity][k], color="k", linewidth=0.8, label="closed form")
            axes.set(ylim=(0, 1.6))
        panels[0, k].set(title=f"{material.name}, e = {e:g}")
        panels[2, k].set(xscale="log", yscale="log", xlabel="nt = tc/dt")
        for axes in panels[:, k]:
            axes.grid(alpha=0.3)
    for axes, label in zip(
        panels[:, 0],
        ("restitution", "contact time/tc", "rms error of tangential velocity\nat 45 degrees, % of impact speed"),
    ):
        axes.set(ylabel=label)
    panels[0, -1].legend(fontsize=7)
    figure.tight_layout()
    return figure


def explain(exhibit, outcomes):
    """How much of the error is late detection, of which order it is, and how little the predictors differ."""
    coarse, fine = HALVED[1:]
    for material, outcome in outcomes.items():
        method, p = new(material), material.law.p
        error = outcome.mean("restitution", method, 10)
        late = [late_detection(material, c, 10) - e for c, e in zip(material.damping, material.restitutions)]
        orders = np.log2(outcome.mean("restitution", method, coarse) / outcome.mean("restitution", method, fine))
        means = np.array([[outcome.mean("restitution", m, nt) for m in outcome.methods[1:]] for nt in NT if nt > FEW])
        energy = [np.mean(outcome.results[m, 6]["restitution"][-1] ** 2) for m in (method, STOCK)]
        exhibit.text(
            f"""{material.name}: contacts that are found late, and are exact from then on, would have
            {100 * min(late / error):.0f} to {100 * max(late / error):.0f} % of the mean error of the restitution that
            {method.name} has at nt = 10 (dashed). By late detection the error is of order {p / 2:g} in the step with
            damping and {p:g} without; from nt = {coarse} to {fine} it is
            {", ".join(f"{q:.2f} (e = {e:g})" for q, e in zip(orders, material.restitutions))}. At nt > {FEW} the
            predictors differ from each other by {np.ptp(means, axis=1).max():.4f} at most. At nt = 6 elastic spheres
            leave with {energy[0]:.3f} of their energy on average; with velocity Verlet {energy[1]:.3f}."""
        )


COMPARED = {
    "mean restitution": lambda outcome, method, nt: np.abs(outcome.mean("restitution", method, nt)),
    "restitution of one collision": lambda outcome, method, nt: outcome.rms("restitution", method, nt),
    "mean contact time": lambda outcome, method, nt: np.abs(outcome.mean("duration", method, nt)),
    "tangential velocity, 45 degrees": lambda outcome, method, nt: outcome.rms("tangential", method, nt),
}


def compare(exhibit, outcomes):
    """Where the method is closer to the truth than the stock style, and how often."""
    few = np.array(NT) <= FEW
    table = [[f"{material.name}, e = {e:g}"] for material in outcomes for e in material.restitutions]
    summary = []
    for quantity, size in COMPARED.items():
        closer = np.array(
            [np.concatenate([size(o, new(m), nt) < size(o, STOCK, nt) for m, o in outcomes.items()]) for nt in NT]
        )
        for row, column in zip(table, closer.T):
            row.append(", ".join(f"{nt:g}" for nt, c in zip(NT, column) if c) or "none")
        counts = [f"{closer[rows].sum()} of {closer[rows].size}" for rows in (few, ~few)]
        summary.append(f"{quantity} {counts[0]} and {counts[1]}")
    ran = ", ".join(f"{nt:g}" for nt in NT)
    exhibit.text(f"Where CFPM is closer to the truth than velocity Verlet, of nt = {ran}:")
    exhibit.table(["contact", *COMPARED], table)
    exhibit.text(f"CFPM is closer, at nt <= {FEW} and at nt > {FEW}: {'; '.join(summary)}.")


def judge(exhibit, outcomes):
    claims = {
        "mean restitution and contact time tend to the closed forms": ("restitution", "duration"),
        "restitution, contact time, velocity and spin at 45 degrees tend to the same reference": (
            "oblique restitution",
            "oblique duration",
            "tangential",
            "spin",
        ),
    }
    for material, outcome in outcomes.items():
        for claim, quantities in claims.items():
            for method in outcome.methods:
                limits = [outcome.limit(quantity, method) for quantity in quantities]
                error, bound = (np.concatenate(values) for values in zip(*limits))
                k = np.argmax(error / bound)
                exhibit.verdict(
                    f"{material.name}, {method.name}: {claim}; extrapolated to small steps, off by {error[k]:.1e} "
                    f"where it matters most, allowed {bound[k]:.1e}",
                    np.all(error <= bound),
                )


def show_onset(exhibit, outcomes):
    """What it does to begin and end contacts inside the step, with the predictor that stands for the method."""
    late = {material: new(material) for material in outcomes}
    inside = {material: cfpm(late[material].predict.split()[1] + " onset on") for material in outcomes}
    nts = ONSET[2:4] if exhibit.quick else ONSET
    jobs = [(material, inside[material], nt) for material in outcomes for nt in nts]
    found = in_parallel(measure, jobs, "collisions with onset")
    rows, csv_rows, better = [], [], []
    for material, outcome in outcomes.items():
        results = outcome.results | {job[1:]: found[job] for job in jobs if job[0] == material}
        both = Outcome(material, results, outcome.exact, outcome.exact_error)
        for quantity in ("restitution", "oblique restitution", "tangential"):
            for k, e in enumerate(material.restitutions):
                for method in (STOCK, late[material], inside[material]):
                    rms = [both.rms(quantity, method, nt)[k] for nt in nts]
                    rows.append([material.name, f"{e:g}", quantity, method.name, *(f"{x:.2g}" for x in rms)])
                    csv_rows.append([material.name, e, quantity, method.name, *(f"{x:.3g}" for x in rms)])
                if quantity == "restitution":
                    errors = [[both.rms(quantity, m[material], nt)[k] for m in (late, inside)] for nt in nts]
                    better += [after < before for before, after in errors]
    exhibit.csv("onset", ["law", "e", "quantity", "method", *(f"nt_{nt}" for nt in nts)], csv_rows)
    exhibit.text("Contacts that begin and end inside the step (onset on): rms of the error over the phases.")
    exhibit.table(["law", "e", "quantity", "method", *(f"nt = {nt}" for nt in nts)], rows)
    exhibit.verdict("head-on restitution is nearer to the closed form with onset, at each nt of the table", all(better))


def write_csv(exhibit, outcomes):
    exhibit.csv(
        "collisions",
        ["law", "e", "method", "nt", *(f"{q}_{what}" for q in QUANTITIES for what in ("error", "scatter"))],
        [
            [material.name, e, method.name, nt]
            + [v for q in QUANTITIES for o in [outcome.off(q, method, nt)[k]] for v in (o.mean(), o.std())]
            for material, outcome in outcomes.items()
            for method, nt in outcome.results
            for k, e in enumerate(material.restitutions)
        ],
    )


def main():
    exhibit = Exhibit("Single collisions: restitution, contact time, friction", __doc__)
    exhibit.text(
        """Two equal spheres collide head-on and at 45 degrees (friction 0.3), without tension and without tangential
        dashpot, so that both styles have the same law. The damping is such that the restitution is e exactly; nt is the
        number of steps per contact time tc of the undamped contact. Every collision is run with 16 phases of the step
        at which it begins. For Hertz the host allows no e below 0.2137 (a coefficientRestitution of 0.05, which it
        takes with tension), so the lowest is 0.25."""
    )
    used = {material: [STOCK, new(material)] if exhibit.quick else methods(material) for material in MATERIALS}
    jobs = [(material, method, nt) for nt in NT for material in MATERIALS for method in used[material]]
    results = in_parallel(measure, jobs, "collisions")
    tiny = 8000 if exhibit.quick else 80000
    exact = in_parallel(references, [(material, tiny) for material in MATERIALS], "references")
    outcomes = {
        material: Outcome(material, {j[1:]: r for j, r in results.items() if j[0] == material}, *exact[material, tiny])
        for material in MATERIALS
    }

    tabulate(exhibit, outcomes)
    for material, outcome in outcomes.items():
        caption = f"{material.name}: phase means and, for two of the methods, bands of one standard deviation."
        exhibit.plot(plot(material, outcome), material.name.lower(), caption)
    explain(exhibit, outcomes)
    compare(exhibit, outcomes)
    show_onset(exhibit, outcomes)
    judge(exhibit, outcomes)
    write_csv(exhibit, outcomes)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
