# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws spheres and the edges of walls, seen from afar, as shaded discs that hide each other."""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from PIL import Image, ImageDraw

FINER = 2  # drawn this much larger, then made smaller: smooth edges
COLOURS = colormaps["cividis"]  # from dark to light in grey too
LIGHT = np.array([-0.35, 0.45, 0.82])  # towards it: right, up, towards the viewer


@dataclass(frozen=True)
class View:
    """From where to look, in degrees."""

    around: float  # the axis z; 0: along y
    above: float  # the plane z = const

    def seen(self, places):
        """Right, up and towards the viewer, of vectors in rows."""
        a, b = np.radians([self.around, self.above])
        right = [np.cos(a), np.sin(a), 0]
        up = [-np.sin(a) * np.sin(b), np.cos(a) * np.sin(b), np.cos(b)]
        near = [np.sin(a) * np.cos(b), -np.cos(a) * np.cos(b), np.sin(b)]
        return places @ np.array([right, up, near]).T


def draw(places, radii, shades, view, size, edges=()):
    """An Image. shades: of each sphere, 0 to 1; size: width and height at most; edges: lines in space, (points, 3)."""
    seen, lines = view.seen(places), [view.seen(np.asarray(edge, float)) for edge in edges]
    low = np.min([(seen - radii[:, None]).min(axis=0), *(line.min(axis=0) for line in lines)], axis=0)
    high = np.max([(seen + radii[:, None]).max(axis=0), *(line.max(axis=0) for line in lines)], axis=0)
    scale = FINER * min(size / np.maximum((high - low)[:2], 1e-300))
    width, height = (int(np.ceil(scale * extent)) + 2 * FINER for extent in (high - low)[:2])
    image = np.full((height, width, 3), 255, np.uint8)
    depth = np.full((height, width), -np.inf)

    def pixels(points):
        return FINER + scale * (points[:, 0] - low[0]), FINER + scale * (high[1] - points[:, 1])

    columns, rows = pixels(seen)
    colours = 255 * COLOURS(shades)[:, :3]
    for column, row, radius, near, colour in zip(columns, rows, scale * radii, scale * seen[:, 2], colours):
        left, top = max(0, int(column - radius)), max(0, int(row - radius))
        y, x = np.ogrid[top:min(height, int(row + radius) + 2), left:min(width, int(column + radius) + 2)]
        x, y = (x - column) / radius, (row - y) / radius
        z = np.sqrt(np.maximum(0, 1 - x * x - y * y))
        where = np.s_[top:top + len(y), left:left + x.shape[1]]
        front = (z > 0) & (near + radius * z > depth[where])
        depth[where][front] = (near + radius * z)[front]
        shade = 0.35 + 0.65 * np.maximum(0, LIGHT[0] * x + LIGHT[1] * y + LIGHT[2] * z)
        image[where][front] = (shade[front, None] * colour).astype(np.uint8)
    drawn = Image.fromarray(image)
    over = Image.new("RGBA", drawn.size)
    for line in lines:
        ImageDraw.Draw(over).line(list(zip(*pixels(line))), fill=(60, 60, 60, 110), width=FINER)
    drawn = Image.alpha_composite(drawn.convert("RGBA"), over).convert("RGB")
    return drawn.resize((width // FINER, height // FINER), Image.Resampling.LANCZOS)


def edges_of_stl(file):
    """The triangles of a text STL file as closed lines."""
    corners = [[float(x) for x in line.split()[1:]] for line in file.read_text().splitlines() if "vertex" in line]
    return [[*corners[k:k + 3], corners[k]] for k in range(0, len(corners), 3)]


def circle(radius, height, axis):
    """About the axis x, y or z through the origin, at a height along it."""
    angles = np.linspace(0, 2 * np.pi, 73)
    around = [radius * np.cos(angles), radius * np.sin(angles)]
    around.insert("xyz".index(axis), np.full_like(angles, height))
    return np.column_stack(around)
