# SPDX-License-Identifier: GPL-2.0-or-later
"""A user without root builds and packages the plugins; a bare Debian takes these, runs decks and forgets them."""

import os
import shutil
import tempfile
from pathlib import Path

import pytest
from harness.host import ENVIRONMENT, ROOT
from harness.programs import RELEASE, call, version_of

LAUNCHERS = {"lammps": "lmp-cfpm", "liggghts": "liggghts-cfpm"}
SHORT = ("-var", "duration", "0.01", "-log", "none")
IS_ROOT = os.geteuid() == 0


def as_user(*command, cwd):
    """As one without privileges, if this is not one, and without sudo, which would ask for a password."""
    environment = {name: value for name, value in ENVIRONMENT.items() if not name.startswith("CFPM_")}
    environment.update(HOME=str(cwd), PATH="/usr/bin:/bin", CMAKE_BUILD_TYPE="None")  # compiles in a third of the time
    without_privileges = ("setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups") if IS_ROOT else ()
    return call(*without_privileges, *command, cwd=cwd, env=environment)


@pytest.fixture(scope="module")
def checkout():
    """A copy of this checkout that belongs to a user without privileges, where the plugins are built."""
    with tempfile.TemporaryDirectory(prefix="cfpm-") as top:  # pytest's own folders are closed to other users
        folder = Path(top) / "cfpm"
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns("build", "out", ".git", "__pycache__"))
        if IS_ROOT:
            call("chown", "-R", "nobody:nogroup", top, cwd="/")
        as_user("./cfpm", "build", cwd=folder)
        yield folder


@pytest.mark.parametrize("host", LAUNCHERS)
def test_user_without_root(checkout, host):
    """The lines of docs/installation.md."""
    line = f"build/bin/{LAUNCHERS[host]} -in inputs/{host}/in.packing"
    assert line in (checkout / "docs" / "installation.md").read_text()
    assert "gran/cfpm: predict exact" in as_user(*line.split(), *SHORT, cwd=checkout)


@pytest.fixture(scope="module")
def packages(checkout):
    """One for each host, built by that user."""
    as_user("./cfpm", "package", cwd=checkout)
    return {host: next((checkout / "out" / "packages").glob(f"cfpm-{host}_*.deb")) for host in LAUNCHERS}


@pytest.mark.parametrize("host", LAUNCHERS)
def test_depends_on_this_host(packages, host):
    depends = call("dpkg-deb", "-f", packages[host], "Depends")
    assert f"{host} (= {version_of(host)})" in depends.strip().split(", ")


@pytest.mark.skipif(not IS_ROOT, reason="a bare Debian is made by root")
def test_in_a_bare_debian(packages, tmp_path_factory):
    """Installed with what they depend on, on 2 ranks, and purged without a trace."""
    folder = tmp_path_factory.mktemp("bare")
    script = ROOT / "tests" / "debian" / "in_bare_debian.sh"

    def inside(command):
        return call(script, folder, RELEASE, "sh", "-ec", command, cwd=folder)

    try:
        inside("apt-get update -q")
        for package in packages.values():
            shutil.copy(package, folder / RELEASE / "root")
        inside("apt-get install -y -q --no-install-recommends ./cfpm-*.deb openmpi-bin && rm cfpm-*.deb")
        for host, launcher in LAUNCHERS.items():
            deck = f"/usr/share/cfpm/inputs/{host}/in.packing"
            start = f"mpirun -np 2 {launcher} -in {deck} {' '.join(SHORT)}"
            output = inside(f"mkdir -p /tmp/{host} && cd /tmp/{host} && {start}")
            assert "gran/cfpm: predict exact" in output
        inside("apt-get purge -y -q cfpm-lammps cfpm-liggghts")
        left = inside("find / -xdev -name '*cfpm*' -not -path '/proc/*' -not -path '/sys/*' -not -path '/tmp/*'")
        assert left.split() == []
    finally:
        call("rm", "-rf", "--one-file-system", folder, cwd="/")  # never what is mounted there
