# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run says of itself: steps per contact, the paper to cite, the force of every contact."""

import re

import numpy as np
import pytest
from drum import CONTACT, FRESH, deck
from harness.decks import box
from harness.lammps import run
from harness.output import read_dump, vectors

NUMBER = r"([-+.\de]+)"
ROW = re.compile(rf"^  (\S.*?): +tc = {NUMBER} to {NUMBER}, nt = tc/dt = {NUMBER} to {NUMBER}(.*)$", re.MULTILINE)
K = 2.0e4
SMALL, LARGE, DENSITY = 0.004, 0.01, 2500.0  # radii


def mass(radius):
    return 4 / 3 * np.pi * radius**3 * DENSITY


def two_sizes(law="hooke 2e4 NULL 100 NULL 0.5 1", wall="", dt=2.0e-5, extra=""):
    return f"""{box("lammps")}
create_atoms 1 single -0.3 0 0 units box
create_atoms 1 single 0.3 0 0 units box
group small id 1
group large id 2
set group small diameter {2 * SMALL} density {DENSITY}
set group large diameter {2 * LARGE} density {DENSITY}
pair_style gran/cfpm {law}
pair_coeff * *
fix floor all wall/gran/cfpm {law} {wall} zplane -1 NULL
fix integrate all nve/cfpm
timestep {dt}
{extra}
run 1
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_report(tmp_path, ranks):
    """tc = pi sqrt(m/k), the reduced mass of a pair is half of the particle's, at a wall it is the particle's."""
    output = run(two_sizes(), tmp_path, np=ranks).stdout
    assert "gran/cfpm: predict exact, dt = 2e-05; one contact is stable for nt > 1\n" in output
    rows = {row[0]: [float(number) for number in row[1:5]] for row in ROW.findall(output)}
    assert set(rows) == {"pairs", "wall floor"}
    for who, share in (("pairs", 0.5), ("wall floor", 1.0)):
        times = [np.pi * np.sqrt(share * mass(radius) / K) for radius in (SMALL, LARGE)]
        assert rows[who] == pytest.approx([*times, times[0] / 2e-5, times[1] / 2e-5], rel=1e-3)


def test_report_of_hertz(tmp_path):
    """tc = 3.2181 (m/k)^(2/5) u^(-1/5) at speed 1, k = Kn sqrt(R); rk4 is stable for t* < 2/pi 0.7795."""
    output = run(two_sizes("hertz 1e7 NULL 5e4 NULL 0.5 1", wall="predict rk2"), tmp_path).stdout
    assert "gran/cfpm: predict rk4, dt = 2e-05; one contact is stable for nt > 2.015; Hertz: tc of an impact" in output
    rows = {row[0]: row[1:] for row in ROW.findall(output)}
    tc = 3.2181 * (0.5 * mass(SMALL) / (1e7 * np.sqrt(0.5 * SMALL))) ** 0.4
    assert float(rows["pairs"][0]) == pytest.approx(tc, rel=1e-3)
    assert "predict rk2" in rows["wall floor"][4]


def test_warns_of_a_large_step(tmp_path):
    tc = np.pi * np.sqrt(0.5 * mass(SMALL) / K)
    warning = "WARNING: fix nve/cfpm: time step too large for the predictor"
    assert warning not in run(two_sizes(dt=0.99 * tc), tmp_path).stdout
    assert warning in run(two_sizes(dt=1.01 * tc), tmp_path).stdout
    assert warning not in run(two_sizes("hooke 2e4 NULL 100 NULL 0.5 1 predict trapezoid", dt=tc), tmp_path).stdout


@pytest.mark.parametrize("sizes", ["one {1}", "range {0} {1}", "poly 2 {0} 0.6 {1} 0.4"])
def test_reports_what_will_be_poured(tmp_path, sizes):
    """Once, before there are any; the densities are a range as well."""
    pour = f"""
delete_atoms group all
region slab block -0.1 0.1 -0.1 0.1 0 0.2 units box
fix gravity all gravity 9.81 vector 0 0 -1
fix pour all pour 20 1 4771 region slab dens {DENSITY} {4 * DENSITY} diam {sizes.format(2 * SMALL, 2 * LARGE)} vol 0.2 9
run 200
run 200"""
    output = run(two_sizes(extra=pour), tmp_path, np=2).stdout
    (first, *others) = [row for row in ROW.findall(output) if row[0] == "pairs"]
    smallest = LARGE if "one" in sizes else SMALL
    times = [np.pi * np.sqrt(0.5 * m / K) for m in (mass(smallest), 4 * mass(LARGE))]
    assert others == [] and [float(time) for time in first[1:3]] == pytest.approx(times, rel=1e-3)


def test_asks_to_be_cited(tmp_path):
    run(two_sizes(), tmp_path, options=["-log", "log.lammps"])
    assert "A Fast Algorithm for the Discrete Element Method by Contact Force Prediction" in (
        tmp_path / "log.lammps"
    ).read_text()


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("law", CONTACT)
def test_forces_of_contacts(tmp_path, law, ranks):
    """compute pair/local: the forces of its contacts add up to the force on a sphere.

    The host asks for pairs that touch only, so nothing may begin inside a step.
    """
    scattering = deck(FRESH, law, walls=()).replace("gravity 9.81", "gravity 0.0")
    scattering = scattering.replace(" onset on", "").replace("predict impulse", "predict impulse onset off")
    output = """
run 300
compute who all property/local patom1 patom2 cutoff radius
compute pair all pair/local fx fy fz p1 p2 p3 p4
dump contacts all local 300 contacts.dump c_who[*] c_pair[*]
dump_modify contacts format float %.17g
dump bed all custom 300 bed.dump id fx fy fz
dump_modify bed sort id format float %.17g
run 0
"""
    run(scattering + output, tmp_path, np=ranks)
    _, bed = read_dump(tmp_path / "bed.dump")[-1]
    contacts = np.loadtxt(tmp_path / "contacts.dump", skiprows=9)
    i, j = np.searchsorted(bed["id"], contacts[:, :2].T)
    normal, tangential, magnitude = contacts[:, 2:5], contacts[:, 5:8], contacts[:, 8]
    found = np.zeros((len(bed["id"]), 3))
    np.add.at(found, i, normal + tangential)
    np.add.at(found, j, -normal - tangential)
    largest = np.abs(normal).max()
    assert len(normal) > 20 and np.abs(tangential).max() > 0.01 * largest
    # some ten contacts of a sphere, each rounded a few times to the digits of the largest force
    assert np.abs(found - vectors(bed, "fx", "fy", "fz")).max() < 50 * np.finfo(float).eps * largest
    assert magnitude == pytest.approx(np.linalg.norm(tangential, axis=1), rel=1e-12)
