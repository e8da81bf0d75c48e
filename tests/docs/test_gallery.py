# SPDX-License-Identifier: GPL-2.0-or-later
"""The gallery: every run of it goes, is drawn, and is on its page with the command that a reader gives."""

import re
import subprocess

import pytest
from harness.host import ROOT
from pages import text_of

PAGE = text_of("docs/gallery.md")


@pytest.fixture(scope="module")
def gallery(tmp_path_factory):
    """The folder of the pictures and {name: command} of a quick gallery."""
    folder = tmp_path_factory.mktemp("gallery")
    script = ROOT / "validation" / "gallery" / "gallery.py"
    done = subprocess.run(["/usr/bin/python3", script, "--out", folder, "--quick"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder, dict(re.findall(r"^\| ([\w ]+) \| `([^`]*)`", done.stdout, re.MULTILINE))


def test_six_runs_are_drawn(gallery):
    folder, commands = gallery
    pictures = {path.name for path in folder.iterdir()}
    assert len(commands) == 6 and pictures == {f"{name.replace(' ', '-')}.png" for name in commands}
    for picture in pictures:
        assert f"images/gallery/{picture}" in PAGE
        assert (ROOT / "docs" / "images" / "gallery" / picture).is_file()


def test_commands_are_those_of_the_page(gallery):
    for name, command in gallery[1].items():
        assert command in PAGE, name


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in (ROOT / "docs" / "images" / "gallery").iterdir()) < 1.5e6
