# SPDX-License-Identifier: GPL-2.0-or-later
"""Text dumps of LIGGGHTS or LAMMPS (dump custom) as files that ParaView opens: NAME.pvd beside each dump NAME.dump.

The dump needs the columns x, y and z, and for spheres of the right size radius or diameter. Columns vx, vy, vz become
the vector v, and so on; all others are numbers of each particle. Time is that of the step, or with --dt its number
times dt.
"""

import argparse
import base64
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np  # noqa: E402
from harness.output import snapshots_of, vectors  # noqa: E402

AXES = ("x", "y", "z")


def array(name, values):
    """One array in VTK's XML: name, then bytes in base64 with their number before them."""
    kind = {"f": "Float64", "i": "Int64"}[values.dtype.kind]
    parts = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    data = np.ascontiguousarray(values).tobytes()
    code = base64.b64encode(np.uint64(len(data)).tobytes() + data).decode()
    return f'<DataArray type="{kind}" Name="{name}"{parts} format="binary">{code}</DataArray>'


def fields(columns):
    """{name: values} of all but the places: three columns that differ by their axis are one vector."""
    found = {}
    for name, values in columns.items():
        stem = name[:-1]
        three = [stem + axis for axis in AXES]
        if name in AXES or (stem and name[-1] in "yz" and stem in found):
            continue
        if stem and name[-1] == "x" and set(three) <= set(columns):
            found[stem] = vectors(columns, *three)
        else:
            found[name] = values.astype(int) if name in ("id", "type", "mol") else values
    if "diameter" in columns and "radius" not in columns:
        found["radius"] = columns["diameter"] / 2
    return found


def polydata(columns):
    """A snapshot as text of a .vtp file: each particle is a vertex with its fields."""
    places = vectors(columns, *AXES)
    count = len(places)
    vertices = array("connectivity", np.arange(count)) + array("offsets", np.arange(1, count + 1))
    return (
        '<?xml version="1.0"?>\n'
        f'<VTKFile type="PolyData" version="1.0" byte_order="{"Little" if sys.byteorder == "little" else "Big"}Endian"'
        ' header_type="UInt64">\n<PolyData>\n'
        f'<Piece NumberOfPoints="{count}" NumberOfVerts="{count}" NumberOfLines="0" NumberOfStrips="0"'
        ' NumberOfPolys="0">\n'
        f"<Points>{array('places', places)}</Points>\n<Verts>{vertices}</Verts>\n"
        f"<PointData>{''.join(array(name, values) for name, values in fields(columns).items())}</PointData>\n"
        "</Piece>\n</PolyData>\n</VTKFile>\n"
    )


def convert(dump, dt):
    """Writes a .vtp file for each snapshot of a dump into a folder, and a .pvd file that lists them; returns that."""
    folder = dump.with_suffix(".vtp")
    series = []
    with open(dump) as lines:
        for step, columns in snapshots_of(lines):
            lacking = [axis for axis in AXES if axis not in columns]
            if lacking:
                raise ValueError(f"found the columns {' '.join(columns)}; expected x, y and z")
            folder.mkdir(exist_ok=True)
            file = folder / f"{step}.vtp"
            file.write_text(polydata(columns))
            series.append(f'<DataSet timestep="{step * dt:.17g}" file="{folder.name}/{file.name}"/>\n')
    if not series:
        raise ValueError("found no snapshot; expected a text file of dump custom")
    listed = dump.with_suffix(".pvd")
    text = "".join(series)
    listed.write_text(f'<VTKFile type="Collection" version="1.0"><Collection>\n{text}</Collection></VTKFile>\n')
    return listed, len(series)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dumps", nargs="+", type=Path, metavar="DUMP")
    parser.add_argument("--dt", type=float, default=1.0, help="the time step of the run, for times in its units")
    arguments = parser.parse_args()
    for dump in arguments.dumps:
        try:
            listed, count = convert(dump, arguments.dt)
        except (OSError, ValueError, UnicodeDecodeError) as error:
            print(f"cfpm: vtk: {dump}: {error}", file=sys.stderr)
            return 1
        print(f"{listed}: {count} snapshot{'s' if count > 1 else ''}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
