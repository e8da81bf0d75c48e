# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix nve/cfpm tells with "energy yes", and the host beside it. SI units."""

import numpy as np
from harness.output import vectors
from harness.spheres import Sphere

G = 9.81
ENTRIES = ("translation", "rotation", "normal", "tangential", "lost_normal", "lost_friction", "moved", "others")
TOLD = ("step", "balance", *ENTRIES, "kinetic", "rotating", "gravity", "fz")  # columns of a table
EPS = np.finfo(float).eps

COMMANDS = f"""fix g all gravity {G} vector 0 0 -1
fix move all nve/cfpm energy yes
compute ke all ke
compute rot all erotate/sphere
compute fz all reduce sum fz
thermo_style custom step f_move {" ".join(f"f_move[{k}]" for k in range(1, 9))} c_ke c_rot f_g c_fz
thermo_modify norm no format float %.17g
"""


def table(process):
    """{column: array over the rows of thermo} of a run with COMMANDS."""
    rows = []
    for line in process.stdout.splitlines():
        words = line.split()
        if len(words) == len(TOLD) and words[0].isdigit():
            rows.append([float(word) for word in words])
    assert rows, process.stdout[-2000:]
    return dict(zip(TOLD, np.array(rows).T))


def cloud(side=4, radius=0.005, speed=1.0):
    """A cube of spheres of two sizes that fly about and spin; the spheres, and the ends of its edges."""
    rng = np.random.default_rng(7)
    spheres = []
    for site in np.stack(np.meshgrid(*3 * [np.arange(side)]), -1).reshape(-1, 3):
        x = 2.3 * radius * (site + 0.55) + 0.1 * radius * rng.uniform(-1, 1, 3)
        size = radius * (1.0 if rng.random() < 0.5 else 0.8)
        v, omega = speed * rng.normal(size=3), 100 * rng.normal(size=3)
        spheres.append(Sphere(tuple(x), tuple(v), tuple(omega), size, 2500.0))
    return spheres, (0.0, 2.3 * radius * side)


def normal_energy(snapshot, energy, edge, floor):
    """Of all contacts, also across the sides of a box that is periodic in x and y [J].

    energy(overlap, reduced radius): of one; floor: whether there is one at z = 0.
    """
    x, r = vectors(snapshot, "x", "y", "z"), snapshot["radius"]
    i, j = np.triu_indices(len(x), 1)
    between = x[i] - x[j]
    between[:, :2] -= edge * np.rint(between[:, :2] / edge)
    overlap = r[i] + r[j] - np.linalg.norm(between, axis=1)
    held = np.sum(energy(np.maximum(0.0, overlap), r[i] * r[j] / (r[i] + r[j])))
    return held + (np.sum(energy(np.maximum(0.0, r - x[:, 2]), r)) if floor else 0.0)


def assert_closes(told, held, steps, dt, verlet, moved):
    """Against energies that are not the fix's: kinetic ones and that of gravity by the host, of normal springs, held,
    from the positions. Each step rounds every velocity and every sum once, some eps of what they are.

    Of gravity velocity Verlet does work along (v + 2 v(half) + v')/4, which is the way over dt but for dt/(8m) (f' -
    f), f with gravity: what is missing is the same sum of forces at the end less at the start of each run, not one over
    steps.
    """
    scale = sum(np.abs(told[name]).max() for name in ENTRIES) + np.abs(told["gravity"]).max()
    rounding = 4 * steps * EPS * scale
    assert np.abs(told["translation"] - told["kinetic"]).max() < rounding
    assert np.abs(told["rotation"] - told["rotating"]).max() < rounding
    assert np.ptp(told["balance"]) < rounding
    others = told["gravity"][0] - told["gravity"]
    if verlet:
        of_a_run = np.diff(told["step"], prepend=0) > 0  # else between two: setup leaves springs where they are
        others = others - G * dt**2 / 8 * np.cumsum(of_a_run * np.diff(told["fz"], prepend=told["fz"][0]))
    assert np.abs(told["others"] - others).max() < rounding
    assert max(held) > 1e-3 * scale, "nothing touches"
    # of an overlap, 1e-5 m, positions of some cm leave 1e-12
    assert np.abs(told["normal"] - held).max() < 1e-10 * scale
    assert told["lost_normal"][-1] > 0.01 * scale and told["lost_friction"][-1] > 0.01 * scale
    assert (np.abs(told["moved"][-1]) > 1e-3 * scale) == moved
