# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse: collisions that are exact whatever the step, in the host.

Pairs head-on and spheres on a plane, on a plane region at rest and on one that moves, each with random phases of
detection, all in one run. The restitution has a closed form, see harness/impacts.py.
"""

from math import pi

import numpy as np
import pytest
from harness.cloud import CLOUD, CLOUD_DT
from harness.impacts import PAIR_MASS, PHASES, RADIUS, SPEED, TC, linear_restitution, one_at_rest
from harness.lammps import run
from harness.spheres import Sphere, read_motion, write_data
from normal_impacts import ROUNDING, WALLS, contact, head, motion, restitutions

WINDOW = 60  # steps between the states in which the momentum of the cloud is compared


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("zeta, limit", [(z, "limit_damping") for z in (0.0, 0.1, 0.7, 1.2)] + [(0.1, ""), (0.7, "")])
def test_restitution_is_exact_at_any_step(tmp_path, zeta, limit, newton, ranks):
    expected = linear_restitution(zeta, tension=not limit)
    for nt, found in restitutions(tmp_path, zeta, ranks, newton, limit).items():
        error = np.abs(found - expected).max(axis=1)
        print(f"nt = {nt:.2f}: e = {found.mean():.7f} +- {found.std():.1e}, exact {expected:.7f}, off {error}")
        assert error.max() <= ROUNDING


CURVED = {  # a region if there is one, and the wall
    "zcylinder": ("", "zcylinder 0.2"),
    "region_cylinder": ("region W cylinder z 0 0 0.2 -0.3 0.3 units box\n", "region W"),
    "region_sphere": ("region W sphere 0 0 0 0.2 units box\n", "region W"),
}


@pytest.mark.parametrize("wall", CURVED)
def test_restitution_at_curved_walls(tmp_path, wall):
    """Of spheres that meet them at right angles, in all directions."""
    region, shape = CURVED[wall]
    zeta, dt, count = 0.3, TC / 2, 25
    random = np.random.default_rng(5)
    angle = 2.0 * np.pi / count * np.arange(count)
    out = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
    from_axis = 0.2 - RADIUS - SPEED * dt * random.uniform(0.0, 3.0, count)
    spheres = [Sphere(tuple(r * n), v=tuple(SPEED * n), radius=RADIUS) for r, n in zip(from_axis, out)]
    write_data(tmp_path / "spheres.data", spheres, low=-0.3, high=0.3, types=1)
    deck = head(dt) + region
    deck += f"""
pair_style gran/cfpm {contact(zeta, PAIR_MASS)} predict impulse
pair_coeff * *
fix wall all wall/gran/cfpm {contact(zeta, 2.0 * PAIR_MASS)} {shape}
fix integrate all nve/cfpm
"""
    run(deck + motion(12) + "run 12\n", tmp_path)
    v = read_motion(tmp_path / "motion.dump")[1][-1, :, 3:6]
    restitution = -(v * out).sum(axis=1) / SPEED
    assert np.abs(restitution - linear_restitution(zeta)).max() <= ROUNDING


@pytest.mark.parametrize("ranks", [1, 2])
def test_no_pair_is_missed(tmp_path, ranks):
    """Pairs come from beyond the skin, as far as half of it in a step, while the host alone would look at its list of
    neighbours every tenth step only."""
    zeta, dt = 0.3, TC
    skin = 2.02 * (0.5 * SPEED * dt)
    random = np.random.default_rng(6)
    spheres = []
    for k in range(PHASES):
        x, y = 0.06 * (k % 9) - 0.24, 0.06 * (k // 9) - 0.24
        for side in (-1, 1):
            place = (x + side * (RADIUS + 0.5 * SPEED * dt * random.uniform(10.0, 40.0)), y, 0.0)
            spheres.append(Sphere(place, v=(-0.5 * side * SPEED, 0.0, 0.0), radius=RADIUS))
    write_data(tmp_path / "spheres.data", spheres, low=-0.3, high=0.3, types=1)
    deck = head(dt, skin=repr(skin)).replace("delay 0", "delay 10")
    deck += f"""
pair_style gran/cfpm {contact(zeta, PAIR_MASS)} predict impulse
pair_coeff * *
fix integrate all nve/cfpm
"""
    run(deck + motion(60) + "run 60\n", tmp_path, np=ranks)
    v = read_motion(tmp_path / "motion.dump")[1][-1, :, 3].reshape(PHASES, 2)
    error = np.abs((v[:, 1] - v[:, 0]) / SPEED - linear_restitution(zeta))
    assert error.max() <= ROUNDING, f"{np.count_nonzero(error > ROUNDING)} of {PHASES} pairs were missed"


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 1), ("off", 2), ("on", 2)])
@pytest.mark.parametrize("predict", ["impulse", "impulse split 0.5"])
def test_momentum(tmp_path, predict, newton, ranks):
    """The impulses of a contact are opposite, and so is what shifts the positions, or the centre of mass would stray:
    see tests/liggghts/test_conservation.py."""
    write_data(tmp_path / "spheres.data", CLOUD, low=-0.4, high=0.4, types=1)
    deck = head(CLOUD_DT, skin=0.01, newton=newton)
    deck += f"""
pair_style gran/cfpm hooke 2e4 8e3 80 40 0.4 1 predict {predict}
pair_coeff * *
fix integrate all nve/cfpm
"""
    run(deck + motion(WINDOW) + f"run {2 * WINDOW}\n", tmp_path, np=ranks)
    moved = read_motion(tmp_path / "motion.dump")[1].astype(np.longdouble)
    x, v = moved[..., :3], moved[..., 3:6]
    m = np.array([s.mass for s in CLOUD], dtype=np.longdouble)
    momentum = (m[:, None] * v).sum(axis=1)
    scale = (m[:, None] * np.abs(v[0])).sum()
    # every contact rounds two velocities, 14 contacts of a sphere at most
    steps = 2 * WINDOW
    assert np.abs(momentum - momentum[0]).max() <= 14 * steps * 2.0**-53 * scale
    centre = (m[:, None] * x).sum(axis=1) / m.sum()
    stray = np.abs(centre[-1] - centre[0] - steps * np.longdouble(CLOUD_DT) * momentum[0] / m.sum()).max()
    bound = 4 * 2.0**-53 * steps * (np.abs(x).max() + CLOUD_DT * np.abs(v).max())
    print(f"centre of mass strays by {float(stray):.2e}, bound {float(bound):.2e}")
    assert stray <= bound
    assert np.abs(v[-1] - v[0]).max() > 1.0, "they did not meet"


def test_frozen_particles_stay(tmp_path):
    """fix freeze clears their forces; nothing shifts them either, and their partner is reflected as by a wall."""
    zeta, dt = 0.3, TC / 3
    write_data(tmp_path / "spheres.data", one_at_rest(dt), low=-0.3, high=0.3, types=1)
    deck = head(dt) + f"""
pair_style gran/cfpm {contact(zeta, 2.0 * PAIR_MASS)} predict impulse
pair_coeff * *
group still id 1
fix still still freeze
fix integrate all nve/cfpm
"""
    run(deck + motion(12) + "run 12\n", tmp_path)
    moved = read_motion(tmp_path / "motion.dump")[1][-1]
    assert not moved[0].any()
    assert abs(moved[1, 3] / SPEED - linear_restitution(zeta)) <= ROUNDING


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("nt", [1, 3, 30])
def test_rest(tmp_path, nt, newton):
    """A sphere on the floor, one on a plate at rest, and a sphere between: none has a velocity in the end."""
    dt = TC / nt
    heights = (RADIUS, WALLS[1] + RADIUS, WALLS[1] + 3.0 * RADIUS)
    places = zip((-0.1, 0.1, 0.1), heights)
    write_data(tmp_path / "spheres.data", [Sphere((x, 0.0, z), radius=RADIUS) for x, z in places], -0.3, 0.3, types=1)
    wall = contact(0.5, 2.0 * PAIR_MASS)
    steps = 30_000
    run(
        head(dt, newton=newton)
        + f"""
pair_style gran/cfpm {contact(0.5, PAIR_MASS)} predict impulse
pair_coeff * *
region plate plane 0 0 {WALLS[1]} 0 0 1 units box
group on_plate id 2 3
group on_floor id 1
fix plate on_plate wall/gran/cfpm {wall} region plate
fix floor on_floor wall/gran/cfpm {wall} zplane 0 NULL
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/cfpm
{motion(steps)}run {steps}
""",
        tmp_path,
    )
    end = read_motion(tmp_path / "motion.dump")[1][-1]
    print(f"nt = {nt}, newton {newton}: speeds over g tc", np.abs(end[:, 3:6]).max(axis=1) / (9.81 * TC))
    assert (end[:, 2] < heights).all()
    # positions are rounded by half an ulp a step, forces with them: k/m = (pi/TC)^2 at most, damped within a few TC
    rounding = 4.0 * pi**2 * np.spacing(max(heights)) / TC
    assert np.abs(end[:, 3:]).max() <= 1e-9 * 9.81 * TC + rounding < 1e-6 * 9.81 * TC
