# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat conduction of the host takes contact areas from overlaps, which the method enlarges at rest.

With -suffix cfpm an unmodified deck gets areas that belong to the forces. Spheres in a column, of which the uppermost
is hot, must exchange at any step what they do with stock at small steps.
"""

import re

import numpy as np
import pytest
from harness.liggghts import LAUNCHER, STOCK, run

SMALL, NT_3 = 5e-6, 5.4e-4  # steps of the deck; with the second there are three in a contact time [s]
RADIUS, DENSITY, CAPACITY = 0.004, 8000.0, 10.0
COLUMN = (RADIUS, 3 * RADIUS, 5 * RADIUS)
HEAT = "heat/gran initial_temperature 300."


def deck(dt, model="hertz", predict="", heights=COLUMN, heat=HEAT, wall="", settle=0.3, suffix=""):
    """Spheres over a floor, which have come to rest there, and for 0.02 s exchange heat."""
    spheres = "\n".join(f"create_atoms 1 single 0 0 {z} units box" for z in heights)
    return f"""
atom_style granular
atom_modify map array sort 0 0
boundary f f f
newton off
communicate single vel yes
units si
region reg block -0.05 0.05 -0.05 0.05 0 0.1 units box
create_box 1 reg
neighbor 0.002 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5.e6
fix m2 all property/global poissonsRatio peratomtype 0.45
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3
fix m4 all property/global coefficientFriction peratomtypepair 1 0.05
fix m5 all property/global characteristicVelocity scalar 0.1
pair_style gran{suffix} model {model} tangential history {predict and 'predict ' + predict}
pair_coeff * *
{spheres}
set group all diameter {2 * RADIUS} density {DENSITY}
timestep {dt}
fix g all gravity 9.81 vector 0 0 -1
fix w all wall/gran{suffix} model {model} tangential history primitive type 1 zplane 0.0 {wall}
fix ftco all property/global thermalConductivity peratomtype 100.
fix ftca all property/global thermalCapacity peratomtype {CAPACITY}
fix ht all {heat}
fix i all {"nve/cfpm" if suffix else "nve/sphere"}
thermo 100000
run {round(settle / dt)}
set atom {len(heights)} property/atom Temp 800.
run {round(0.02 / dt)}
variable first equal f_Temp[1]
variable last equal f_Temp[{len(heights)}]
print "HEAT ${{first}} ${{last}}"
"""


def temperatures(folder, text, program=LAUNCHER):
    """Of the lowest and the uppermost sphere in the end [K], and what the host said."""
    options = ("-suffix", "cfpm") if program == LAUNCHER else ()
    output = run(text, folder, program=program, options=options).stdout
    return np.array(re.search("^HEAT (.*)$", output, re.M)[1].split(), dtype=float), output


@pytest.mark.parametrize("area", ["", " contact_area constant 1e-6"])
@pytest.mark.parametrize("model, predict", [("hertz", "impulse"), ("hertz", "exact"), ("hooke", "impulse")])
def test_column(tmp_path, model, predict, area):
    """Areas that do not come from overlaps are the host's."""
    heat = HEAT.replace("gran", "gran/conduction") + area
    stock, _ = temperatures(tmp_path, deck(SMALL, model, heat=heat), STOCK)
    found, output = temperatures(tmp_path, deck(NT_3, model, predict, heat=heat))
    loss, gain = np.abs(found[::-1] - (800.0, 300.0)) / np.abs(stock[::-1] - (800.0, 300.0)) - 1.0
    print(f"{model}, {predict}{area}: loss off by {loss:+.4f}, gain of the lowest by {gain:+.4f}")
    assert abs(loss) <= 0.03
    assert "takes contact areas from overlaps" not in output


@pytest.mark.parametrize("predict", ["impulse", "exact"])
def test_hot_wall(tmp_path, predict):
    """Its area is that of the overlap that belongs to the force, too."""
    hot = {"heights": COLUMN[:1], "wall": "temperature 400.", "settle": 0.1}
    stock, _ = temperatures(tmp_path, deck(SMALL, **hot).replace("set atom", "#"), STOCK)
    found, _ = temperatures(tmp_path, deck(NT_3, predict=predict, **hot).replace("set atom", "#"))
    print(f"{predict}: {found[0]:.3f} K, right {stock[0]:.3f}")
    assert 310.0 < stock[0] < 390.0
    assert abs((found[0] - 300.0) / (stock[0] - 300.0) - 1.0) <= 0.03


def test_near_a_hot_wall(tmp_path):
    """impulse looks at spheres within a tenth of a radius, where the host would take the root of a negative area."""
    near = {"heights": (1.01 * RADIUS,), "wall": "temperature 400.", "settle": 0.1}
    text = deck(NT_3, predict="impulse", **near).replace("gravity 9.81", "gravity 0.0").replace("set atom", "#")
    assert temperatures(tmp_path, text)[0][0] == 300.0


def test_fluxes_that_are_output(tmp_path):
    """compute pair/gran/local has the fluxes that act: in the next step they are what the hot sphere loses."""
    fluxes = "compute fluxes all pair/gran/local id heatFlux\nthermo 100000"
    text = deck(NT_3, predict="impulse").replace("thermo 100000", fluxes) + """
dump fluxes all local 1 fluxes.dump c_fluxes[1] c_fluxes[2] c_fluxes[4]
run 0
undump fluxes
run 1
variable next equal f_Temp[3]
print "NEXT ${next}"
"""
    (_, before), output = temperatures(tmp_path, text)
    rows = [line.split() for line in (tmp_path / "fluxes.dump").read_text().splitlines() if not line.startswith("ITEM")]
    (flux,) = [abs(float(row[2])) for row in rows if len(row) == 3 and {row[0], row[1]} == {"2", "3"}]
    mass = 4.0 / 3.0 * np.pi * RADIUS**3 * DENSITY
    lost = (before - float(re.search("^NEXT (.*)$", output, re.M)[1])) * mass * CAPACITY / NT_3
    print(f"flux {flux:.6f} W, lost {lost:.6f} W")
    assert abs(flux / lost - 1.0) <= 1e-5  # six digits


@pytest.mark.parametrize("style, warns", [("heat/gran", True), ("heat/gran/conduction/cfpm", False)])
def test_beside_named_styles(tmp_path, style, warns):
    """A deck that names the styles of this plugin has to name this one as well, and is told so."""
    text = deck(NT_3, predict="impulse", heat=HEAT.replace("heat/gran", style), settle=0.0, suffix="/cfpm")
    output = run(text, tmp_path).stdout
    assert ("expected fix heat/gran/cfpm" in output) == warns
