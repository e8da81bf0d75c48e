# SPDX-License-Identifier: GPL-2.0-or-later
"""A particle that comes to no finite position stops the run in the step in which it does, by its number. Two centres at
one place, whose contact has no direction, are both named. With 'predict none' all is as in the host, which looks at
positions when it lists neighbours anew only.
"""

import pytest
from harness.output import first_error
from test_bad_input import HOOKE, attempt, pair, particles

HERTZ = "hertz 1e7 NULL 100 NULL 0.3 1"
STYLES = [f"{HOOKE} predict {p}" for p in ("exact", "trapezoid", "rk2", "rk4", "impulse", "impulse onset off")]
STYLES += [f"{HERTZ} predict {p}" for p in ("rk2", "rk4")]
THREE = particles((-0.3, 0.3, 0.3))


def deck(style, **changes):
    return {"particles": THREE, **pair(style), **changes}


def error_of(folder, ranks, changes):
    return first_error(attempt(folder, ranks, changes))


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("style", STYLES)
def test_two_at_one_place_are_named(tmp_path, style, ranks, newton):
    error = error_of(tmp_path, ranks, deck(style, velocity=f"newton {newton}\ncomm_modify vel yes"))
    assert (
        "fix nve/cfpm: particle 2 has no finite position after step 1: it was at one place with particle 3" in error
        or "fix nve/cfpm: particle 3 has no finite position after step 1: it was at one place with particle 2" in error
    ), error
    assert "expected particles apart from each other" in error


@pytest.mark.parametrize("case", ["frozen", "moved", "in_another_fix"])
def test_also_beside_one_that_the_fix_does_not_move(tmp_path, case):
    other = {
        "frozen": {"extra": "fix other three freeze"},
        "moved": {"integrator": "fix i two nve/cfpm", "extra": "fix other three move linear 0 0 0"},
        "in_another_fix": {"integrator": "fix i two nve/cfpm\nfix j three nve/cfpm"},
    }[case]
    error = error_of(tmp_path, 1, deck(HOOKE, **other))
    assert "particle 2 has no finite position after step 1: it was at one place with particle 3" in error, error


def test_across_ranks(tmp_path):
    """At the border of two ranks, one of the two may be known as a neighbour of the other rank's only."""
    border = particles((-0.3, 0, 0))
    error = error_of(tmp_path, 2, {**deck(HOOKE), "particles": border})
    assert "at one place with particle" in error, error


WITHOUT_DIRECTION = {
    "force": "variable x atom 1e308*1e308\nfix a two addforce v_x 0 0",
    # the centre of a particle on the wall of a region: as for two particles
    "region": f"region r plane 0.3 0 0 1 0 0\nfix w all wall/gran/cfpm {HOOKE} region r",
}


@pytest.mark.parametrize("predictor", ["exact", "impulse"])
@pytest.mark.parametrize("case", WITHOUT_DIRECTION)
def test_one_alone(tmp_path, case, predictor):
    style = f"{HOOKE} predict {predictor}"
    error = error_of(tmp_path, 1, {**pair(style), "extra": WITHOUT_DIRECTION[case]})
    assert "fix nve/cfpm: particle 2 has no finite position after step 1; expected finite forces" in error, error


@pytest.mark.parametrize("onset", ["on", "off"])
@pytest.mark.parametrize("speed", ["1e308*1e308", "1e308*1e308*0"], ids=["inf", "nan"])
def test_a_velocity_without_end(tmp_path, speed, onset):
    changes = {
        **pair(f"{HOOKE} predict impulse onset {onset}"),
        "extra": f"variable v atom {speed}\nvelocity two set v_v NULL NULL units box",
    }
    error = error_of(tmp_path, 2, changes)
    assert "fix nve/cfpm: particle 2 has no finite position after step 1; expected" in error, error


def test_later_in_a_run(tmp_path):
    changes = deck(HOOKE, run="set atom 3 x 0.5\nrun 3\nset atom 3 x 0.3\nrun 3")
    changes["style"] = "atom_style sphere\natom_modify map array"
    error = error_of(tmp_path, 1, changes)
    assert "particle 2 has no finite position after step 4: it was at one place with particle 3" in error, error


def test_predict_none_is_the_host(tmp_path):
    states = {}
    for name, style in (
        ("stock", "pair_style gran/hooke/history " + HOOKE.replace("hooke ", "")),
        ("none", f"pair_style gran/cfpm {HOOKE} predict none"),
    ):
        changes = {"particles": THREE, "pair": style, "integrator": "fix i all nve/sphere"}
        changes["run"] = "thermo_style custom step ke pe\nrun 5"
        output = attempt(tmp_path, 1, changes).stdout
        states[name] = [line for line in output.splitlines() if line.split()[:1] == ["5"]]
    assert states["none"] == states["stock"] and "nan" in states["none"][0], states
