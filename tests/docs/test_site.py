# SPDX-License-Identifier: GPL-2.0-or-later
"""./cfpm docs: every page is on the site, and Sphinx warns of nothing, be it a link, a heading or a block of code."""

import os
import re
import subprocess

import pytest
from harness.host import ROOT
from pages import PAGES


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("out")
    ask = [ROOT / "cfpm", "docs", "-W", "--keep-going"]
    done = subprocess.run(ask, env={**os.environ, "CFPM_OUT": str(folder)}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / "docs"


def test_has_every_page(site):
    made = {str(path.relative_to(site).with_suffix(".md")) for path in site.rglob("*.html")}
    assert set(PAGES) <= made


def test_begins_at_the_index(site):
    assert "url=docs/index.html" in (site / "index.html").read_text()
    index = (site / "docs" / "index.html").read_text()
    for caption in ("Start", "Use", "Styles of LIGGGHTS", "Styles of LAMMPS", "Behind it"):
        assert re.search(rf'class="caption-text">{caption}<', index), caption  # of the side bar


def test_links_to_headings(site):
    assert 'href="pair_gran_cfpm.html#impulses"' in (site / "docs" / "faq.html").read_text()


def test_links_to_files(site):
    copy = re.search(r'href="\.\./(_downloads/\w+/in\.packing)"', (site / "docs" / "results.html").read_text())[1]
    assert (site / copy).read_text() == (ROOT / "inputs" / "liggghts" / "in.packing").read_text()
