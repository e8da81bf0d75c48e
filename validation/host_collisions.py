# SPDX-License-Identifier: GPL-2.0-or-later
"""Many collisions far apart in one run of the real host, stock or with the plugin.

A contact begins somewhere inside a step, and the host finds it at the next evaluation of the forces. Where that is,
the phase, is left to chance in a bed; here every collision is repeated with phases spread evenly over the step.
"""

import concurrent.futures
import itertools
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from exhibit import progress

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from harness import liggghts  # noqa: E402
from harness.spheres import MOTION, Sphere, box, dump, read_motion, write_data  # noqa: E402

PHASES = (np.arange(16) + 0.5) / 16  # of a step passes before a contact begins

HALVED = (50, 100, 200)  # steps per contact time nt, for the limit of small steps

BALL = Sphere((0.0, 0.0, 0.0), radius=0.005, density=800.0)  # of the paper's 3-particle collision
DIAMETER = 2 * BALL.radius
CELL = 5 * DIAMETER  # room for one collision


@dataclass(frozen=True)
class Method:
    """What the exhibits compare: a pair style with its integrator."""

    name: str
    pair_style: str
    predict: str
    integrator: str
    program: str


STOCK = Method("velocity Verlet", "gran", "", "nve/sphere", liggghts.STOCK)


def cfpm(predictor):
    return Method(f"CFPM {predictor}", "gran/cfpm", f"predict {predictor}", "nve/cfpm", liggghts.LAUNCHER)


def centres(count):
    """Places of collisions, far apart, on a cubic lattice around the origin."""
    side = int(np.ceil(count ** (1 / 3)))
    lattice = CELL * (np.arange(side) - 0.5 * (side - 1))
    return np.array(list(itertools.islice(itertools.product(lattice, repeat=3), count)))


def collide(method, model, settings, material, spheres, dt, steps):
    """Runs the deck; returns the final motion (spheres, 9) and the number of steps that each sphere had a force in.

    model and settings: words of the pair style; material: its properties. Both styles are without tension.
    """
    types = max(s.type for s in spheres)
    half = max(np.abs([s.x for s in spheres]).max(axis=0)) + CELL
    text = (
        box(dt, skin=0.1 * DIAMETER)
        + material
        + f"""
pair_style {method.pair_style} model {model} {method.predict} limitForce on {settings}
pair_coeff * *
fix integrate all {method.integrator}
variable pushed atom "fx != 0 || fy != 0 || fz != 0"
fix pushed all ave/atom 1 {steps} {steps} v_pushed
"""
        + dump(every=steps, columns=(*MOTION, "f_pushed"))
        + f"run {steps}\n"
    )
    with tempfile.TemporaryDirectory() as folder:
        write_data(Path(folder) / "spheres.data", spheres, low=-half, high=half, types=types)
        liggghts.run(text, folder, program=method.program, options=("-log", "none"), timeout=None)
        _, motion = read_motion(Path(folder) / "motion.dump", (*MOTION, "f_pushed"))
    return motion[-1, :, :9], np.rint(steps * motion[-1, :, 9]).astype(int)


def in_parallel(function, jobs, what):
    """{job: function(*job)}, as many at a time as there are cores."""
    results = {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, (job, result) in enumerate(zip(jobs, pool.map(lambda job: function(*job), jobs)), 1):
            results[job] = result
            progress(done, len(jobs), what)
    return results


def small_step_limit(coarse, middle, fine, order=1):
    """Limit for small steps of what was measured at HALVED, and a bound of its error.

    The leading order cancels. What remains, c dt^q, becomes 2^q - 1 times as large from the last extrapolation to the
    one before: for q > 1 the limit changes by more than its error.
    """
    before, limit = ((2**order * b - a) / (2**order - 1) for a, b in ((coarse, middle), (middle, fine)))
    return limit, np.abs(limit - before)
