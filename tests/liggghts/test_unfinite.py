# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers that are none stop the run with a message: in commands, as properties, and where particles would go.

The host refuses the words nan and inf and hexadecimal numbers itself where it reads them, but takes a number that is
too large, 1e999, as infinity: a wall there does not exist, and a run with infinite friction goes on.
"""

import pytest
from harness.liggghts import run
from small_deck import (
    DECK,
    MODEL,
    PAIR,
    PLANE,
    STOCK_INTEGRATOR,
    WALL,
    assert_refused,
    attempt,
    property_lines,
    write,
)

BAD = ["nan", "inf", "-inf", "0x1p-1", "1e999", "-1e999", "1.0e", "0.1m"]
WALLS = {
    "zplane {}": "position of primitive wall 'zplane'",
    "xcylinder {} 0 0": "radius of primitive wall 'xcylinder'",
    "ycylinder 0.9 {} 0": "centre1 of primitive wall 'ycylinder'",
    "zcylinder 0.9 0 {}": "centre2 of primitive wall 'zcylinder'",
    "zplane 0.0 shear x {}": "velocity of 'shear'",
}


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("number", BAD)
def test_wall(tmp_path, number, wall):
    process = attempt(tmp_path, 1, {"wall": f"{WALL}{MODEL} primitive type 1 {wall.format(number)}"})
    wanted = f"fix wall/gran/cfpm (id floor): {WALLS[wall]} is '{number}'; expected a finite number"
    assert_refused(process, [wanted])


@pytest.mark.parametrize("number", BAD)
def test_split(tmp_path, number):
    process = attempt(tmp_path, 1, {"pair": f"{PAIR}{MODEL} predict impulse split {number}"})
    assert_refused(process, [f"pair_style gran/cfpm: split is '{number}'; expected a number from 0 to 1"])


@pytest.mark.parametrize("name", ["kn", "kt", "gamman", "gammat", "coefficientFriction"])
def test_property(tmp_path, name):
    line = f"\nfix huge all property/global {name} peratomtypepair 2 1 1 1 1e999"
    process = attempt(tmp_path, 1, {"properties": property_lines(without=name) + line})
    assert_refused(process, [f"pair_style gran/cfpm: material property '{name}' is inf; expected a finite number"])


@pytest.mark.parametrize("ranks", [1, 2])
def test_characteristic_velocity(tmp_path, ranks):
    name = "characteristicVelocity"
    line = f"\nfix huge all property/global {name} scalar 1e999"
    changes = {"pair": PAIR + "model hooke", "wall": WALL + "model hooke" + PLANE}
    process = attempt(tmp_path, ranks, {**changes, "properties": property_lines(without=name) + line})
    assert_refused(process, [f"material property '{name}' is inf; expected a finite number"])


# --- positions --------------------------------------------------------------------------------------------------------

PREDICTORS = ["exact", "trapezoid", "rk2", "rk4", "exact onset on", "impulse", "impulse onset off"]
ONE = "create_atoms 1 single 0 0 0.7 units box\n"
DIAMETERS = "set type 1 diameter 0.05 density 800"
NO_POSITION = "has no finite position after the step"
AT_ONE_PLACE = [f"fix nve/cfpm: particle 4 {NO_POSITION}; it and particle 5 were at one place, (0, 0, 0.7)"]
NOWHERE = {
    "in_a_wall": ({"particles": DECK["particles"].replace("-0.3 0 0.3", "-0.3 0 0.0")}, "expected no centre in a wall"),
    "speed": ({"run": "velocity one set 0 1e999 0\nrun 2"}, "finite velocities"),
    "force": ({"extra": "fix push one addforce 0 0 1e999"}, "and forces"),
    "step": ({"timestep": "timestep 1e999"}, "finite velocities"),
}


def predicted(predict):
    return {"pair": f"{PAIR}{MODEL} predict {predict}"}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("predict", PREDICTORS)
def test_two_particles_at_one_place(tmp_path, predict, ranks):
    particles = f"{DECK['particles']}\n{ONE}{ONE}{DIAMETERS}"
    assert_refused(attempt(tmp_path, ranks, {**predicted(predict), "particles": particles}), AT_ONE_PLACE)


@pytest.mark.parametrize("predict", PREDICTORS)
def test_two_particles_brought_to_one_place(tmp_path, predict):
    again = f"run 2\n{ONE}{ONE}{DIAMETERS}\nrun 2"
    assert_refused(attempt(tmp_path, 1, {**predicted(predict), "run": again}), AT_ONE_PLACE)


@pytest.mark.parametrize("predict", ["exact", "impulse"])
@pytest.mark.parametrize("case", NOWHERE)
def test_no_position(tmp_path, case, predict):
    changes, reason = NOWHERE[case]
    process = attempt(tmp_path, 1, {**predicted(predict), **changes})
    assert_refused(process, [f"fix nve/cfpm: particle 1 {NO_POSITION}", reason])


def test_stock_goes_on(tmp_path):
    """What is not predicted is left to the host."""
    particles = f"{DECK['particles']}\n{ONE}{ONE}{DIAMETERS}"
    run(write(**predicted("none"), particles=particles, integrator=STOCK_INTEGRATOR), tmp_path)
