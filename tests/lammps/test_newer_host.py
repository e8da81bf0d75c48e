# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin builds for the LAMMPS of Debian 13 (4 Feb 2025) too. Its packages are fetched, not installed."""

import re
import subprocess

import pytest
from lammps import ROOT, run
from own_lammps import apt

@pytest.fixture(scope="module")
def newer(tmp_path_factory):
    """The folder /usr of a Debian 13 with LAMMPS, as far as a build looks."""
    folder = tmp_path_factory.mktemp("trixie")
    for command in (("update", "--error-on=any"), ("download", "lammps", "liblammps0t64", "liblammps-dev")):
        done = apt(folder, "deb", "trixie", *command)
        if done.returncode != 0:
            pytest.skip(f"Debian 13 is out of reach: {done.stderr.strip()[-200:]}")
    for package in folder.glob("*.deb"):
        subprocess.run(["dpkg", "-x", package, folder / "host"], check=True)
    return folder / "host" / "usr"


def test_builds_and_is_refused_here(tmp_path, newer):
    (config,) = newer.rglob("LAMMPSConfig.cmake")
    options = ("-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF", f"-DLAMMPS_DIR={config.parent}")
    for command in (
        ("cmake", "-S", ROOT, "-B", tmp_path, *options),
        ("cmake", "--build", tmp_path, "--parallel", "2", "--target", "cfpm_lammps", "cfpm_lammps_preload"),
    ):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, done.stdout[-3000:]
    process = run('print "the deck was read"\n', tmp_path, program=str(tmp_path / "bin" / "lmp-cfpm"), check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    assert re.search("ERROR: cfpm loader: cannot load the plugin: .*undefined symbol", process.stdout), process.stdout
