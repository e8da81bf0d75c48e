# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests notice what they claim to: a patch of this folder breaks a copy of a host's plugin in one place."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "liggghts"))
from liggghts import BUILD, ROOT  # noqa: E402


def call(*command, **options):
    command = [str(part) for part in command]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def build(folder, patch, targets):
    """Builds the plugin from a patched copy of the sources, as the tested one was built."""
    for part in ("CMakeLists.txt", "packaging", "src"):
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(source, folder / part)
        else:
            shutil.copy(source, folder / part)
    cache = (BUILD / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE).group(1)
    options = (f"-DCMAKE_CXX_COMPILER={compiler}", "-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF")
    for command in (
        ("patch", "-p1", "--fuzz=0", "-i", HERE / f"{patch}.patch"),
        ("cmake", "-S", ".", "-B", "build", *options),
        ("cmake", "--build", "build", "--parallel", "2", "--target", *targets),
    ):
        done = call(*command, cwd=folder)
        assert done.returncode == 0, done.stdout
    return folder / "build"


def assert_noticed(folder, patch, targets, test, message):
    """The test, a path of pytest, passes with the plugin and fails with that message once it is broken."""
    command = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", test)
    sound = call(*command, env={**os.environ, "CFPM_BUILD": str(BUILD)})
    assert sound.returncode == 0, sound.stdout

    broken = call(*command, env={**os.environ, "CFPM_BUILD": str(build(folder, patch, targets))})
    assert broken.returncode == 1 and "1 failed" in broken.stdout, broken.stdout
    assert f"AssertionError: {message}" in broken.stdout, broken.stdout
