# SPDX-License-Identifier: GPL-2.0-or-later
"""Collisions whose contacts slide for a time and stick for a time, with a dashpot in friction, the host's default.

Coulomb's limit holds the spring alone; the dashpot acts beside it, without a limit, while the spring is below, and not
while the contact slides. Against the host's own style in fine steps.
"""

import numpy as np
import pytest
from harness.liggghts import STOCK, run
from harness.output import read_dump

RADIUS, DENSITY, SPEED, GAP = 0.025, 800.0, 0.1, 1e-5
SLIPS = np.linspace(0.2, 4.0, 20)  # over the closing speed
TIME = 2.5e-3  # from before the touch to behind the release [s]
MODELS = ["hooke", "hertz"]


def write_pairs(folder):
    """One beside the other, each of two spheres that meet along x and slip along y."""
    atoms, velocities = [], []
    for k, slip in enumerate(SLIPS):
        for id, side in ((2 * k + 1, -1), (2 * k + 2, 1)):
            atoms.append(f"{id} 1 {2 * RADIUS} {DENSITY} {side * (RADIUS + GAP / 2)!r} 0 {0.2 * k!r}")
            velocities.append(f"{id} {-side * SPEED / 2!r} {float(-side * slip * SPEED / 2)!r} 0 0 0 0")
    head = f"pairs\n\n{len(atoms)} atoms\n1 atom types\n\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 9 zlo zhi\n"
    (folder / "pairs.data").write_text("\n".join([head, "Atoms\n", *atoms, "\nVelocities\n", *velocities, ""]))


def velocities(folder, model, steps, friction=0.4, damping="on", **words):
    """Of the first sphere of each pair over the closing speed: vx, vy, and what the spin moves the surface by."""
    write_pairs(folder)
    deck = f"""
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data pairs.data
neighbor 0.002 bin
fix m1 all property/global youngsModulus peratomtype 3e7
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
fix m4 all property/global coefficientFriction peratomtypepair 1 {friction}
fix m5 all property/global characteristicVelocity scalar {SPEED}
pair_style gran model {model} tangential history tangential_damping {damping}
pair_coeff * *
fix integrate all nve/sphere
timestep {TIME / steps!r}
run {steps}
dump end all custom 1 end.dump id vx vy vz omegax omegay omegaz
dump_modify end sort id format "%d {" ".join(["%.17g"] * 6)}"
run 0
"""
    run(deck, folder, **words)
    end = read_dump(folder / "end.dump")[-1][1]
    return np.array([end["vx"], end["vy"], RADIUS * end["omegaz"]])[:, ::2] / SPEED


@pytest.mark.parametrize("predict", ["exact", "rk4", "impulse"])
@pytest.mark.parametrize("model", MODELS)
def test_as_the_host(tmp_path, model, predict):
    """Within what halving the step changes of either, of which the largest of all pairs counts: where in a step the
    dashpot is lost scatters. And impulses within what their parts and the mean overlap of a Hertz contact in each
    leave, which is below 0.0005. Without the dashpot the motion is another one."""
    host_coarse, host = (velocities(tmp_path, model, steps, program=STOCK) for steps in (8000, 16000))
    options = ("-suffix", "cfpm", "-predict", predict)
    coarse, fine = (velocities(tmp_path, model, steps, options=options) for steps in (1000, 2000))
    allowed = np.abs(host - host_coarse).max() + np.abs(fine - coarse).max() + 5e-4
    off = np.abs(fine - host).max()
    undamped = velocities(tmp_path, model, 2000, damping="off", options=options)
    print(f"{model}, {predict}: off by {off}, allowed {allowed}")
    assert off <= allowed < 0.01
    assert np.abs(undamped - host).max() > 0.03
