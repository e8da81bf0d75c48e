# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests of a host notice what they claim to: its plugin is built with the mutations of hosts.py."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from mutate import copy

from harness.host import BUILD, ROOT

HERE = Path(__file__).parent


def call(*command, **options):
    command = [str(part) for part in command]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def build(folder, table, targets):
    """Builds the plugin from a copy of the sources with all mutations of a table, none of them on, and with the
    predictor that euler.patch adds; else as the tested one was built."""
    shutil.copy(ROOT / "CMakeLists.txt", folder)
    shutil.copytree(ROOT / "packaging", folder / "packaging")
    copy(table, ROOT, folder)
    cache = (BUILD / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE).group(1)
    # quickly built: optimisation changes no result
    options = (f"-DCMAKE_CXX_COMPILER={compiler}", "-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF")
    options += ("-DCMAKE_BUILD_TYPE=None",)
    for command in (
        ("patch", "-p1", "--fuzz=0", "-i", HERE / "euler.patch"),
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
