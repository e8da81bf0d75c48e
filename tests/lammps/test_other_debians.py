# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin builds for the LAMMPS of other Debians too. Their packages are fetched, not installed."""

import re

import pytest
from harness.host import ROOT
from harness.lammps import run
from harness.programs import RELEASE, call
from own_lammps import apt

SUITES = {"bookworm": "liblammps0", "trixie": "liblammps0t64", "forky": "liblammps0t64"}


@pytest.fixture(scope="module", params=[suite for suite in SUITES if suite != RELEASE])
def other(tmp_path_factory, request):
    """The folder /usr of another Debian with LAMMPS, as far as a build looks."""
    folder = tmp_path_factory.mktemp(request.param)
    for command in (("update", "--error-on=any"), ("download", "lammps", SUITES[request.param], "liblammps-dev")):
        done = apt(folder, "deb", request.param, *command)
        if done.returncode != 0:
            pytest.skip(f"Debian {request.param} is out of reach: {done.stderr.strip()[-200:]}")
    for package in folder.glob("*.deb"):
        call("dpkg", "-x", package, folder / "host")
    return folder / "host" / "usr"


def test_builds_and_is_refused_here(tmp_path, other):
    (config,) = other.rglob("LAMMPSConfig.cmake")
    options = ("-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF", "-DCFPM_LIGGGHTS=OFF", f"-DLAMMPS_DIR={config.parent}")
    call("cmake", "-S", ROOT, "-B", tmp_path, "-DCMAKE_BUILD_TYPE=None", *options)  # compiles in half the time
    call("cmake", "--build", tmp_path, "--parallel", "2", "--target", "cfpm_lammps", "cfpm_lammps_preload")
    process = run('print "the deck was read"\n', tmp_path, program=str(tmp_path / "bin" / "lmp-cfpm"), check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    refusals = ("cfpm loader: cannot load the plugin: .*undefined symbol", ".*built for LAMMPS [0-9]+, this host")
    assert re.search("|".join(f"ERROR: {refusal}" for refusal in refusals), process.stdout), process.stdout
