#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes hopper.stl beside itself: a cylinder above a cone with an outlet, about the axis z, for in.hopper."""

from math import cos, pi, sin
from pathlib import Path

SIDES = 32
# height and radius of the rings from the outlet up [m]; rings of the cylinder keep its triangles from being slivers
RINGS = [(0.40, 0.03), (0.475, 0.065), (0.55, 0.10), (0.64, 0.10), (0.73, 0.10), (0.82, 0.10), (0.90, 0.10)]


def point(ring, side):
    z, radius = ring
    angle = 2 * pi * (side % SIDES) / SIDES
    return radius * cos(angle), radius * sin(angle), z


def normal(a, b, c):
    """Of a triangle, of length 1."""
    u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = sum(x * x for x in n) ** 0.5
    return [x / length for x in n]


def stl():
    lines = ["solid hopper"]
    for low, high in zip(RINGS, RINGS[1:]):
        for side in range(SIDES):
            a, b, c, d = point(low, side), point(low, side + 1), point(high, side + 1), point(high, side)
            for triangle in ((a, b, c), (a, c, d)):
                lines += ["facet normal {:.8f} {:.8f} {:.8f}".format(*normal(*triangle)), "outer loop"]
                lines += ["vertex {:.8f} {:.8f} {:.8f}".format(*corner) for corner in triangle]
                lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid hopper"]) + "\n"


if __name__ == "__main__":
    Path(__file__).with_suffix(".stl").write_text(stl())
