# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages of this project: every Markdown file, its text, its code, its links and its anchors."""

import os
import re

from harness.host import ROOT

NOT_OURS = {"build", "out"}  # folders, beside hidden ones


def pages():
    """Paths from ROOT."""
    found = []
    for folder, inside, files in os.walk(ROOT):
        inside[:] = [name for name in inside if name not in NOT_OURS and not name.startswith(".")]
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in files if name.endswith(".md")]
    return sorted(found)


PAGES = pages()
FENCE = re.compile(r"^( *)```.*?^\1```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"(?<!`)`([^`]+)`(?!`)")


def text_of(page):
    return (ROOT / page).read_text()


def prose_of(page):
    """Without blocks of code that stand between fences."""
    return FENCE.sub("", text_of(page))


def code_of(page):
    """Lines of code: those between fences or indented, and what stands between backticks."""
    text = text_of(page)
    prose = FENCE.sub("", text)
    lines = [line for block in FENCE.finditer(text) for line in block[0].splitlines()[1:-1]]
    lines += [line for line in prose.splitlines() if line.startswith("    ")]
    return [*lines, *(" ".join(span.split()) for span in SPAN.findall(prose))]


LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")


def links_of(page):
    """What the links of a page lead to, as written."""
    return LINK.findall(SPAN.sub("", prose_of(page)))


def anchors_of(page):
    """Names of the headings, as GitHub makes them and MyST after it."""
    names = []
    for title in re.findall(r"^#+ (.*)$", prose_of(page), re.MULTILINE):
        name = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        same = sum(re.fullmatch(rf"{re.escape(name)}(-\d+)?", other) is not None for other in names)
        names.append(f"{name}-{same}" if same else name)
    return names
