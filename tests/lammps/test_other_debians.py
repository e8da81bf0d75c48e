# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin builds for the LAMMPS of other Debians too, and in the newest stable one does what its tests ask for.

Packages are fetched and unpacked, not installed: a build looks at the folder, and root runs what is in it.
"""

import os
import re
import shutil
from concurrent.futures import ThreadPoolExecutor

import pytest
from harness.host import ROOT
from harness.lammps import run
from harness.programs import RELEASE, call
from own_lammps import apt

SUITES = {"bookworm": "liblammps0", "trixie": "liblammps0t64", "forky": "liblammps0t64"}
RUNS = "trixie"
TO_RUN = ("lammps", "openmpi-bin", "python3-numpy", "python3-pytest", "base-files", "bash", "coreutils", "dash")
IS_ROOT = os.geteuid() == 0

# Every sub-model of pair_style granular. Contacts and walls of one instant to the last bit, on 1 and 2 ranks; predicted
# contacts and walls, impulses, restarts
REPRESENTATIVE = (
    *(
        f"test_granular.py::test_equals_stock[{case}]"
        for case in (
            "all with springs-off-1",
            "all with springs-on-2",
            "all without-off-1",
            "sizes-off-1",
            "sizes without-off-1",
            "sizes rolling-off-1",
            "material-off-1",
            "types-on-2",
            "some rolling-off-1",
            "sizes of all-on-2",
            "some without-off-1",
            "some dmt-off-1",
            "mixed by the host-off-1",
        )
    ),
    "test_granular.py::test_continues_as_stock[tsuji-no_pair_style]",
    "test_granular.py::test_heat_of_a_wall_is_that_of_stock",
    "test_granular.py::test_mdr_is_refused",
    "test_granular_predicted.py::test_head_on[material]",
    "test_granular_predicted.py::test_continues_to_the_last_digit[mixed-False]",
    "test_granular_predicted.py::test_on_two_ranks[mixed]",
    "test_granular_walls.py::test_oblique[material]",
    "test_coeff_restitution.py",
    "test_other_types.py::test_of_the_host",
    "test_other_types.py::test_of_the_host_where_it_twists",
    "test_impulse_of_models.py::test_granular_at_any_step",
    "test_impulse_of_models.py::test_oblique",
    "test_turn_resistance.py",
    *(
        f"test_area_springs.py::test_loads_and_unloads[{spring}-rk4]"
        for spring in ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
    ),
    "test_adhesion.py::test_head_on",
    "test_adhesion.py::test_head_on_at_a_wall",
    "test_adhesion.py::test_oblique_as_the_host",
    "test_adhesion.py::test_rolls_slower",
    "test_wall_contacts.py::test_predicted",
    "test_wall_contacts.py::test_as_stock_in_its_own_step[wall/gran-1]",
    "test_wall_contacts.py::test_as_stock_in_its_own_step[wall/gran/region-1]",
)


@pytest.fixture(scope="module", params=[suite for suite in SUITES if suite != RELEASE])
def other(tmp_path_factory, request):
    """The root folder of another Debian with LAMMPS: as far as a build looks, or as what is run there needs."""
    suite = request.param
    folder = tmp_path_factory.mktemp(suite)
    commands = [("update", "--error-on=any"), ("download", "lammps", SUITES[suite], "liblammps-dev")]
    if suite == RUNS and IS_ROOT:
        commands.append(("install", "--download-only", "--no-install-recommends", "-y", *TO_RUN))
    for command in commands:
        done = apt(folder, "deb", suite, *command)
        if done.returncode != 0:
            pytest.skip(f"Debian {suite} is out of reach: {done.stderr.strip()[-200:]}")
    system = folder / suite
    for name in ("bin", "sbin", "lib", "lib64"):
        (system / "usr" / name).mkdir(parents=True, exist_ok=True)
        (system / name).symlink_to(f"usr/{name}")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda package: call("dpkg", "-x", package, system), folder.glob("**/*.deb")))
    yield system
    call("rm", "-rf", "--one-file-system", folder, cwd="/")  # never what is mounted there


@pytest.fixture(scope="module")
def build(tmp_path_factory, other):
    """The folder in which the plugin was built for it."""
    folder = tmp_path_factory.mktemp("build")
    (config,) = (other / "usr").rglob("LAMMPSConfig.cmake")
    options = ("-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF", "-DCFPM_LIGGGHTS=OFF", f"-DLAMMPS_DIR={config.parent}")
    # newer Debians do not have MPI's library for C++, which this one's headers ask for
    options += ("-DMPI_CXX_SKIP_MPICXX=ON", "-DCMAKE_MODULE_LINKER_FLAGS=-Wl,--as-needed")
    call("cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=None", *options)  # compiles in half the time
    call("cmake", "--build", folder, "--parallel", "2", "--target", "cfpm_lammps", "cfpm_lammps_preload")
    return folder


def test_builds_and_is_refused_here(tmp_path, build):
    process = run('print "the deck was read"\n', tmp_path, program=str(build / "bin" / "lmp-cfpm"), check=False)
    assert process.returncode != 0 and "the deck was read" not in process.stdout
    refusals = ("cfpm loader: cannot load the plugin: .*undefined symbol", ".*built for LAMMPS [0-9]+, this host")
    assert re.search("|".join(f"ERROR: {refusal}" for refusal in refusals), process.stdout), process.stdout


@pytest.mark.skipif(not IS_ROOT, reason="the programs of another Debian are run by root, in its folder as theirs")
def test_runs_there(other, build):
    if other.name != RUNS:
        pytest.skip(f"of other Debians only {RUNS} is run")
    home = other / "root" / "cfpm"
    for part in ("harness", "inputs", "setup.cfg", "tests"):
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy
        home.mkdir(parents=True, exist_ok=True)
        copy(ROOT / part, home / part)
    for part in ("bin", "lib"):
        shutil.copytree(build / part, home / "build" / part, symlinks=True)
    for name in ("tmp", "proc", "sys", "dev", "etc/apt/apt.conf.d"):
        (other / name).mkdir(parents=True, exist_ok=True)
    # what their scripts would do after an installation
    (other / "usr/bin/mpirun").symlink_to("mpirun.openmpi")
    libraries = ":".join(f"/usr/lib/{os.uname().machine}-linux-gnu/{name}" for name in ("blas", "lapack"))
    (other / "complete").touch()
    said = call(
        ROOT / "tests" / "debian" / "in_bare_debian.sh",
        other.parent,
        other.name,
        *("env", "CFPM_BUILD=/root/cfpm/build", f"LD_LIBRARY_PATH={libraries}", "PYTHONDONTWRITEBYTECODE=1"),
        *("python3", "-m", "pytest", "-q", "-p", "no:cacheprovider", "--color=no", "--durations=0"),
        *(f"/root/cfpm/tests/lammps/{test}" for test in REPRESENTATIVE),
    )
    print(said)
