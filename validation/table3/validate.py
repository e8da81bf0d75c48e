# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 3 of the paper: the four predictions on one contact with a wall, each alone, which is what the paper rates, and
in the whole step of the contact force prediction method, by running them."""

import math
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "one_contact")]
import one_contact  # noqa: E402
from exhibit import Exhibit  # noqa: E402
from one_contact import BOUNDED, CONSERVED, UNCONDITIONAL, Expected  # noqa: E402

RK2_LIMIT = 2 / math.pi
RK4_LIMIT = 2 * math.sqrt(2) / math.pi
RK2_TEXT = f"2/pi = {RK2_LIMIT:.4f}"
RK4_TEXT = f"2 sqrt2/pi = {RK4_LIMIT:.4f}"
ALONE = [
    Expected("trapezoid", "trapezoid", "stable", UNCONDITIONAL, "none", "Exactly Good", CONSERVED, 2, 2),
    Expected("rk2", "modified RK2", "2/pi", RK2_LIMIT, RK2_TEXT, "Good", BOUNDED, 2, 2),
    Expected("rk4", "RK4", "2 sqrt2/pi", RK4_LIMIT, RK4_TEXT, "No Good", (Fraction(-1, 72), 6), 4, 4),
    Expected("exact", "exact", "stable", UNCONDITIONAL, "none", "Exactly Good", CONSERVED, math.inf, math.inf),
]
TRAPEZOID, RK2, RK4, EXACT = ALONE
LOSS = (Fraction(-1, 24), 4)
WHOLE = [
    TRAPEZOID,
    RK2,
    replace(RK4, limit=RK2_LIMIT, derivation=RK2_TEXT, energy=LOSS, order_undamped=2, order_damped=2),
    replace(EXACT, limit=1, derivation="1", energy=LOSS, order_undamped=2, order_damped=2),
]
PAPER_COST = {"trapezoid": "1.22", "rk2": "1.77", "rk4": "2.61", "exact": "1.22"}


def main():
    exhibit = Exhibit("Table 3: the predictions on one contact, alone and in the whole step", __doc__)
    exhibit.text(
        """One body at one wall, the linear force of Eq. 12, two-sided. Every number is measured by running the method.
        Limits and energy without damping; theta = omega dt = pi t*. The paper rates the prediction as if it were the
        integrator. The step that its method takes is another one: the predicted force is averaged with the present one
        (Eqs. 20, 27)."""
    )
    measured = one_contact.measure(exhibit, ["alone", "whole"])

    exhibit.text("### Prediction alone, as the paper rates it")
    one_contact.limits(exhibit, "alone", ALONE, measured)
    one_contact.energies(exhibit, "alone", ALONE, measured)
    one_contact.orders(exhibit, "alone", ALONE, measured)
    exhibit.text(
        """The order of the exact solution is infinite: only rounding is left. The paper's ratings hold. Its expressions
        for the energy error (Eq. 19), derived again: modified RK2 (h^2 k/4m)(m v'^2 - m v^2), where the scanned table
        reads (h^2 k/4m) v^2, no energy without the mass; RK4 [(1 - h^2 k/2m + h^4 k^2/24m^2)^2 + (k/m)(h - h^3 k/6m)^2
        - 1](m v^2 + k d^2), which is (-theta^6/72 + theta^8/576)(m v^2 + k d^2) and has the terms that can be read. Its
        "No Good" is a mild one: at t* = 0.1 RK4 loses 1.3e-5 of the energy per step."""
    )

    exhibit.text("### Whole step")
    one_contact.limits(exhibit, "whole", WHOLE, measured)
    one_contact.energies(exhibit, "whole", WHOLE, measured)
    one_contact.orders(exhibit, "whole", WHOLE, measured)
    exhibit.text(
        """Where the paper's entry does not hold for the whole step. Exact: it is stable for t* < 1 only, which happens
        to be the bound that the paper sets in section 2.2 for another reason; and it is not "Exactly Good", it loses
        theta^4/24 of the energy, because the mean of two exact end forces is still the trapezoid rule for the impulse.
        RK4: 2/pi instead of 2 sqrt2/pi, no more than leapfrog has without any prediction; and it loses theta^4/24 too,
        far more than the prediction alone. Every whole step is of second order, whatever the prediction's."""
    )
    exhibit.text(
        """Where it holds. Trapezoid: the predicted force is the one its own step ends with, so the whole step is the
        trapezoid, stable at any step and conserving. Modified RK2: 2/pi; the energy swings by theta^4/16, where the
        prediction alone swings by theta^2/4. Of the two predictions that also serve Hertz contacts it is the one that
        loses no energy here."""
    )

    columns = ["formulas", "prepared", "alone"]
    costs = one_contact.step_costs(exhibit, columns)
    exhibit.table(
        ["cost of a step", "paper", "whole step, formulas", "whole step, prepared", "prediction alone"],
        [
            [e.title, PAPER_COST[e.method]]
            + [one_contact.median_and_range(costs[f"{column}/{e.method}"]) for column in columns]
            for e in ALONE
        ],
    )
    exhibit.text(
        """Over explicit Euler, median (range) of repetitions in turns. "Formulas": the prediction is computed from its
        equations at every step, only exact has its exp and cos prepared. "Prepared": as the plugin does it for linear
        laws, whose predicted force is a linear law too: its coefficients are computed once per kind of contact, and the
        choice of the prediction costs nothing. That the paper prints the same 1.22 for trapezoid and exact suggests
        that it prepared both. """
        + one_contact.WHAT_COSTS_MEAN
    )
    one_contact.plot_growth(
        exhibit,
        {"alone": "prediction alone, undamped", "whole": "whole step, undamped"},
        ALONE,
        measured,
        "Energy gained or lost per step by an undamped contact, by the prediction alone and by the whole step with it.",
    )
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
