# SPDX-License-Identifier: GPL-2.0-or-later
"""A predicted run gives the same trajectories on one rank and on two, up to the growth of rounding errors.

The two runs do the same operations except that a particle's force and torque are summed in another order and that a
partner may be seen through another periodic image. Let d be the difference of two states: the largest entry of
(positions / L, velocities / V, radius * spins / V), with L the box side and V the largest speed at the start.

- One step. A sum of n terms in another order changes by at most n eps sum|f|. A contact force is stiffness times
  overlap and an overlap is below L, so this acts like a shift of the positions by at most n eps L. Shifting a
  periodic image rounds a coordinate by at most eps L / 2, and rounding the sums of v and omega costs eps V / 2. So
  one step adds at most n eps to d, n being all contacts of a particle (counted in the run), the wall and gravity.
- Many steps. What one step added has grown by t by a factor that the bed sets, not the number of ranks. It is
  measured: start states that differ by d0 = 1e-10 grow to d0 A(t). All N steps together give at most

      d(t) <= N n eps max A

  with the maximum over two perturbations and all times up to t. (A(t) counts from the start; what was added later
  had less time to grow. A small difference does grow linearly: d0 = 1e-12 must show the same A within 5 %.)

The controls: the perturbed runs lie far beyond the bound, so it would notice a relative error of 1e-10 made once;
and the ranks do differ, so the sums were in another order.
"""

from collections import Counter

import falling_bed as bed
import numpy as np
import pytest
from harness.liggghts import run
from harness.output import read_dump, rebuilds, vectors

STEPS = 350  # later the growth leaves the linear regime: a contact starts, slides, or a load counts, earlier in one run
EVERY = 50
HERTZ = "model hertz tangential history"
CASES = [(bed.HOOKE, "exact"), (HERTZ, "rk4"), (HERTZ, "exact onset on")]
CASES += [(bed.HOOKE, "impulse"), (HERTZ, "impulse split 0.5")]


def fall(folder, state, model, predict, ranks=1):
    bed.write(folder, state)
    styles = {**bed.PREDICTED, "predict": predict}
    deck = bed.box() + bed.pair(styles, model) + bed.fixes(styles, model)
    deck += bed.CONTACTS + bed.dump_particles(every=EVERY) + bed.dump_contacts(every=EVERY)
    assert rebuilds(run(deck + f"run {STEPS}\n", folder, np=ranks).stdout)[-1] > 20
    return [columns for _, columns in read_dump(folder / "bed.dump")]


def perturbed(size, seed):
    random = np.random.default_rng(seed)
    types, x, v, omega = bed.start()

    def shift(scale):
        return size * scale * random.uniform(-1.0, 1.0, x.shape)

    return types, x + shift(bed.SIDE), v + shift(bed.SPEED), omega + shift(bed.SPEED / bed.RADIUS.max())


def difference(a, b):
    """d for every snapshot."""
    d = []
    for p, q in zip(a, b):
        dx, dv, domega = (
            vectors(p, *names) - vectors(q, *names)
            for names in (("x", "y", "z"), ("vx", "vy", "vz"), ("omegax", "omegay", "omegaz"))
        )
        dx[:, :2] -= bed.SIDE * np.round(dx[:, :2] / bed.SIDE)  # the periodic directions
        radius = bed.RADIUS[p["type"].astype(int) - 1][:, None]
        d.append(max(np.abs(e).max() for e in (dx / bed.SIDE, dv / bed.SPEED, radius * domega / bed.SPEED)))
    return np.array(d)


def most_terms(path):
    """Contacts of the busiest particle, the wall and gravity."""
    contacts = [Counter(i for pair in snapshot for i in pair) for snapshot in bed.read_contacts(path)]
    return max(max(count.values(), default=0) for count in contacts) + 2


@pytest.mark.parametrize("model, predict", CASES)
def test_one_and_two_ranks_agree(tmp_path, model, predict):
    one = fall(tmp_path, bed.start(), model, predict)
    terms = most_terms(tmp_path / "contacts.dump")
    two = difference(one, fall(tmp_path, bed.start(), model, predict, ranks=2))

    starts = [(size, seed) for size in (1e-10, 1e-12) for seed in (1, 2)]
    off = {s: difference(one, fall(tmp_path, perturbed(*s), model, predict)) for s in starts}
    growth = np.maximum(off[1e-10, 1], off[1e-10, 2]) / 1e-10
    for seed in (1, 2):
        np.testing.assert_allclose(off[1e-12, seed] / 1e-12, off[1e-10, seed] / 1e-10, rtol=0.05)

    steps = EVERY * np.arange(len(one))
    bound = steps * terms * np.finfo(float).eps * np.maximum.accumulate(growth)
    report = f"terms {terms}, A {growth[-1]:.2g}, bound {bound[-1]:.2g}, ranks differ by {two[-1]:.2g}"
    print(report)
    assert np.all(two <= bound), report
    assert np.all(off[1e-10, 1] > bound) and np.all(off[1e-10, 2] > bound), report
    assert two[-1] > 0.0
