# SPDX-License-Identifier: GPL-2.0-or-later
"""What the loop over contacts may run with (environment variable CFPM_SIMD): one contact at a time, or several."""

import platform
from dataclasses import replace
from pathlib import Path

import numpy as np

from harness import HOSTS
from harness.fifty_spheres import DECKS, SIDE, STEPS, start
from harness.spheres import dump, write_data

SETS = {"x86_64": ["scalar", "sse2"], "aarch64": ["scalar", "neon"]}.get(platform.machine(), ["scalar"])
if "avx2" in Path("/proc/cpuinfo").read_text():
    SETS.append("avx2")

OTHER_PREDICTOR = {"linear": {"predict exact": "predict trapezoid"}, "hertz": {"predict rk4": "predict rk2"}}
OWN_STEP = {"linear": {"predict exact": "predict verlet"}, "hertz": {"predict rk4": "predict verlet"}}
IMPULSES = ["impulse", "split", "impulse_floor"]


def of_any_size():
    """The fifty spheres, no two of which are alike."""
    random = np.random.default_rng(20050102)
    return [replace(sphere, radius=random.uniform(0.004, 0.006)) for sphere in start()]


def fall(host, folder, law, change, instructions, spheres):
    """They fall. change: {words of the deck: others}. Returns what was dumped, and the output."""
    folder.mkdir()
    write_data(folder / "spheres.data", spheres, low=-SIDE / 2, high=SIDE / 2, types=1)
    text = DECKS[host](law) + dump(STEPS // 10, host=host) + f"run {STEPS}\n"
    for words, others in change.items():
        assert words in text
        text = text.replace(words, others)
    output = HOSTS[host].run(text, folder, env={"CFPM_SIMD": instructions}).stdout
    return (folder / "motion.dump").read_text(), output


def check_same_bits(host, folder, law, change, spheres=None):
    """Whatever they run with, forces and motion are the same to the last digit, and the log says what it is. spheres:
    in place of fifty of two sizes."""
    spheres = spheres or start()
    expected, output = fall(host, folder / "scalar", law, change, "scalar", spheres)
    assert "at a time" not in output
    for lanes, instructions in enumerate(SETS[1:], 1):
        found, output = fall(host, folder / instructions, law, change, instructions, spheres)
        assert f"contacts of pairs are computed {2 * lanes} at a time ({instructions})\n" in output
        same = found == expected
        assert same, f"with {instructions} the run differs"


def check_refusal(host, folder):
    """Of a name that is none."""
    refused = HOSTS[host].run("", folder, env={"CFPM_SIMD": "mmx"}, check=False)
    assert refused.returncode != 0
    assert "the cfpm plugin cannot be loaded: CFPM_SIMD is 'mmx'; expected one of what this machine has: scalar" in (
        refused.stdout
    )
