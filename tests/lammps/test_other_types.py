# SPDX-License-Identifier: GPL-2.0-or-later
"""A contact does not depend on the sub-models that other pairs of types of the deck have.

Of two spheres of type 1 that slip while they collide, beside a type 2 of which there is none. In the host of 29 Sep
2021 it does: whether it computes springs of friction is one switch of the whole style. With it on, contacts of
linear_nohistory at the limit of friction are computed as with a spring of length 0, for which the host sets their
friction to 0.
"""

import numpy as np
import pytest
from granular_bed import IS_NEWER
from granular_contacts import RADIUS, SPEED, TIME, YOUNG
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import read_dump
from test_granular_predicted import deck

STEPS = 1000
LONGER = 8.0  # than TIME: until the contact has ended
SLIP = 3 * SPEED
NORMAL = f"hertz/material {YOUNG} 0.5 0.3 damping tsuji tangential"
ALONE = f"{NORMAL} linear_nohistory 0.5 0.4"
TWISTS = " twisting marshall"
SPIN = "set atom 1 omega 20 0 0\nset atom 2 omega -20 0 0\n"  # against each other, about the normal
OTHERS = {
    "mindlin": f"{NORMAL} mindlin NULL 0.5 0.4",
    "linear_history": "hooke 1e5 20 damping velocity tangential linear_history 4e4 0.5 0.4 limit_damping",
    "mindlin_rescale/force": f"{NORMAL} mindlin_rescale/force NULL 0.5 0.4",
    "rolling": f"{ALONE} rolling sds 2e3 1 0.1",
    "twisting": f"{ALONE} twisting sds 1e-2 1e-7 2e-4",
    "all": f"dmt 1e7 5e4 0.3 0.1 tangential mindlin_rescale NULL 1.0 0.5 rolling sds 2e3 1 0.1{TWISTS}",
}


def after(folder, program, own, other, predict="", **words):
    """Velocities and spins of the first sphere after the collision, every digit."""
    text = deck(f"{own}\npair_coeff 2 2 {other}", predict, STEPS, SLIP, **words)
    text = text.replace("create_box 1", "create_box 2").replace("pair_style", f"{SPIN}pair_style")
    text = text.replace(f"timestep {TIME / STEPS!r}", f"timestep {LONGER * TIME / STEPS!r}")
    run(text.replace("clear\n", ""), folder, program=program)
    sphere = read_dump(folder / f"{STEPS}.dump")[0][1]
    return np.array([sphere[c][0] for c in ("vx", "vy", "vz", "omegax", "omegay", "omegaz")])


@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("own, predict", [("", "rk2"), ("", "rk4 onset on"), (TWISTS, "rk4")])
def test_predicted(tmp_path, own, predict, other):
    alone, beside = (
        after(tmp_path, LAUNCHER, ALONE + own, models, f"predict {predict}") for models in (ALONE + own, OTHERS[other])
    )
    assert np.array_equal(alone, beside), beside - alone
    assert alone[0] < 0 and alone[1] < SLIP / 2 - 0.1 * SPEED, "they have not collided, or not slipped"
    assert own == "" or alone[3] < 20, "they have not twisted"


HOST = {"style": "granular", "integrator": "nve/sphere"}


@pytest.mark.parametrize("other", ["mindlin", "linear_history", "mindlin_rescale/force"])
def test_of_the_host(tmp_path, other):
    """As the page of the style says."""
    alone, beside = (after(tmp_path, STOCK, ALONE, models, **HOST) for models in (ALONE, OTHERS[other]))
    off = abs(beside - alone) / SPEED
    print(f"{other}: in impact speeds velocities are off by {off[:3].max()}, surfaces by {RADIUS * off[3:].max()}")
    if IS_NEWER:
        assert np.array_equal(alone, beside)
    else:
        assert off[1] > 0.1
        predicted = after(tmp_path, LAUNCHER, ALONE, OTHERS[other], "predict rk4")
        assert np.abs(predicted - alone)[:3].max() < 0.02 * SPEED


@pytest.mark.parametrize("other", ["alone", "mindlin"])
def test_of_the_host_where_it_twists(tmp_path, other):
    """At the limit its spring of stiffness 0 is infinitely long."""
    found = after(tmp_path, STOCK, ALONE + TWISTS, OTHERS.get(other, ALONE + TWISTS), **HOST)
    print(other, found)
    assert np.isnan(found[3])
