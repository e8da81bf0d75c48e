#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes floor_with_hole.stl beside itself: the floor z = 0 of in.discharge.

A ring of quadrangles, two triangles each, from points on the rim of the hole straight outwards to the border of the
periodic cell. It ends at the border, because the host copies it into the images of the cell, and its points on opposite
sides lie opposite each other, so edges meet edges there too.
"""

from math import cos, pi, sin
from pathlib import Path

SIDE = 0.3  # of the cell, from 0 in x and y [m]
RADIUS = 0.1  # of the hole in its middle [m]
POINTS = 64  # on the rim; a multiple of 8 puts points on the corners of the cell


def ring(side, radius):
    """Points on the rim and on the border, in the same directions from the middle."""
    directions = [(cos(angle), sin(angle)) for angle in (2 * pi * k / POINTS for k in range(POINTS))]
    rim = [(side / 2 + radius * x, side / 2 + radius * y) for x, y in directions]
    reach = [side / 2 / max(abs(x), abs(y)) for x, y in directions]
    border = [(side / 2 + r * x, side / 2 + r * y) for r, (x, y) in zip(reach, directions)]
    return rim, border


def stl(side=SIDE, radius=RADIUS):
    """Of a floor from 0 to side, with a hole of this radius in its middle [m]."""
    rim, border = ring(side, radius)
    lines = ["solid floor_with_hole"]
    for k in range(POINTS):
        after = (k + 1) % POINTS
        for triangle in ((rim[k], border[k], border[after]), (rim[k], border[after], rim[after])):
            lines += ["facet normal 0 0 1", "outer loop"]
            lines += [f"vertex {x:.10f} {y:.10f} 0" for x, y in triangle]
            lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid floor_with_hole"]) + "\n"


if __name__ == "__main__":
    Path(__file__).with_suffix(".stl").write_text(stl())
