# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests of a host notice what they claim to: its plugin, built with the mutations of hosts.py, is broken by them."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from mutate import copy

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "liggghts"))
from liggghts import BUILD, ROOT  # noqa: E402


def call(*command, **options):
    command = [str(part) for part in command]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def build(folder, table, targets):
    """Builds the plugin with all mutations of a table from a copy of the sources, as the tested one was built."""
    shutil.copy(ROOT / "CMakeLists.txt", folder)
    shutil.copytree(ROOT / "packaging", folder / "packaging")
    copy(table, ROOT, folder)
    cache = (BUILD / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE).group(1)
    options = (f"-DCMAKE_CXX_COMPILER={compiler}", "-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF")
    for command in (
        ("cmake", "-S", ".", "-B", "build", *options),
        ("cmake", "--build", "build", "--parallel", "2", "--target", *targets),
    ):
        done = call(*command, cwd=folder)
        assert done.returncode == 0, done.stdout
    return folder / "build"


def assert_noticed(built, tests, row):
    """The row's test, of the folder tests, passes with the plugin as built, and fails with its message once the
    mutation is on."""
    command = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", tests / row.noticed_by)
    environment = {**os.environ, "CFPM_BUILD": str(built)}
    sound = call(*command, env={**environment, "CFPM_MUTATION": ""})
    assert sound.returncode == 0, sound.stdout

    broken = call(*command, env={**environment, "CFPM_MUTATION": row.name})
    assert broken.returncode == 1 and "1 failed" in broken.stdout, broken.stdout
    assert f"AssertionError: {row.message}" in broken.stdout, broken.stdout
