# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs other programs than the hosts, and says which Debian this is."""

import re
import subprocess
from pathlib import Path

RELEASE = re.search(r"^VERSION_CODENAME=(\w+)", Path("/etc/os-release").read_text(), re.MULTILINE).group(1)


def call(*command, **options):
    """What a command said, on both its streams; fails with the end of that if it failed. options: of subprocess.run."""
    done = subprocess.run(
        [str(word) for word in command],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        **options,
    )
    assert done.returncode == 0, done.stdout[-4000:]
    return done.stdout


def version_of(package, field="Version"):
    """Of an installed Debian package."""
    return subprocess.check_output(["dpkg-query", "-W", "-f", f"${{{field}}}", package], text=True)
