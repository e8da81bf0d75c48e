# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin builds for the LAMMPS of other Debians too. Their packages are fetched, not installed."""

import re
import subprocess

import pytest
from lammps import ROOT, run
from own_lammps import RELEASE, apt

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
        subprocess.run(["dpkg", "-x", package, folder / "host"], check=True)
    return folder / "host" / "usr"


def test_builds_and_is_refused_here(tmp_path, other):
    (config,) = other.rglob("LAMMPSConfig.cmake")
    options = ("-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF", "-DCFPM_LIGGGHTS=OFF", f"-DLAMMPS_DIR={config.parent}")
    for command in (
        ("cmake", "-S", ROOT, "-B", tmp_path, *options),
        ("cmake", "--build", tmp_path, "--parallel", "2", "--target", "cfpm_lammps", "cfpm_lammps_preload"),
    ):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, done.stdout[-3000:]
    process = run('print "the deck was read"\n', tmp_path, program=str(tmp_path / "bin" / "lmp-cfpm"), check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    refusal = "ERROR: cfpm loader: cannot load the plugin: .*undefined symbol|ERROR: .*built for LAMMPS [0-9]+, this host"
    assert re.search(refusal, process.stdout), process.stdout
