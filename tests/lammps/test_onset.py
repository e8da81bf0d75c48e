# SPDX-License-Identifier: GPL-2.0-or-later
"""predict exact onset on: contacts begin at their touch and end where they end, inside the step, in the host.

What becomes of a head-on collision is written down a second time, see harness/impacts.py.
"""

import numpy as np
import pytest
from harness.impacts import linear_restitution, touching_rebounds
from normal_impacts import ROUNDING, gaps, restitutions

NTS = (20, 10, 3, 1.5)


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("zeta, limit", [(0.0, ""), (0.1, ""), (0.7, ""), (0.1, "limit_damping")])
def test_collisions_are_those_of_the_method(tmp_path, zeta, limit, newton, ranks):
    for nt, found in restitutions(tmp_path, zeta, ranks, newton, limit, "exact onset on", NTS).items():
        steps = [nt, *3 * [np.sqrt(2.0) * nt]]  # at a wall the mass is twice as large
        expected = [touching_rebounds(zeta, n, ahead, tension=not limit) for n, ahead in zip(steps, gaps())]
        error = np.abs(found - expected).max(axis=1)
        print(f"nt = {nt}: e = {found.mean():.5f} +- {found.std():.1e}, off {error}")
        assert error.max() <= ROUNDING


def test_nearer_to_the_law_than_late_contacts(tmp_path):
    """Of second order in the time step in place of the first, see tests/core/test_mean_while_touching.cpp."""
    zeta, nts = 0.1, (20, 10)
    expected = linear_restitution(zeta, tension=True)
    rms = {}
    for predict in ("exact", "exact onset on"):
        (tmp_path / predict).mkdir()
        found = restitutions(tmp_path / predict, zeta, 1, "off", "", predict, nts)
        rms[predict] = [np.sqrt(np.mean((found[nt] - expected) ** 2)) for nt in nts]
    print(rms)
    assert rms["exact onset on"][1] < 0.1 * rms["exact"][1]
