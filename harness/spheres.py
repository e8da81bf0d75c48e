# SPDX-License-Identifier: GPL-2.0-or-later
"""A few spheres in known states: the decks that put them into the host, and the same through the reference scheme."""

import subprocess
from dataclasses import dataclass
from math import pi

import numpy as np
from harness.host import BUILD
from harness.output import read_dump, vectors

REFERENCE = str(BUILD / "bin" / "reference_scheme")
PREDICTORS = ("exact", "trapezoid", "rk2", "rk4")
MOTION = ("x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz")
FORCES = ("fx", "fy", "fz", "tqx", "tqy", "tqz")
ROUNDING = 2.0**-53  # of one operation, relative


def digits(*values):
    """Every bit of the numbers, in a row."""
    return " ".join(f"{float(v):.17g}" for v in np.concatenate([np.atleast_1d(v) for v in values]))


@dataclass
class Sphere:
    x: tuple
    v: tuple = (0.0, 0.0, 0.0)
    omega: tuple = (0.0, 0.0, 0.0)
    radius: float = 0.025
    density: float = 1000.0
    type: int = 1
    held: bool = False  # fix freeze; an infinite mass to its partner

    @property
    def mass(self):
        return 4.0 * pi / 3.0 * self.radius**3 * self.density


@dataclass
class Plane:
    x: tuple
    normal: tuple
    v: tuple = (0.0, 0.0, 0.0)


@dataclass
class Law:
    """Normal and tangential stiffness and damping, friction; of Hertz contacts those at an overlap of 1 m."""

    kn: float
    hn: float
    ks: float
    hs: float
    mu: float
    form: str = "linear"  # or "hertz", "hertz/stiffness"
    tension: bool = False  # until the bodies part, else the normal force never pulls
    together: bool = False  # Coulomb's limit holds the tangential spring with its dashpot, not alone


def reduced_mass(a, b=None):
    """Of two spheres, or of a sphere at a wall or a held one."""
    if b is None or b.held:
        return a.mass
    return b.mass if a.held else a.mass * b.mass / (a.mass + b.mass)


def contact_time(law, mass):
    """Eq. 17."""
    return pi * np.sqrt(mass / law.kn)


def write_data(path, spheres, low=-1.0, high=1.0, types=2):
    """A data file of spheres with ids 1, 2, ... in a cube."""
    lines = ["spheres", "", f"{len(spheres)} atoms", f"{types} atom types", ""]
    lines += [f"{low} {high} {c}lo {c}hi" for c in "xyz"]
    lines += ["", "Atoms", ""]
    lines += [f"{k} {s.type} {digits(2 * s.radius, s.density, s.x)}" for k, s in enumerate(spheres, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{k} {digits(s.v, s.omega)}" for k, s in enumerate(spheres, 1)]
    path.write_text("\n".join(lines) + "\n")


def write_stl(path, corners):
    """A rectangle, its corners in order, as two triangles."""
    a, b, c, d = corners
    lines = ["solid wall"]
    for triangle in ((a, b, c), (a, c, d)):
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + digits(corner) for corner in triangle]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid wall"]) + "\n")


def box(dt, data="spheres.data", skin=0.01, boundary="f f f"):
    """All that comes before the pair style in a deck for LIGGGHTS."""
    return f"""
units si
atom_style granular
atom_modify map array
boundary {boundary}
newton off
communicate single vel yes
processors * 1 1
read_data {data}
neighbor {skin} bin
neigh_modify delay 0
timestep {float(dt)!r}
thermo_modify lost error norm no
"""


def lammps_box(dt, data="spheres.data", skin=0.01, newton="off", processors="* * *"):
    """All that comes before the pair style in a deck for LAMMPS."""
    return f"""
units si
atom_style sphere
boundary f f f
newton {newton}
comm_modify vel yes
processors {processors}
read_data {data}
neighbor {skin} bin
neigh_modify delay 0
timestep {float(dt)!r}
"""


def stiffness_material(laws):
    """Properties of "hooke/stiffness absolute_damping on" from {(type, type): Law}, both orders the same."""
    types = max(max(pair) for pair in laws)
    columns = {"kn": "kn", "kt": "ks", "gamman_abs": "hn", "gammat_abs": "hs", "coefficientFriction": "mu"}
    full = {**laws, **{(j, i): law for (i, j), law in laws.items()}}
    pairs = [full[i, j] for i in range(1, types + 1) for j in range(1, types + 1)]
    return "".join(
        f"fix {name} all property/global {name} peratomtypepair {types} "
        + digits([getattr(law, field) for law in pairs])
        + "\n"
        for name, field in columns.items()
    )


def dump(every=1, name="motion.dump", group="all", columns=MOTION + FORCES, id="motion", host="liggghts"):
    """The commands that write every digit, for read_motion()."""
    line = {"liggghts": "", "lammps": "line "}[host]
    form = " ".join(["%d"] + len(columns) * ["%.17g"])
    return (
        f"dump {id} {group} custom {every} {name} id {' '.join(columns)}\n"
        f'dump_modify {id} sort id format {line}"{form}"\n'
    )


def read_motion(path, columns=MOTION):
    """Steps, and an array (snapshots, particles, columns)."""
    snapshots = read_dump(path)
    return np.array([step for step, _ in snapshots]), np.array([vectors(s, *columns) for _, s in snapshots])


def reference(predictor, law, bodies, runs, gravity=(0.0, 0.0, 0.0)):
    """Motion of one contact without a host: (steps + 1, spheres, 9). runs: (dt, steps) pairs."""
    coefficients = [law.kn, law.hn, law.ks, law.hs, law.mu, -np.inf if law.tension else 0.0]
    lines = [f"predictor {predictor}", f"law {law.form} " + digits(coefficients)]
    lines += ["limited_together"] if law.together else []
    lines += ["gravity " + digits(gravity)]
    spheres = 0
    for body in bodies:
        if isinstance(body, Plane):
            lines.append("plane " + digits(body.x, body.normal, body.v))
        else:
            spheres += 1
            mass = np.inf if body.held else body.mass
            lines.append("sphere " + digits(body.radius, mass, body.x, body.v, body.omega))
    lines += [f"run {float(dt)!r} {steps}" for dt, steps in runs]
    process = subprocess.run([REFERENCE], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    table = np.array([line.split() for line in process.stdout.splitlines()], dtype=float)
    return table[:, 1:].reshape(len(table), spheres, 9)


def largest_error(motion, expected, bodies, speed):
    """Largest deviation relative to the sizes of the problem: a radius, the impact speed, and speed over radius."""
    errors = []
    for k, sphere in enumerate(b for b in bodies if isinstance(b, Sphere)):
        difference = np.abs(motion[:, k] - expected[:, k])
        for part, scale in ((slice(0, 3), sphere.radius), (slice(3, 6), speed), (slice(6, 9), speed / sphere.radius)):
            errors.append(difference[:, part].max() / scale)
    return max(errors)
