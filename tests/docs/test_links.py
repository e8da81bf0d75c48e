# SPDX-License-Identifier: GPL-2.0-or-later
"""What the pages point to is there: files, headings of other pages, sources that they name."""

import re

import pytest
from harness.host import ROOT
from pages import PAGES, anchors_of, links_of, prose_of

# a file that a page names in passing, as tests/core/test_impulse.cpp; words in capitals stand for others
NAMED = re.compile(r"(?<![\w/.-])((?:src|tests|docs|inputs|validation|harness|packaging)/[a-z0-9_/.-]*\w\.[a-z]\w*)")


def assert_leads_somewhere(page, link):
    path, _, anchor = link.partition("#")
    target = (ROOT / page).parent / path if path else ROOT / page
    assert target.is_file(), f"{page}: '{link}' is no file"  # a folder is no page of a site
    if anchor:
        anchors = anchors_of(target)
        assert anchor in anchors, f"{page}: '{link}' is no heading; expected one of {anchors}"


@pytest.mark.parametrize("page", PAGES)
def test_links(page):
    for link in links_of(page):
        if not re.match(r"\w+:", link):
            assert_leads_somewhere(page, link)


@pytest.mark.parametrize("page", PAGES)
def test_files_that_are_named(page):
    for name in NAMED.findall(prose_of(page)):
        assert (ROOT / name).exists(), f"{page}: names {name}, which is not there"


def test_pages_are_found():
    """An empty list would pass everything."""
    assert {"README.md", "ARCHITECTURE.md", "docs/lammps/pair_gran_cfpm.md"} <= set(PAGES)
    assert "docs/getting-started.md" in links_of("README.md")
    assert "impulses" in anchors_of("docs/pair_gran_cfpm.md")
