# SPDX-License-Identifier: GPL-2.0-or-later
"""In two dimensions particles turn as spheres, or as discs where the integrator is told so, as with fix nve/sphere."""

import numpy as np
import pytest
from harness.lammps import run
from harness.output import read_dump

RADIUS = 0.025
DECK = """units si
dimension 2
boundary f f p
atom_style sphere
newton off
comm_modify vel yes
region box block -0.5 0.5 -0.1 0.5 -0.05 0.05 units box
create_box 1 box
create_atoms 1 single 0 0.0255 0 units box
set group all diameter 0.05 density 800
velocity all set 0.5 -0.5 0 units box
neighbor 0.01 bin
timestep 1e-6
pair_style gran/cfpm hooke 1e6 NULL 50 NULL 0.5 1
pair_coeff * *
fix floor all wall/gran/cfpm hooke 1e6 NULL 50 NULL 0.5 1 yplane 0 NULL
fix integrate all nve/cfpm {keyword}
fix flat all enforce2d
dump path all custom 4000 path.dump id x y vx vy omegaz
dump_modify path format float %.17g
run 4000
"""


@pytest.mark.parametrize("keyword, inertia", [("", 0.4), ("disc", 0.5)])
def test_moment_of_inertia(tmp_path, keyword, inertia):
    """The impulse J of friction turns by J r/I and slows by J/m, r ending in the middle of the overlap."""
    run(DECK.format(keyword=keyword), tmp_path)
    (_, start), (_, end) = read_dump(tmp_path / "path.dump")
    slower = start["vx"][0] - end["vx"][0]
    turn = np.abs(end["omegaz"][0] - start["omegaz"][0])
    assert end["vy"][0] > 0.1 and slower > 0.05, "it did not bounce"
    deepest = 0.5 * np.sqrt(800 * 4 / 3 * np.pi * RADIUS**3 / 1e6)  # of an undamped impact
    assert slower / (RADIUS * turn) == pytest.approx(inertia, rel=deepest / RADIUS)
