# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes a site of the pages of this project, which are Markdown to be read without it too: ./cfpm docs.

The sources are the whole repository, so that links between its pages and to its files lead on in the site.
docs/index.md is a page of links under headings; the side bar is made of these.
"""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

project = "cfpm"
author = "the cfpm project"
version = release = re.search(r"project\(cfpm VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**.md", "validation/**/README.md"]
exclude_patterns = ["build", "out", ".*"]
extensions = ["myst_parser"]
myst_heading_anchors = 4  # named as on GitHub
highlight_language = "none"
html_theme = "alabaster"
html_theme_options = {"description": "larger, truer time steps for the discrete element method", "page_width": "1100px"}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_title = f"cfpm {version}"
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False


def with_side_bar(_, page, source):
    """Adds to the text of the index, for each of its headings, a hidden list of the pages that follow it."""
    if page != root_doc:
        return
    for part in source[0].split("\n## ")[1:]:
        title, _, links = part.partition("\n")
        pages = "\n".join(f"/{path_of(link)}" for link in re.findall(r"\]\(([^()]+\.md)\)", links))
        source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n{pages}\n```\n"


def path_of(link):
    """From the root of the sources."""
    return (ROOT / "docs" / link).resolve().relative_to(ROOT)


def setup(app):
    app.connect("source-read", with_side_bar)
