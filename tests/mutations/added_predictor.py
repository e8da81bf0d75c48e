# SPDX-License-Identifier: GPL-2.0-or-later
"""A predictor is added to the core by one file and its name in one list, euler.patch: then a deck can say its name.

One head-on collision of two spheres with a linear law, stepped here with explicit Euler's prediction: with the overlap
d, the closing speed u and the force f = k d + h u (Eq. 2), the predicted state is d1 = d + dt u, u1 = u - dt f/m, the
force of the step the mean of f and f1 = k d1 + h u1, neither below 0 (Eq. 36).
"""

import numpy as np

from harness.decks import two_spheres
from harness.host import run
from harness.output import read_dump

RADIUS, GAP, SPEED, DT, STEPS = 0.025, 0.002, 1.03, 1e-5, 240
MASS = 800 * 4 / 3 * np.pi * RADIUS**3
REDUCED = MASS / 2
KN, GAMMA = 2.0e5, 400.0  # [N/m], [1/s]
STYLES = {
    "lammps": f"pair_style gran/cfpm hooke {KN} 0 {GAMMA} 0 0 0 predict euler",
    "liggghts": "\n".join(
        [
            *(
                f"fix {name} all property/global {name} peratomtypepair 1 {value}"
                for name, value in {"kn": KN, "kt": 0, "gamman": GAMMA, "gammat": 0}.items()
            ),
            "pair_style gran/cfpm model hooke/stiffness predict euler",
        ]
    ),
}
FORMATS = {"lammps": "float %.17g", "liggghts": '"%d %.17g"'}  # all digits
PROGRAMS = {"lammps": "lmp-cfpm", "liggghts": "liggghts-cfpm"}


def expected_speed():
    """Of the first sphere at the end [m/s]."""
    d, u = -GAP, SPEED
    h = GAMMA * REDUCED
    for _ in range(STEPS):
        force = 0.0
        if d > 0.0:
            now = KN * d + h * u
            end = KN * (d + DT * u) + h * (u - DT * now / REDUCED)
            force = 0.5 * (max(0.0, now) + max(0.0, end))
        after = u - DT * force / REDUCED
        d, u = d + 0.5 * DT * (u + after), after
    return 0.5 * (SPEED + u)


def check(host, built, folder):
    """Runs the deck with the plugin of the build.

    Tolerance: each step rounds places of up to 0.03 m, so that the overlap is off by that many half units in the last
    place at most, and a force off by k times that acts for all steps at most.
    """
    deck = f"""{two_spheres(host, velocity=f"{SPEED} 0 0")}
{STYLES[host]}
pair_coeff * *
fix integrate all nve/cfpm
dump end all custom {STEPS} end.dump id vx
dump_modify end format {FORMATS[host]}
run {STEPS}
"""
    run(built / "bin" / PROGRAMS[host], deck, folder)
    _, particles = read_dump(folder / "end.dump")[-1]
    overlap_error = STEPS * 0.5 * np.spacing(0.03)
    tolerance = KN * overlap_error / REDUCED * STEPS * DT
    assert abs(particles["vx"][0] - expected_speed()) < tolerance
