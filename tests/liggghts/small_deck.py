# SPDX-License-Identifier: GPL-2.0-or-later
"""A short deck of three particles over a floor, any line of which a test may change."""

from harness.liggghts import run
from harness.output import first_error

PAIR_VALUES = {
    "kn": 1e5,
    "kt": 3e4,
    "gamman": 1.0,
    "gammat": 1.0,
    "gamman_abs": 1.0,
    "gammat_abs": 1.0,
    "coefficientFriction": 0.3,
    "coefficientRestitution": 0.5,
}
TYPE_VALUES = {"youngsModulus": 1e7, "poissonsRatio": 0.3}
VELOCITY = 1.0


def property_lines(without=""):
    lines = [f"{name} peratomtypepair 2 " + " ".join([str(value)] * 4) for name, value in PAIR_VALUES.items()]
    lines += [f"{name} peratomtype {value} {value}" for name, value in TYPE_VALUES.items()]
    lines += [f"characteristicVelocity scalar {VELOCITY}"]
    names = [line.split()[0] for line in lines]
    return "\n".join(f"fix {n} all property/global {line}" for n, line in zip(names, lines) if n != without)


MODEL = "model hooke/stiffness tangential history"
PAIR = "pair_style gran/cfpm "
WALL = "fix floor all wall/gran/cfpm "
PLANE = " primitive type 1 zplane 0.0"
STOCK_WALL = f"fix floor all wall/gran {MODEL}{PLANE}"
STOCK_INTEGRATOR = "fix integrate all nve/sphere"

DECK = {
    "units": "units si",
    "style": "atom_style granular",
    "map": "atom_modify map array sort 0 0",
    "boundary": "boundary f f f",
    "newton": "newton off",
    "communicate": "communicate single vel yes",
    "region": "region box block -1 1 -1 1 -1 1 units box",
    "box": "create_box 2 box",
    "neighbor": "neighbor 0.01 bin\nneigh_modify delay 0",
    "timestep": "timestep 1e-5",
    "properties": property_lines(),
    "pair": PAIR + MODEL,
    "coefficients": "pair_coeff * *",
    "particles": """create_atoms 1 single -0.3 0 0.3 units box
create_atoms 2 single 0.3 0 0.5 units box
create_atoms 2 single 0.3 0 0.65 units box
set type 1 diameter 0.05 density 800
set type 2 diameter 0.1 density 1000""",
    "groups": "group one type 1\ngroup two type 2",
    "wall": WALL + MODEL + PLANE,
    "integrator": "fix integrate all nve/cfpm",
    "extra": "",
    "run": "run 2",
}

# particles that are yet to be inserted
TEMPLATE = """fix small all particletemplate/sphere 15485863 atom_type 1 density constant 800 radius constant 0.02
fix large all particletemplate/sphere 32452843 atom_type 2 density constant 1000 radius constant 0.05
fix mix all particledistribution/discrete 49979687 2 small 0.5 large 0.5
region top block -0.5 0.5 -0.5 0.5 0.5 0.9 units box
"""
INSERTION = "fix fill all insert/pack seed 86028157 distributiontemplate mix insert_every once overlapcheck yes &\n"
INSERTION += "  vel constant 0 0 0 region top particles_in_region 8\n"


def write(**changes):
    assert set(changes) <= set(DECK)
    return "\n".join({**DECK, **changes}.values()) + "\n"


def attempt(folder, ranks, changes):
    return run(write(**changes), folder, np=ranks, check=False, timeout=20)


def assert_refused(process, fragments):
    output = process.stdout
    error = first_error(process)
    assert process.returncode > 0, output[-2000:]
    assert "Signal:" not in output and "exited on signal" not in output, output[-2000:]
    for fragment in fragments:
        assert fragment in error, error
