# SPDX-License-Identifier: GPL-2.0-or-later
"""The tests notice what they claim to: each patch in tests/mutations breaks a copy of the plugin in one place."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from liggghts import BUILD, ROOT

HERE = Path(__file__).parent

# patch, the test that must fail, what it must say
MUTATIONS = [
    (
        "drop_history_at_rebuild",
        "test_stock_equality.py::test_equals_stock[hooke-plane-1]",
        "bed.dump differs from stock, first in line",
    ),
    (
        "drop_history_of_predicted_pairs",
        "test_passive_output.py::test_output_is_passive[1]",
        "output changed the run, first in line",
    ),
]


def call(*command, **options):
    command = [str(part) for part in command]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def build(folder, patch):
    """Builds the plugin from a patched copy of the sources, as the tested one was built."""
    for part in ("CMakeLists.txt", "src"):
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(source, folder / part)
        else:
            shutil.copy(source, folder / part)
    cache = (BUILD / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE).group(1)
    options = (f"-DCMAKE_CXX_COMPILER={compiler}", "-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF")
    targets = ("--target", "cfpm_liggghts", "cfpm_liggghts_preload")
    for command in (
        ("patch", "-p1", "--fuzz=0", "-i", ROOT / "tests" / "mutations" / f"{patch}.patch"),
        ("cmake", "-S", ".", "-B", "build", *options),
        ("cmake", "--build", "build", "--parallel", "2", *targets),
    ):
        done = call(*command, cwd=folder)
        assert done.returncode == 0, done.stdout
    return folder / "build"


@pytest.mark.parametrize("patch, test, message", MUTATIONS, ids=[m[0] for m in MUTATIONS])
def test_is_noticed(tmp_path, patch, test, message):
    command = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", HERE / test)
    sound = call(*command, env={**os.environ, "CFPM_BUILD": str(BUILD)})
    assert sound.returncode == 0, sound.stdout

    broken = call(*command, env={**os.environ, "CFPM_BUILD": str(build(tmp_path, patch))})
    assert broken.returncode == 1 and "1 failed" in broken.stdout, broken.stdout
    assert f"AssertionError: {message}" in broken.stdout, broken.stdout
