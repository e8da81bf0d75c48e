# SPDX-License-Identifier: GPL-2.0-or-later
"""predict exact onset on: contacts begin at their touch and end where they end, inside the step, in the host.

What becomes of a head-on collision is written down a second time, see harness/impacts.py.
"""

import numpy as np
import pytest
from harness.impacts import TC, touching_rebounds
from normal_impacts import contact_time, gaps, hertz, hooke, restitutions

NTS = (20, 10, 3, 1.5)
# positions of 0.3 m are rounded some 60 times, by 2e-15 m in all, where overlaps are 1e-5 m
ROUNDING = 1.0e-9


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("zeta, tension", [(0.0, True), (0.1, True), (0.7, True), (0.1, False)])
def test_collisions_are_those_of_the_method(tmp_path, zeta, tension, ranks):
    """Of pairs and at walls, planes and meshes, which follow the pair style."""
    material, model, settings, _ = hooke(zeta, tension)
    for nt in NTS:
        found = restitutions(
            tmp_path, material, model, settings, TC / nt, ranks, predict="exact onset on", walls="exact"
        )
        steps = [nt, *2 * [np.sqrt(2.0) * nt]]  # at a wall the mass is twice as large
        expected = [touching_rebounds(zeta, n, ahead, tension) for n, ahead in zip(steps, gaps())]
        error = np.abs(found - expected).max(axis=1)
        print(f"nt = {nt}: e = {found.mean():.5f} +- {found.std():.1e}, off {error}")
        assert error.max() <= ROUNDING


@pytest.mark.parametrize("predict", ["exact", "rk2", "rk4"])
def test_nearer_to_the_law_of_hertz(tmp_path, predict):
    material, model, settings, expected = hertz(0.9, tension=True)
    dt = contact_time(model) / 10
    rms = {}
    for onset in ("off", "on"):
        found = restitutions(tmp_path, material, model, settings, dt, predict=f"{predict} onset {onset}", walls=predict)
        rms[onset] = np.sqrt(np.mean((found[0] - expected) ** 2))
    print(predict, rms)
    assert rms["on"] < 0.5 * rms["off"]
