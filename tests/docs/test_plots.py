# SPDX-License-Identifier: GPL-2.0-or-later
"""The plots of the pages are made of the results that are kept, and every picture is shown."""

import subprocess

from harness.host import ROOT
from pages import PAGES, links_of

IMAGES = ROOT / "docs" / "images"


def test_plots_of_the_results(tmp_path):
    subprocess.run(["/usr/bin/python3", ROOT / "validation" / "plots.py", "--out", tmp_path], check=True)
    made = {path.name for path in tmp_path.iterdir()}
    assert "packing.png" in made
    assert made <= {path.name for path in IMAGES.iterdir()}


def test_every_picture_is_shown():
    shown = {((ROOT / page).parent / link).resolve() for page in PAGES for link in links_of(page)}
    assert set(IMAGES.rglob("*.png")) <= shown
