# SPDX-License-Identifier: GPL-2.0-or-later
"""Every message that docs/troubleshooting.md explains is one that this project can say."""

import re

import pytest
from harness.host import ROOT
from pages import text_of

MESSAGES = [" ".join(text.split()) for text in re.findall(r"^\* `([^`]+)`", text_of("docs/troubleshooting.md"), re.M)]


def said():
    """All texts of the sources, those over several lines joined."""
    files = [file for kind in ("*.h", "*.cpp", "*.in") for file in (ROOT / "src").rglob(kind)]
    text = "\n".join(file.read_text() for file in [*files, ROOT / "cfpm"])
    return re.sub(r'"\s*\n\s*"', "", text)


SAID = said()


@pytest.mark.parametrize("message", MESSAGES)
def test_is_said(message):
    for part in message.split("..."):
        assert part.strip() in SAID, f"nothing says '{part.strip()}'"


def test_messages_are_found():
    assert len(MESSAGES) > 30
