# SPDX-License-Identifier: GPL-2.0-or-later
"""A LAMMPS with package PLUGIN, which Debian's has not: built from Debian's sources of the installed version.

The build, some minutes of CPU time, is kept in a folder of the user's cache.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from harness.programs import RELEASE, call, version_of

CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "cfpm"


def sources_list(kind, suite):
    return (
        f"Types: {kind}\nURIs: http://deb.debian.org/debian\nSuites: {suite}\nComponents: main\n"
        "Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg\n"
    )


def apt(folder, kind, suite, *command):
    """apt-get with lists and packages of its own below the folder. kind: deb or deb-src."""
    for part in ("parts", "lists/partial", "cache/archives/partial"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    (folder / "parts" / "debian.sources").write_text(sources_list(kind, suite))
    options = {
        "Dir::Etc::sourcelist": "/dev/null",
        "Dir::Etc::sourceparts": folder / "parts",
        "Dir::State::lists": folder / "lists",
        "Dir::State::status": "/dev/null",
        "Dir::Cache": folder / "cache",
        "APT::Sandbox::User": "root",
        "Acquire::Retries": 2,
    }
    given = [f"-o{name}={value}" for name, value in options.items()]
    return subprocess.run(["apt-get", *given, *command], cwd=folder, capture_output=True, text=True, timeout=300)


def fetch_sources(folder):
    """Unpacks the sources of Debian's LAMMPS; skips the test, with a word, where they are out of reach."""
    packages = folder / "packages"
    packages.mkdir(parents=True)
    errors = ""
    for command in (("update", "--error-on=any"), ("source", "--download-only", "lammps")):
        done = apt(packages, "deb-src", RELEASE, *command)
        errors += done.stderr
    archives = [file for file in packages.glob("lammps_*.orig.tar.*") if file.suffix != ".asc"]
    if not archives:
        pytest.skip(f"the sources of Debian's LAMMPS are out of reach: {errors.strip()[-200:]}")
    (folder / "unpacked").mkdir()
    call("tar", "xf", archives[0], "-C", folder / "unpacked")
    (version,) = [file for file in folder.glob("unpacked/**/version.h") if file.parent.name == "src"]
    version.parents[1].rename(folder / "source")
    for used in (packages, folder / "unpacked"):
        shutil.rmtree(used)


def leave_out_unused_styles(source):
    """Deletes the sources of LAMMPS's styles, two in five of all, that nothing else here includes: less to compile."""
    style = re.compile(r"(angle|bond|compute|dihedral|dump|fix|improper|pair|region)_\w+")
    folder = source / "src"
    files = {}
    for file in (*folder.glob("*.h"), *folder.glob("*.cpp")):
        files.setdefault(file.stem, []).append(file)

    def included(paths):
        return {name for path in paths for name in re.findall(r'#include "(\w+)\.h"', path.read_text(errors="replace"))}

    wanted = {name for name in files if not style.fullmatch(name)}
    wanted |= {"fix_nve_sphere", "compute_ke", "compute_pe", "compute_pressure", "compute_temp", "dump_cfg"}
    wanted |= included([*folder.glob("GRANULAR/*"), *folder.glob("PLUGIN/*")]) & files.keys()
    new = wanted
    while new:
        new = (included([path for name in new for path in files[name]]) & files.keys()) - wanted
        wanted = wanted | new
    for name in files.keys() - wanted:
        for file in files[name]:
            file.unlink()


def build():
    """The folders of the sources and of the build, in which lmp is the program."""
    folder = CACHE / f"lammps-{version_of('lammps', 'source:Version')}-with-plugin"
    source, built = folder / "source", folder / "build"
    if not (built / "lmp").exists():
        shutil.rmtree(folder, ignore_errors=True)
        fetch_sources(folder)
        leave_out_unused_styles(source)
        off = [f"-D{name}=OFF" for name in ("BUILD_OMP", "WITH_JPEG", "WITH_PNG", "WITH_GZIP", "WITH_FFMPEG")]
        on = [f"-D{name}=ON" for name in ("BUILD_MPI", "BUILD_SHARED_LIBS", "PKG_PLUGIN", "PKG_GRANULAR")]
        quick = ("-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0")
        call("cmake", "-S", source / "cmake", "-B", built, *quick, *on, *off)
        call("cmake", "--build", built, "--parallel", os.cpu_count())
    return source, built
