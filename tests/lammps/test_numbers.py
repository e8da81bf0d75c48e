# SPDX-License-Identifier: GPL-2.0-or-later
"""What is not a finite number stops the run at every place where the plugin reads one, as it does in the host's styles.

The host takes digits, signs, points and e or E only, so neither nan and inf nor hexadecimal numbers; what it then makes
of 1e999 and of 5e (inf and 5) is refused here as well.
"""

import pytest
from harness.output import first_error
from test_bad_input import attempt, pair, wall

CONTACT = ["hooke", "1e5", "2e4", "100", "50", "0.3", "1"]
NO_NUMBERS = ["nan", "-nan", "inf", "-inf", "infinity", "0x10", "1e999", "-1e999", "5e", "1.2.3", "1e5-e", ".", "5d3"]
NO_NUMBERS += ["1_0", "5x", '" 5"', '"5 "', '""']


def contact_with(place, word):
    return " ".join(CONTACT[:place] + [word] + CONTACT[place + 1 :])


def at(contact):
    return {"extra": f"fix w all wall/gran/cfpm {contact} zplane -1 NULL"}


# name: the changes of the deck with a word there, and what the message says of it and expects
CONSTANTS = ["Kn", "Kt", "gamma_n", "gamma_t", "xmu"]
PLACES = {
    **{
        f"pair_{name}": (lambda word, k=k: pair(contact_with(k, word)), name, "a number that is not negative")
        for k, name in enumerate(CONSTANTS, 1)
    },
    **{
        f"wall_{name}": (lambda word, k=k: at(contact_with(k, word)), name, "a number that is not negative")
        for k, name in enumerate(CONSTANTS, 1)
    },
    "split": (lambda word: pair(f"{contact_with(6, '1')} predict impulse split {word}"), "split", "from 0 to 1"),
    "lo": (lambda word: wall(f"zplane {word} NULL"), "found", "a lower position or NULL"),
    "hi": (lambda word: wall(f"xplane NULL {word}"), "found", "an upper position or NULL"),
    "radius": (lambda word: wall(f"zcylinder {word}"), "found", "a positive radius of the cylinder"),
    "amplitude": (lambda word: wall(f"zplane -1 NULL wiggle z {word} 1"), "found", "an amplitude"),
    "period": (lambda word: wall(f"zplane -1 NULL wiggle z 1 {word}"), "found", "a positive period"),
    "shear": (lambda word: wall(f"zplane -1 NULL shear x {word}"), "found", "a speed"),
}


def check_refused(folder, changes, name, word, expected, ranks):
    error = first_error(attempt(folder, ranks, changes))
    command = "fix wall/gran/cfpm (id w)" if "extra" in changes else "pair_style gran/cfpm"
    found = "found" if name == "found" else f"{name} is"
    found += " '" + word.strip('"') + "'; expected "
    assert f"{command}: {found}" in error and expected in error, error
    assert not error.startswith("ERROR on proc"), "on one rank only"


@pytest.mark.parametrize("place", PLACES)
def test_nan_is_refused(tmp_path, place):
    changes, name, expected = PLACES[place]
    check_refused(tmp_path, changes("nan"), name, "nan", expected, ranks=2)


@pytest.mark.parametrize("word", NO_NUMBERS)
@pytest.mark.parametrize("place", ["pair_Kn", "split", "radius", "shear"])
def test_no_number_is_refused(tmp_path, place, word):
    changes, name, expected = PLACES[place]
    check_refused(tmp_path, changes(word), name, word, expected, ranks=1)


@pytest.mark.parametrize("place, word", [("radius", "0"), ("radius", "-0.5"), ("period", "0"), ("period", "-1")])
def test_what_must_be_positive(tmp_path, place, word):
    changes, name, expected = PLACES[place]
    check_refused(tmp_path, changes(word), name, word, expected, ranks=1)


@pytest.mark.parametrize("word", ["+1", "1.", ".5", "5E-1", "0.05e+1", "00.5", "1e-300", "-0.0"])
def test_numbers_as_the_host_takes_them(tmp_path, word):
    for place in ("pair_Kt", "wall_gamma_n", "split", "lo", "amplitude", "shear"):
        process = attempt(tmp_path, 1, PLACES[place][0](word))
        assert process.returncode == 0, place + process.stdout[-2000:]


@pytest.mark.parametrize("planes, warned", [("0.1 -0.1", True), ("0 0", False)], ids=["crossed", "equal"])
def test_planes_that_cross_are_the_hosts(tmp_path, planes, warned):
    """The host asks for no order of lo and hi. Where lo is above hi it takes the farther plane for the nearer one, so
    that particles reach none of them: they go through, as in the host, but a warning says so. One position for both is
    a sheet with particles on either side, which throws them back.
    """
    ends = {}
    for predictor, integrator in (("none", "nve/sphere"), ("rk4", "nve/cfpm")):
        changes = {
            "style": "atom_style sphere\natom_modify map array",
            **pair(f"{contact_with(6, '1')} predict {predictor}"),
            "integrator": f"fix integrate all {integrator}",
            **wall(f"zplane {planes} predict {predictor}"),
            "run": "set atom 1 z 0.2\nset atom 2 z -0.2\nvelocity one set 0 0 -1 units box\n"
            "velocity two set 0 0 1 units box\ntimestep 1e-5\nrun 30000\n"
            "variable a equal vz[1]\nvariable b equal vz[2]\nprint 'V ${a} ${b}'",
        }
        output = attempt(tmp_path, 1, changes).stdout
        line = [line for line in output.splitlines() if line.startswith("V ")]
        assert line, output[-2000:]
        ends[predictor] = [float(x) for x in line[0].split()[1:]]
    assert ends["rk4"] == pytest.approx(ends["none"], rel=0.02)
    assert ends["none"] == [-1, 1] if warned else ends["none"][0] > 0.5
    warning = "WARNING: fix wall/gran/cfpm (id w): the lower position 0.1 is above the upper one -0.1"
    assert (warning in output) == warned, output[-2000:]
