# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck and its start state: 500 spheres of two sizes fall on a floor while they drift sideways.

The drift carries contacts through the periodic faces and from one rank to the other, the thin skin makes
neighbour rebuilds frequent: contact history that does not survive either cannot stay unnoticed. SI units.
"""

from pathlib import Path

import numpy as np
from harness.spheres import digits

COUNT = 500
RADIUS = np.array([0.004, 0.005])  # of type 1 and type 2
DENSITY = np.array([2500.0, 2000.0])
CELLS = 8  # the start lattice has CELLS^3 sites
SPACING = 0.0106  # leaves 0.3 mm to every side of the larger spheres
SIDE = CELLS * SPACING
HEIGHT = 0.12
SPEED = 1.5  # about the largest at the start
TIME_STEP = 5.0e-5  # about 1/20 of the shortest contact
STEPS = 2000
COLUMNS = "id type x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"

HOOKE = "model hooke tangential history"
STOCK = {"pair": "gran", "wall": "wall/gran", "nve": "nve/sphere"}
UNPREDICTED = {"pair": "gran/cfpm", "wall": "wall/gran/cfpm", "nve": "nve/sphere", "predict": "none"}
PREDICTED = {"pair": "gran/cfpm", "wall": "wall/gran/cfpm", "nve": "nve/cfpm", "predict": "exact"}

# the host wants this before the first run; for models with history
CONTACTS = "compute contacts all pair/gran/local id history\n"


def material(model):
    """No type pair like another. The stiffness models that go with an area are given as much more."""
    area = 2000 if "hertz/stiffness" in model else 1  # about 1/(R* d)^(1/2)
    return f"""
fix Y all property/global youngsModulus peratomtype 5.0e6 6.0e6
fix nu all property/global poissonsRatio peratomtype 0.3 0.25
fix e all property/global coefficientRestitution peratomtypepair 2 0.6 0.5 0.5 0.7
fix mu all property/global coefficientFriction peratomtypepair 2 0.5 0.4 0.4 0.3
fix v all property/global characteristicVelocity scalar 1.0
fix kn all property/global kn peratomtypepair 2 {area * 2.0e4} {area * 1.8e4} {area * 1.8e4} {area * 1.5e4}
fix kt all property/global kt peratomtypepair 2 {area * 8.0e3} {area * 7.0e3} {area * 7.0e3} {area * 6.0e3}
fix gn all property/global gamman peratomtypepair 2 {area * 4000} {area * 3500} {area * 3500} {area * 3000}
fix gt all property/global gammat peratomtypepair 2 {area * 2000} {area * 1500} {area * 1500} {area * 1000}
fix rf all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.15 0.15 0.2
fix rv all property/global coefficientRollingViscousDamping peratomtypepair 2 0.3 0.4 0.4 0.5
fix ced all property/global cohesionEnergyDensity peratomtypepair 2 2.0e4 1.0e4 1.0e4 3.0e4
"""


def start():
    """Types, positions, velocities and spins; always the same."""
    random = np.random.default_rng(20050101)
    sites = np.stack(np.meshgrid(*3 * [np.arange(CELLS)]), axis=-1).reshape(-1, 3)[:COUNT]
    types = random.integers(1, 3, COUNT)
    x = (sites + 0.5) * SPACING + random.uniform(-3e-4, 3e-4, (COUNT, 3))
    v = np.array([0.8, 0.2, -1.0]) + random.uniform(-0.3, 0.3, (COUNT, 3))
    omega = random.uniform(-50.0, 50.0, (COUNT, 3))
    return types, x, v, omega


def write(folder, state=None):
    """Writes bed.data, the start state or another of that form, and floor.stl."""
    types, x, v, omega = state or start()
    lines = ["start state", "", f"{COUNT} atoms", "2 atom types", ""]
    lines += [f"0 {SIDE!r} xlo xhi", f"0 {SIDE!r} ylo yhi", f"-0.01 {HEIGHT} zlo zhi", "", "Atoms", ""]
    for k, t in enumerate(types):
        lines.append(f"{k + 1} {t} " + digits(2 * RADIUS[t - 1], DENSITY[t - 1], x[k]))
    lines += ["", "Velocities", ""]
    lines += [f"{k + 1} " + digits(v[k], omega[k]) for k in range(COUNT)]
    (Path(folder) / "bed.data").write_text("\n".join(lines) + "\n")
    write_floor(Path(folder) / "floor.stl")


def write_floor(path, parts=3):
    """The floor z = 0 in triangles smaller than the drift, so contacts cross their edges."""
    edges = np.linspace(0.0, SIDE, parts + 1)
    lines = ["solid floor"]
    for x0, x1 in zip(edges, edges[1:]):
        for y0, y1 in zip(edges, edges[1:]):
            for corners in (((x0, y0), (x1, y0), (x1, y1)), ((x0, y0), (x1, y1), (x0, y1))):
                lines += ["facet normal 0 0 1", "outer loop"]
                lines += [f"vertex {x:.9g} {y:.9g} 0" for x, y in corners]
                lines += ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid floor"]) + "\n")


def box(particles="read_data bed.data"):
    """All that comes before the pair style. particles: the command that brings them."""
    return f"""
units si
atom_style granular
atom_modify map array
boundary p p f
newton off
communicate single vel yes
processors * 1 1
{particles}
neighbor 0.0005 bin
neigh_modify delay 0
timestep {TIME_STEP}
thermo {STEPS}
"""


def pair(styles, model=HOOKE, settings=""):
    predict = f"predict {styles['predict']}" if "predict" in styles else ""
    return f"pair_style {styles['pair']} {model} {predict} {settings}\npair_coeff * *\n"


def fixes(styles, model=HOOKE, settings="", wall="plane"):
    """Material, floor, gravity and integrator. wall: plane or mesh."""
    mesh = "fix mesh all mesh/surface file floor.stl type 1\n" if wall == "mesh" else ""
    floor = "mesh n_meshes 1 meshes mesh" if wall == "mesh" else "primitive type 1 zplane 0.0"
    return f"""
{material(model)}
{mesh}
fix floor all {styles['wall']} {model} {floor} {settings}
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all {styles['nve']}
"""


def dump_particles(name="bed.dump", every=STEPS // 4):
    """Every digit of every particle."""
    form = " ".join(["%d %d"] + (len(COLUMNS.split()) - 2) * ["%.17g"])
    return f'dump bed all custom {every} {name} {COLUMNS}\ndump_modify bed sort id format "{form}"\n'


def dump_contacts(values=3, name="contacts.dump", every=STEPS // 4):
    """Ids and history of every touching pair, from the compute CONTACTS. values: how many the model keeps."""
    columns = " ".join(f"c_contacts[{k}]" for k in range(1, values + 4))
    form = " ".join(["%.0f"] * 3 + ["%.17g"] * values)
    return f'dump contacts all local {every} {name} {columns}\ndump_modify contacts format "{form}"\n'


def read_contacts(path):
    """Snapshots of dump_contacts(): a list of {(id, id): history}."""
    snapshots = []
    for snapshot in Path(path).read_text().split("ITEM: TIMESTEP\n")[1:]:
        rows = [line.split() for line in snapshot.split("ITEM: ENTRIES")[1].splitlines()[1:]]
        snapshots.append({(int(row[0]), int(row[1])): np.array(row[3:], dtype=float) for row in rows})
    return snapshots


def assert_same_text(path, reference, message):
    """Every digit alike. Names the first differing line: an assert on the texts themselves takes pytest minutes."""
    lines, expected = Path(path).read_text().splitlines(), Path(reference).read_text().splitlines()
    assert len(lines) == len(expected), f"{message}: {len(lines)} lines, expected {len(expected)}"
    for number, (line, wanted) in enumerate(zip(lines, expected), 1):
        assert line == wanted, f"{message}, first in line {number}"
