# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix nve/cfpm says of the time step at the start of a run: contact times, limits of the predictors, advice."""

import math
import re
from itertools import product

import pytest
from harness.liggghts import run
from small_deck import (
    DECK,
    INSERTION,
    MODEL,
    PAIR,
    PAIR_VALUES,
    PLANE,
    TEMPLATE,
    TYPE_VALUES,
    VELOCITY,
    WALL,
    property_lines,
    write,
)

NUMBER = r"([-+.\de]+)"
ROW = re.compile(rf"  (\S.*): +tc = {NUMBER} to {NUMBER}, nt = tc/dt = {NUMBER} to {NUMBER}(.*)")


def report(output):
    """Lines of the report as {who: (shortest tc, longest tc, least nt, most nt)}, and what follows the numbers."""
    rows = {}
    remarks = {}
    for who, *numbers, remark in (match.groups() for match in map(ROW.fullmatch, output.splitlines()) if match):
        assert who not in rows, "reported twice: " + who
        rows[who] = tuple(map(float, numbers))
        remarks[who] = remark
    return rows, remarks


def stiffness(model, mass, radius):
    if model == "hooke/stiffness":
        return PAIR_VALUES["kn"]
    if model == "hertz/stiffness":
        return PAIR_VALUES["kn"] * math.sqrt(radius)
    modulus = TYPE_VALUES["youngsModulus"] / (2.0 * (1.0 - TYPE_VALUES["poissonsRatio"] ** 2))
    if model == "hertz":
        return 4.0 / 3.0 * math.sqrt(radius) * modulus
    root = 16.0 / 15.0 * math.sqrt(radius) * modulus
    return root * (mass * VELOCITY**2 / root) ** 0.2


def contact_time(model, mass, radius, speed=VELOCITY):
    if "hertz" in model:  # T = 3.218 (m/k)^(2/5) u^(-1/5)
        return 3.218065 * (mass / stiffness(model, mass, radius)) ** 0.4 * speed**-0.2
    return math.pi * math.sqrt(mass / stiffness(model, mass, radius))


def expected_rows(model, sizes, dt):
    """sizes: {type: [(radius, density), ...]}"""
    bodies = {t: [(r, 4.0 / 3.0 * math.pi * r**3 * density) for r, density in of] for t, of in sizes.items()}
    times = {}
    for i, j in [(1, 1), (1, 2), (2, 2)]:
        times[f"types {i}-{j}"] = [
            contact_time(model, mi * mj / (mi + mj), ri * rj / (ri + rj))
            for (ri, mi), (rj, mj) in product(bodies[i], bodies[j])
        ]
    for i in (1, 2):
        times[f"type {i}-wall floor"] = [contact_time(model, m, r) for r, m in bodies[i]]
    return {
        who: pytest.approx((min(tc), max(tc), min(tc) / dt, max(tc) / dt), rel=1e-3) for who, tc in times.items()
    }


TWO_SIZES = {1: [(0.025, 800.0), (0.05, 800.0)], 2: [(0.04, 1000.0), (0.1, 1000.0)]}
CREATE_TWO_SIZES = "\n".join(
    f"create_atoms {t} single {0.2 * n} {0.4 * t - 0.6} 0.3 units box\n"
    f"set atom {2 * t - 1 + n} diameter {2 * r} density {density}"
    for t, sizes in TWO_SIZES.items()
    for n, (r, density) in enumerate(sizes)
)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("model", ["hooke", "hooke/stiffness", "hertz", "hertz/stiffness"])
def test_report_of_two_types_and_sizes(tmp_path, model, ranks):
    deck = write(
        particles=CREATE_TWO_SIZES,
        pair=f"{PAIR}model {model} tangential history",
        wall=f"{WALL}model {model} tangential history{PLANE}",
    )
    output = run(deck, tmp_path, np=ranks).stdout
    linear = "gran/cfpm: predict exact, dt = 1e-05; one contact is stable for nt > 1\n"
    hertz = (
        "gran/cfpm: predict rk4, dt = 1e-05; one contact is stable for nt > 2.015; "
        "Hertz: tc of an impact at speed 1, tc ~ speed^(-1/5)\n"
    )
    assert (hertz if "hertz" in model else linear) in output
    assert report(output)[0] == expected_rows(model, TWO_SIZES, 1e-5)
    assert "WARNING: fix nve/cfpm" not in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_report_of_particles_to_come(tmp_path, ranks):
    """A run of no step: nothing is inserted yet."""
    output = run(write(particles="", extra=TEMPLATE + INSERTION, run="run 0"), tmp_path, np=ranks).stdout
    sizes = {1: [(0.02, 800.0)], 2: [(0.05, 1000.0)]}
    assert report(output)[0] == expected_rows("hooke/stiffness", sizes, 1e-5)


def test_report_without_particles(tmp_path):
    output = run(write(particles=""), tmp_path).stdout
    assert "no particles yet" in output
    assert report(output)[0] == {}


@pytest.mark.parametrize("integrator", [DECK["integrator"], "fix one one nve/cfpm\nfix other two nve/cfpm"])
def test_report_once_in_many_runs(tmp_path, integrator):
    output = run(write(integrator=integrator, run="run 1\nrun 0\nrun 1\nrun 1"), tmp_path).stdout
    assert output.count("gran/cfpm: predict ") == 1
    assert len(report(output)[0]) == 5


def test_report_is_in_the_log_file(tmp_path):
    output = run(write(), tmp_path).stdout
    assert report((tmp_path / "log.liggghts").read_text())[0] == report(output)[0] != {}


USES = ("dense beds at rest come out", "flows are", "agitated grains are")
RIGHT_FROM = {"exact": (6, 6, 30), "impulse": (1, 2, 4), "verlet": (6, 6, 6)}


def advice(output):
    """{use: (largest time step, its nt, whether it is a warning)}"""
    use = rf"({'|'.join(USES)}) right up to dt = ([^\s,]+), nt = (\d+)"
    lines = re.findall(rf"(?m)^(WARNING: fix nve/cfpm:|)\s*{use}", output)
    return {use: (float(dt), int(nt), bool(warning)) for warning, use, dt, nt in lines}


@pytest.mark.parametrize("nt", [60, 25, 5.5, 3, 1.5])
@pytest.mark.parametrize("predict", RIGHT_FROM)
def test_advice(tmp_path, predict, nt):
    """For each use the time step that the shortest contact supports: above it a warning. The particles are at rest."""
    deck = write(pair=f"{PAIR}{MODEL} predict {predict}", timestep=f"timestep {SHORTEST / nt}", run="run 0")
    found = advice(run(deck, tmp_path).stdout)
    expected = {
        use: (pytest.approx(SHORTEST / least, rel=1e-3), least, nt < least)
        for use, least in zip(USES, RIGHT_FROM[predict])
    }
    assert found == expected


def test_rayleigh_time(tmp_path):
    output = run(write(), tmp_path).stdout
    young, poisson = TYPE_VALUES["youngsModulus"], TYPE_VALUES["poissonsRatio"]
    shear = young / (2.0 * (1.0 + poisson))
    rayleigh = math.pi * 0.025 * math.sqrt(800.0 / shear) / (0.1631 * poisson + 0.8766)
    found = re.search(r"Rayleigh time of the smallest particle (\S+)\n", output)
    assert float(found[1]) == pytest.approx(rayleigh, rel=1e-3)


def test_new_time_step_is_reported(tmp_path):
    output = run(write(run="run 1\ntimestep 2e-5\nrun 1"), tmp_path).stdout
    assert re.findall(r"gran/cfpm: predict exact, dt = (\S+);", output) == ["1e-05", "2e-05"]


LIMITS = {"exact": 1.0, "rk2": math.pi / 2, "rk4": math.pi / 2, "trapezoid": None, "impulse": None}
SHORTEST = contact_time("hooke/stiffness", 4.0 / 3.0 * math.pi * 0.025**3 * 800.0 / 2.0, 0.0125)


@pytest.mark.parametrize("predictor", LIMITS)
@pytest.mark.parametrize("over", [0.99, 1.01])
def test_warning_of_a_large_step(tmp_path, predictor, over):
    """The time step around the limit of the stiffest contact, two particles of type 1."""
    limit = LIMITS[predictor]
    changes = {"pair": f"{PAIR}{MODEL} predict {predictor}", "timestep": f"timestep {over * SHORTEST / (limit or 0.5)}"}
    output = run(write(**changes), tmp_path).stdout
    said = "no stability limit on one contact" if limit is None else f"one contact is stable for nt > {limit:.4g}"
    assert re.search(rf"gran/cfpm: predict {predictor}, dt = \S+; {re.escape(said)}\n", output)
    assert ("WARNING: fix nve/cfpm: time step too large" in output) == (limit is not None and over > 1.0)


@pytest.mark.parametrize("over", [0.99, 1.01])
def test_warning_of_a_large_step_for_hertz(tmp_path, over):
    """At the impact speed of the deck; a Hertz contact is stiffer in its middle than its duration says."""
    speed = 4.0
    mass = 4.0 / 3.0 * math.pi * 0.025**3 * 800.0 / 2.0
    middle = math.pi / math.sqrt(1.5 * 1.25**0.2) / 3.218065
    limit = math.pi / 2 / middle
    model = "model hertz tangential history"
    changes = {
        "pair": PAIR + model,
        "wall": WALL + model + PLANE,
        "timestep": f"timestep {over * contact_time('hertz', mass, 0.0125, speed) / limit}",
        "properties": property_lines().replace(f"Velocity scalar {VELOCITY}", f"Velocity scalar {speed}"),
    }
    output = run(write(**changes), tmp_path).stdout
    assert f"one contact is stable for nt > {limit:.4g}; Hertz: tc of an impact at speed 4," in output
    assert re.search(r"dense beds at rest come out right up to dt = \S+, nt = 6, as measured with linear", output)
    assert ("WARNING: fix nve/cfpm: time step too large" in output) == (over > 1.0)


def test_hertz_wall_beside_linear_pairs(tmp_path):
    """The row of the wall says which predictor it has and what that can take."""
    output = run(write(wall=WALL + "model hertz" + PLANE), tmp_path).stdout
    remarks = report(output)[1]
    for who, remark in remarks.items():
        assert remark == ("; predict exact, one contact is stable for nt > 1.283" if "wall" in who else "")
    assert "Hertz: tc of an impact at speed 1," in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_warning_names_the_limit_of_a_wall(tmp_path, ranks):
    """A wall with its own predictor has its own limit; no row of a pair has one here."""
    changes = {"pair": f"{PAIR}{MODEL} predict trapezoid", "wall": DECK["wall"] + " predict rk4"}
    output = run(write(timestep="timestep 0.002", **changes), tmp_path, np=ranks).stdout
    assert output.count("WARNING: fix nve/cfpm: time step too large") == 1
    remarks = report(output)[1]
    for who, remark in remarks.items():
        assert remark == ("; predict rk4, one contact is stable for nt > 1.571" if "wall" in who else "")
