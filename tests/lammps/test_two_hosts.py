# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugins of both hosts move the same 50 spheres from the same start alike: one core, two hosts."""

import numpy as np
import pytest
from harness.fifty_spheres import DISTURBANCE, LAWS, bound, end, start


@pytest.mark.parametrize("law", LAWS)
def test_same_motion(tmp_path, law):
    ends = {}
    cases = {"liggghts": ("liggghts", 0.0), "lammps": ("lammps", 0.0), "off": ("lammps", DISTURBANCE)}
    for name, (host, disturbance) in cases.items():
        folder = tmp_path / name
        folder.mkdir()
        ends[name] = end(host, folder, law, disturbance)
    allowed = bound(ends["lammps"], ends["off"])
    difference = np.abs(ends["lammps"] - ends["liggghts"]).max()
    report = f"bound {allowed:.2g}, hosts differ by {difference:.2g}"
    print(report)
    assert difference <= allowed, report
    assert allowed < 1e-3 * 0.004, "the motion has become too chaotic to compare"
    fallen = np.abs(ends["lammps"] - [s.x for s in start()]).max()
    assert fallen > 0.01
