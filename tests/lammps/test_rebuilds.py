# SPDX-License-Identifier: GPL-2.0-or-later
"""Springs of predicted contacts outlast a rebuild of the neighbour list: two spheres that meet at an angle move to the
last digit alike with a list made at every step and with one list for all of them."""

import pytest
from harness.decks import two_spheres
from harness.lammps import run
from harness.output import rebuilds

LAWS = {"hooke": "hooke 1e5 NULL 100 NULL 0.5 1", "hertz": "hertz 1e7 NULL 1e4 NULL 0.5 1"}
LAWS["impulse"] = LAWS["hooke"] + " predict impulse"
LAWS["split"] = LAWS["impulse"] + " split 0.5"


def motion(folder, law, newton, neighbors):
    output = run(
        two_spheres("lammps", newton, offset=0.01, velocity="1 0.3 0.2", skin=0.2)
        + f"""
{neighbors}
pair_style gran/cfpm {LAWS[law]}
pair_coeff * *
fix integrate all nve/cfpm
dump motion all custom 10 motion.dump id x y z vx vy vz omegax omegay omegaz
dump_modify motion sort id format float %.17g
run 500
""",
        folder,
    ).stdout
    return rebuilds(output)[0], (folder / "motion.dump").read_text()


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("law", LAWS)
def test_rebuilds_change_nothing(tmp_path, law, newton):
    once, expected = motion(tmp_path, law, newton, "")
    often, found = motion(tmp_path, law, newton, "neigh_modify delay 0 every 1 check no")
    assert (once, often) == (0, 500)
    assert " 0 0 0\n" not in expected.splitlines(keepends=True)[-1], "they did not turn"
    same = found == expected
    assert same, "rebuilds changed the run"
