# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's packing at nt = 6 and 3 against the stock style at nt = 30, over 8 random starts.

One run scatters by about 1 % of the packing ratio, so only the mean over starts says something, and only
within its standard error: the measured difference must agree with the documented one (16 starts,
"./cfpm validate packing --seeds 16") within 3 of their joint standard errors. That band is about +-1.5 %,
enough to see a lost force or spring; a sharper statement needs more starts, not a smaller band.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "packing"))
import validate  # noqa: E402

SEEDS = 8
DOCUMENTED = {("cfpm", 6): (0.34, 0.26), ("cfpm", 3): (0.51, 0.38)}  # difference and its error in percent


@pytest.fixture(scope="module")
def same_law():
    """Without the tangential dashpot both styles have the same law of friction."""
    return validate.ensemble(SEEDS, [("stock", 30), *DOCUMENTED], "off")


@pytest.mark.parametrize("case", DOCUMENTED)
def test_packing_ratio_agrees_with_stock(same_law, case):
    assert np.all(np.isfinite(same_law[case])), "a run blew up"
    difference, error = validate.difference(same_law[case], same_law["stock", 30])
    documented, documented_error = DOCUMENTED[case]
    print(f"{case}: {difference:+.2f} +- {error:.2f} %, documented {documented:+.2f} +- {documented_error:.2f} %")
    assert abs(difference - documented) < 3 * np.hypot(error, documented_error)


def test_stock_packing_ratio_is_that_of_the_paper(same_law):
    """0.57 in the paper, section 3.2.1: read as 0.565 to 0.575, widened by 3 standard errors."""
    mean, error = validate.mean_and_error(same_law["stock", 30])
    assert 0.565 - 3 * error < mean < 0.575 + 3 * error


def test_papers_damping_completes():
    ratios = validate.ensemble(SEEDS, list(DOCUMENTED), "on")
    assert all(np.all(np.isfinite(values)) for values in ratios.values()), "a run blew up"
