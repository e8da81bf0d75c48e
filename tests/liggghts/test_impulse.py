# SPDX-License-Identifier: GPL-2.0-or-later
"""predict impulse: collisions that are exact whatever the step, in the host.

Pairs head-on and spheres on a plane and on a mesh, each with random phases of detection, all in one run. The
restitution has a closed form, see harness/impacts.py.
"""

import numpy as np
import pytest
from harness.impacts import PHASES, RADIUS, SPEED, STEPS_PER_CONTACT, one_at_rest
from harness.liggghts import run
from harness.spheres import Sphere, box, dump, read_motion, write_data, write_stl
from normal_impacts import contact_time, hertz, hooke, restitutions, viscoelastic

TOLERANCE = 1.0e-6
BY_SERIES = 5.0e-6  # see core/motion/viscoelastic_motion.h

CASES = [hooke(zeta) for zeta in (0.0, 0.1, 0.7, 1.2)] + [hertz(e) for e in (0.0501, 0.5, 0.9, 1.0)]
NAMES = [f"Hooke zeta {zeta}" for zeta in (0.0, 0.1, 0.7, 1.2)] + [f"Hertz e {e}" for e in (0.0501, 0.5, 0.9, 1.0)]
CASES += [hooke(zeta, tension=True) for zeta in (0.1, 0.7)] + [hertz(e, tension=True) for e in (0.1, 0.3, 0.9)]
NAMES += [f"Hooke zeta {zeta} tension" for zeta in (0.1, 0.7)] + [f"Hertz e {e} tension" for e in (0.1, 0.3, 0.9)]


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_restitution_is_exact_at_any_step(tmp_path, case):
    material, model, settings, expected = case
    for nt in STEPS_PER_CONTACT:
        found = restitutions(tmp_path, material, model, settings, contact_time(model) / nt)
        error = np.abs(found - expected).max(axis=1)
        print(f"nt = {nt:.2f}: e = {found.mean():.7f} +- {found.std():.1e}, exact {expected:.7f}, off {error}")
        assert error.max() <= TOLERANCE


@pytest.mark.parametrize("alpha, tension", [(0.1, True), (1.0, True), (1.0, False)])
def test_restitution_of_viscoelastic_contacts(tmp_path, alpha, tension):
    material, model, settings, expected = viscoelastic(alpha, tension)
    for nt in STEPS_PER_CONTACT:
        error = np.abs(restitutions(tmp_path, material, model, settings, contact_time(model) / nt) - expected)
        print(f"nt = {nt:.2f}: exact {expected:.7f}, off {error.max(axis=1)}")
        assert error.max() <= BY_SERIES


@pytest.mark.parametrize("case", [CASES[2], CASES[5]], ids=[NAMES[2], NAMES[5]])
def test_restitution_with_gravity(tmp_path, case):
    """The contact does not know of gravity, which acts once a step: what it gives in the steps of touch and of release,
    at most g dt each, acts after the collision instead of before it, where it would have been turned round, or the
    other way; and within the contact the law itself gives another restitution by about g T/v, T < 2 tc. In all
    |error| <= (1 + e) g (2 tc + 2 dt)/v."""
    material, model, settings, expected = case
    tc = contact_time(model)
    for nt in STEPS_PER_CONTACT:
        found = restitutions(tmp_path, material, model, settings, tc / nt, gravity=9.81)
        error = np.abs(found - expected).max(axis=1)
        bound = (1.0 + expected) * 9.81 * (2.0 + 2.0 / nt) * tc / SPEED
        print(f"nt = {nt:.2f}: off by {error}, bound {bound:.1e}")
        assert error[0] <= TOLERANCE and error[1:].max() <= bound
        assert error[1:].max() > TOLERANCE  # gravity is there


@pytest.mark.parametrize("ranks", [1, 2])
def test_late_detection_without_onset(tmp_path, ranks):
    """What onset is for: without it contacts begin up to a step late."""
    material, model, settings, expected = CASES[2]
    dt = contact_time(model) / 3.0
    late = restitutions(tmp_path, material, model, settings, dt, ranks, predict="impulse onset off", walls="exact")
    assert late[0].std() > 0.05
    found = restitutions(tmp_path, material, model, settings, dt, ranks)
    assert np.abs(found - expected).max() <= TOLERANCE


def test_frozen_particles_stay(tmp_path):
    """fix freeze clears their forces; nothing shifts them either."""
    dt = contact_time("hooke/stiffness") / 3
    write_data(tmp_path / "spheres.data", one_at_rest(dt), low=-0.3, high=0.3, types=2)
    material, model, settings, _ = hooke(0.1)
    deck = box(dt, skin=0.002) + material
    deck += f"""
pair_style gran/cfpm model {model} tangential history predict impulse {settings}
pair_coeff * *
group still id 1
fix still still freeze
fix integrate all nve/cfpm
"""
    run(deck + dump(12) + "run 12\n", tmp_path)
    moved = read_motion(tmp_path / "motion.dump")[1][-1]
    assert not moved[0].any()
    assert moved[1, 3] > 0.5 * SPEED, "they did not meet"


@pytest.mark.parametrize("nt", [3, 1, 1 / 3])
def test_restitution_at_a_moving_mesh(tmp_path, nt):
    """Spheres at rest that a plate hits from below."""
    material, model, settings, expected = CASES[2]
    dt = contact_time(model) / nt
    ahead = SPEED * dt * np.random.default_rng(5).uniform(4.0, 7.0, PHASES)  # its speed is 0 in the setup
    places = [(0.03 * (k % 9) - 0.2, 0.03 * (k // 9) - 0.2, RADIUS + z) for k, z in enumerate(ahead)]
    spheres = [Sphere(place, radius=RADIUS) for place in places]
    write_data(tmp_path / "spheres.data", spheres, low=-0.3, high=0.3, types=2)
    write_stl(tmp_path / "plate.stl", [(-0.29, -0.29, 0), (0.29, -0.28, 0), (0.29, 0.29, 0), (-0.28, 0.29, 0)])
    words = f"model {model} tangential history predict impulse"
    steps = int(np.ceil(3.0 * nt)) + 10
    deck = box(dt, skin=0.002) + material
    deck += f"""
pair_style gran/cfpm {words} {settings}
pair_coeff * *
fix plate all mesh/surface file plate.stl type 2
fix drive all move/mesh mesh plate linear 0 0 {SPEED}
fix mesh all wall/gran/cfpm {words} mesh n_meshes 1 meshes plate {settings}
fix integrate all nve/cfpm
"""
    run(deck + dump(steps) + f"run {steps}\n", tmp_path)
    found = read_motion(tmp_path / "motion.dump")[1][-1, :, 5] / SPEED - 1.0
    print(f"e = {found.mean():.9f} +- {found.std():.1e}, exact {expected:.9f}")
    assert np.abs(found - expected).max() <= TOLERANCE


@pytest.mark.parametrize("pairs, floor", [("impulse", "impulse"), ("exact", "impulse"), ("impulse", "exact")])
def test_all_contacts_are_counted(tmp_path, pairs, floor):
    """Those of other predictors hold a particle too."""
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, z * RADIUS), radius=RADIUS) for z in (0.999, 2.998)], types=2)
    material, model, settings, _ = hooke(0.1)
    words = f"model {model} tangential history predict"
    deck = box(contact_time("hooke/stiffness"), skin=0.002) + material
    deck += f"""
pair_style gran/cfpm {words} {pairs} {settings}
pair_coeff * *
fix floor all wall/gran/cfpm {words} {floor} primitive type 2 zplane 0.0 {settings}
fix integrate all nve/cfpm
"""
    run(deck + "run 0\n" + dump(columns=["f_cfpmContacts"]) + "run 1\n", tmp_path)
    assert (read_motion(tmp_path / "motion.dump", ["f_cfpmContacts"])[1][0] == [[2], [1]]).all()


def test_friction_begins_anew_after_other_predictors(tmp_path):
    """What a wall keeps of the spring of its last impulses is not that of the contact any more: a sphere that is
    stopped meanwhile has no friction."""
    write_data(tmp_path / "spheres.data", [Sphere((0, 0, 0.99 * RADIUS), v=(0.1, 0, 0), radius=RADIUS)], types=2)
    material, model, settings, _ = hooke(0.1)
    words = f"model {model} tangential history"
    pair = f"pair_style gran/cfpm {words} predict {{}} {settings}\npair_coeff * *\n"
    stop = "velocity all set 0 0 0 units box\nset group all omegax 0 omegay 0 omegaz 0\n"
    deck = box(contact_time(model) / 30, skin=0.002) + material + pair.format("impulse")
    deck += f"""
fix floor all wall/gran/cfpm {words} primitive type 2 zplane 0.0 {settings}
fix integrate all nve/cfpm
"""
    forces = ["fx", "fy", "fz"]
    deck += dump(columns=forces) + "run 2\n"
    deck += f"undump motion\n{stop}{pair.format('exact')}run 0\n{pair.format('impulse')}"
    run(deck + dump(name="stopped.dump", columns=forces) + "run 0\n", tmp_path)
    sliding, stopped = (read_motion(tmp_path / name, forces)[1][-1, 0] for name in ("motion.dump", "stopped.dump"))
    assert sliding[0] < 0.0 < stopped[2]
    assert stopped[0] == 0.0
