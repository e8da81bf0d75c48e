# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 2 of the paper: the four conventional methods on one contact with a wall, by running them."""

import math
import sys
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "one_contact")]
import one_contact  # noqa: E402
from exhibit import Exhibit  # noqa: E402
from one_contact import BOUNDED, UNSTABLE, Expected  # noqa: E402

PC_LIMIT = 2 / math.pi * math.sqrt(math.sqrt(2) - 1)
METHODS = [
    Expected("euler", "explicit Euler", "unstable", UNSTABLE, "unstable", "No Good", (Fraction(1), 2), 1, 1),
    Expected(
        "adams-bashforth",
        "Adams-Bashforth 2",
        "unstable",
        UNSTABLE,
        "unstable",
        "No Good",
        (Fraction(1, 2), 4),
        2,
        2,
    ),
    Expected("leapfrog", "leapfrog", "2/pi", 2 / math.pi, f"2/pi = {2 / math.pi:.4f}", "Good", BOUNDED, 2, 1),
    Expected(
        "predictor-corrector",
        "predictor-corrector",
        "(2/pi) sqrt(sqrt2 - 1)",
        PC_LIMIT,
        f"(2/pi) sqrt(sqrt2 - 1) = {PC_LIMIT:.4f}",
        "No Good",
        (Fraction(-1, 2), 4),
        2,
        2,
    ),
]
PAPER_COST = {
    "euler": "1",
    "adams-bashforth": "1.46 + alpha",
    "leapfrog": "1.01 + alpha",
    "predictor-corrector": "2.08",
}


def main():
    exhibit = Exhibit("Table 2: the conventional methods on one contact", __doc__)
    exhibit.text(
        """One body at one wall, the linear force of Eq. 12, two-sided. Every number is measured by running the method.
        Limits and energy without damping; theta = omega dt = pi t*."""
    )
    measured = one_contact.measure(exhibit, ["conventional"])
    one_contact.limits(exhibit, "conventional", METHODS, measured)
    one_contact.energies(exhibit, "conventional", METHODS, measured)
    exhibit.text(
        """The paper's ratings hold; the first two methods gain energy at every step, 0.1 is only the smallest one that
        the search for limits tries. Its expressions for the energy error (e of Eq. 19, twice the energy; v', d' the
        next values, v-, d- the last ones, V = 3/2 v - v-/2 and D = 3/2 d - d-/2 of Eq. 23), derived again: Euler (h^2
        k/m)(m v^2 + k d^2); Adams-Bashforth (h^2 k/m)(m V^2 + k D^2) + h k (v d- - v- d); leapfrog (h^2 k^2/4m)(d'^2 -
        d^2); predictor-corrector (h^2 k/m) [m v^2 + k d^2 - m v V - k d D + (h k/2)(v d- - v- d) + (h^2 k/4m)(m V^2 + k
        D^2)]. tests/core/test_conventional_methods.cpp checks them step by step. What can be read in the scanned table
        fits, with one difference: leapfrog's expression reads (h^2 k/4m) x^2, without the second k that makes it an
        energy (x there is d). The predictor-corrector expression and the limit 0.410 both belong to a position that is
        closed with the predicted velocity; closing it with the corrected one changes both."""
    )
    one_contact.orders(exhibit, "conventional", METHODS, measured)
    exhibit.text(
        """Inside one contact, half a contact time after touch, damping ratio 0 and 0.7. With damping, leapfrog is of
        first order only, because the dashpot's force takes the velocity of half a step ago; the paper notes
        that Eq. 22 cannot be used then. Where contacts begin and end inside a step more is lost
        (exhibit collisions)."""
    )
    costs = one_contact.step_costs(exhibit, ["conventional"])
    exhibit.table(
        ["cost of a step", "paper", "measured"],
        [
            [e.title, PAPER_COST[e.method], one_contact.median_and_range(costs[f"conventional/{e.method}"])]
            for e in METHODS
        ],
    )
    exhibit.text(
        """Over explicit Euler, median (range) of repetitions in turns; alpha is the paper's allowance for treating the
        first and last step of a contact. """
        + one_contact.WHAT_COSTS_MEAN
    )
    one_contact.plot_growth(
        exhibit,
        {"conventional": "conventional methods, undamped"},
        METHODS,
        measured,
        "Energy gained or lost per step by an undamped contact. Leapfrog stays at 0 up to its limit; the "
        "predictor-corrector method loses energy before it gains.",
    )
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
