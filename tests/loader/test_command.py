# SPDX-License-Identifier: GPL-2.0-or-later
"""The command ./cfpm: from a checkout and a build in any folder, for any deck, and never with a plugin of before."""

import contextlib
import os
import re
import shutil
import subprocess
import tempfile
from collections import namedtuple
from pathlib import Path

import pytest
from harness import HOSTS
from harness.host import ROOT
from hosts import DECKS, PREDICTED

BANNERS = {"liggghts": "LIGGGHTS (Version", "lammps": "Large-scale Atomic/Molecular"}  # of the help

# root: the checkout; build: where its build went; at_once: the two processes that built it
Checkout = namedtuple("Checkout", "root build environment at_once")


@pytest.fixture(scope="module")
def checkout():
    """A copy of this one in a folder that make cannot take, built by two commands at once. Others may read it."""
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        root = Path(folder) / "of $HOME: 'a = b', \u00fc #1"
        root.mkdir()
        for name in ("cfpm", "CMakeLists.txt"):
            shutil.copy(ROOT / name, root)
        for name in ("packaging", "src"):
            shutil.copytree(ROOT / name, root / name)
        environment = {**os.environ, "XDG_CACHE_HOME": str(Path(folder) / "cache")}
        environment.pop("CFPM_BUILD", None)
        environment["CMAKE_BUILD_TYPE"] = "None"  # compiles in a third of the time
        # and what is built again from the same sources is not compiled again
        environment.update(CMAKE_CXX_COMPILER_LAUNCHER="ccache", CCACHE_DIR=str(Path(folder) / "compiled"))
        command, pipe = [root / "cfpm", "build"], subprocess.PIPE
        two = [subprocess.Popen(command, env=environment, stdout=pipe, stderr=pipe, text=True) for _ in range(2)]
        outputs = [process.communicate() for process in two]
        at_once = [subprocess.CompletedProcess(p.args, p.returncode, *said) for p, said in zip(two, outputs)]
        build = re.search(r"^cfpm: the launchers are in (.*)/bin$", at_once[0].stdout, re.MULTILINE)
        assert build, at_once
        yield Checkout(root, Path(build[1]), environment, at_once)


def cfpm(checkout, cwd, *words, env=None, prefix=()):
    return subprocess.run(
        [*prefix, checkout.root / "cfpm", *words],
        cwd=cwd,
        env={**checkout.environment, **(env or {})},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
    )


def without_cmake(folder):
    """An environment in which a build fails, and leaves the file "called" in the folder."""
    program = folder / "programs" / "cmake"
    program.parent.mkdir(exist_ok=True)
    program.write_text(f"#!/bin/sh\ntouch {folder}/called\necho no cmake here >&2\nexit 1\n")
    program.chmod(0o755)
    return {"PATH": f"{program.parent}:{os.environ['PATH']}"}


@pytest.fixture
def deck(tmp_path):
    (tmp_path / "in.deck").write_text(DECKS["lammps"])
    return "in.deck"


def test_two_builds_at_once(checkout):
    assert [done.returncode for done in checkout.at_once] == [0, 0], checkout.at_once
    waited = ["cfpm: waiting for another build" in done.stdout for done in checkout.at_once]
    built = ["Building CXX object" in done.stdout for done in checkout.at_once]
    assert sorted(waited) == [False, True] and built == [not w for w in waited]


@pytest.mark.parametrize("ranks", ["1", "2"])
@pytest.mark.parametrize("host", HOSTS)
def test_runs_from_such_a_checkout(tmp_path, checkout, host, ranks):
    (tmp_path / "in.deck").write_text(DECKS[host])
    done = cfpm(checkout, tmp_path, "run", "in.deck", "-np", ranks, "-suffix", "cfpm")
    assert done.returncode == 0 and PREDICTED in done.stdout, done.stdout + done.stderr


def test_build_folder_that_make_cannot_take(tmp_path, checkout):
    done = cfpm(checkout, tmp_path, "build", env={"CFPM_BUILD": str(tmp_path / "a b")})
    assert done.returncode != 0 and "a b'" in done.stderr and "set CFPM_BUILD" in done.stderr


def test_builds_nothing_if_nothing_changed(tmp_path, checkout, deck):
    done = cfpm(checkout, tmp_path, "run", deck, env=without_cmake(tmp_path))
    assert done.returncode == 0 and "Loop time" in done.stdout, done.stdout + done.stderr
    assert not (tmp_path / "called").exists()


@contextlib.contextmanager
def restored(*files):
    """Puts files back as they were, with their times."""
    with tempfile.TemporaryDirectory() as folder:
        saved = [(file, Path(folder) / str(k)) for k, file in enumerate(files)]
        for file, copy in saved:
            shutil.copy2(file, copy)
        yield
        for file, copy in saved:
            shutil.copy2(copy, file)


def test_run_builds_and_goes_on(tmp_path, checkout, deck):
    with restored(checkout.root / "src" / "loader" / "preload.cpp"):
        source = checkout.root / "src" / "loader" / "preload.cpp"
        source.write_text(source.read_text().replace("ERROR: cfpm loader", "ERROR: cfpm's loader"))
        done = cfpm(checkout, tmp_path, "run", deck)
        assert done.returncode == 0 and "Loop time" in done.stdout, done.stdout + done.stderr
        assert b"ERROR: cfpm's loader" in (checkout.build / "lib" / "cfpm_lammps_preload.so").read_bytes()
    done = cfpm(checkout, tmp_path, "run", deck)  # and back, also to the time of before, which make takes for no change
    assert done.returncode == 0, done.stdout + done.stderr
    assert b"ERROR: cfpm's loader" not in (checkout.build / "lib" / "cfpm_lammps_preload.so").read_bytes()


def change_content(checkout):
    """As a checkout of another commit by a tool that keeps times."""
    file = checkout.root / "src" / "core" / "numbers" / "vec3.h"
    before = file.stat()
    file.write_text(file.read_text() + "// changed\n")
    os.utime(file, ns=(before.st_atime_ns, before.st_mtime_ns))
    return file


def add_file(checkout):
    file = checkout.root / "src" / "core" / "new.h"
    file.write_text("")
    return file


def remove_product(checkout):
    file = checkout.build / "lib" / "cfpmplugin.so"
    file.unlink()
    return file


def configure_by_hand(checkout):
    file = checkout.build / "CMakeCache.txt"
    os.utime(file)
    return file


@pytest.mark.parametrize("change", [change_content, add_file, remove_product, configure_by_hand])
def test_builds_after_a_change(tmp_path, checkout, deck, change):
    """And with a build that fails, there is no run, nor is there one by the next command."""
    files = ("finished", "CMakeCache.txt", "lib/cfpmplugin.so")
    with restored(checkout.root / "src" / "core" / "numbers" / "vec3.h", *(checkout.build / file for file in files)):
        changed = change(checkout)
        for _ in range(2):
            done = cfpm(checkout, tmp_path, "run", deck, env=without_cmake(tmp_path))
            assert done.returncode != 0 and "cmake failed" in done.stderr and "Loop time" not in done.stdout
            if change is add_file:
                changed.unlink(missing_ok=True)  # the first command began a build that did not end


def test_failing_build_stops(tmp_path):
    """./cfpm never goes on with a plugin of before."""
    for options in (["-DBUILD_TESTING=OFF"], ["-DCMAKE_CXX_COMPILER_LAUNCHER=false"]):
        subprocess.run(["cmake", "-S", ROOT, "-B", tmp_path, *options], check=True, capture_output=True)
    environment = {**os.environ, "CFPM_BUILD": str(tmp_path)}
    done = subprocess.run([ROOT / "cfpm", "build"], env=environment, capture_output=True, text=True)
    assert done.returncode != 0 and "the build failed" in done.stderr


def test_runs_what_another_user_built(checkout):
    if os.getuid() != 0:
        pytest.skip("only root can be another user")
    with tempfile.TemporaryDirectory() as folder:
        os.chown(folder, 65534, 65534)
        (Path(folder) / "in.deck").write_text(DECKS["lammps"])
        nobody = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
        done = cfpm(checkout, folder, "run", "in.deck", "-np", "2", env={"HOME": folder}, prefix=nobody)
        assert done.returncode == 0 and "Loop time" in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize(
    "words, message",
    [
        ([], "expected a deck"),
        (["."], "expected a deck, found the folder '.'"),
        (["in.absent"], "cannot read the deck 'in.absent'"),
        (["in.deck", "-host", "none"], "expected liggghts or lammps after -host, found 'none'"),
        (["in.deck", "-np", "0"], "expected a number of ranks after -np, found '0'"),
    ],
)
def test_refuses(tmp_path, checkout, deck, words, message):
    done = cfpm(checkout, tmp_path, "run", *words)
    assert done.returncode != 0 and f"cfpm: run: {message}" in done.stderr


def assert_runs(checkout, folder, host, *words):
    done = cfpm(checkout, folder, "run", "in.deck", *words, "-h")
    assert BANNERS[host] in done.stdout, done.stdout + done.stderr


LINES = {
    "liggghts": [
        "pair_style gran model hooke tangential history",
        "pair_style  hybrid/overlay\tgran/cfpm  model hertz soft 1.0",
        "fix walls all mesh/surface file wall.stl type 1",
        "fix young all property/global youngsModulus peratomtype 5e6",
        "fix seed all particletemplate/sphere 123457 atom_type 1",
        "communicate single vel yes",
        "atom_style granular",
        'if "${style} == stock" then "pair_style gran model hooke" else "pair_style ${other}"',
        "fix &\n floor all wall/gran &\n model hooke primitive type 1 zplane 0.0",
    ],
    "lammps": [
        "pair_style gran/hooke/history 1e5 NULL 100 NULL 0.3 1",
        "pair_style gran/cfpm hertz 1e5 NULL 100 NULL 0.3 1",
        "pair_style hybrid granular gran/hooke 1e5 NULL 100 NULL 0.3 1",
        "pair_style granular",
        "comm_modify vel yes",
        "fix floor all wall/gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1 zplane 0.0 NULL",
        "fix more all pour 100 1 4767548",
        "# pair_style gran model hooke\n  comm_modify vel yes",
    ],
}


@pytest.mark.parametrize("host, line", [(host, line) for host, lines in LINES.items() for line in lines])
def test_run_picks_the_host(tmp_path, checkout, host, line):
    (tmp_path / "in.deck").write_text(f"units si\n{line}\n")
    assert_runs(checkout, tmp_path, host)


@pytest.mark.parametrize("name", ["law", '"a law"'])
@pytest.mark.parametrize("host", HOSTS)
def test_run_picks_the_host_by_an_included_file(tmp_path, checkout, host, name):
    (tmp_path / name.strip('"')).write_text(LINES[host][0])
    (tmp_path / "in.deck").write_text(f"include {name}  # which\n")
    assert_runs(checkout, tmp_path, host)


@pytest.mark.parametrize("host", HOSTS)
def test_run_takes_all_decks_of_this_project(tmp_path, checkout, host):
    for source in (ROOT / "inputs" / host).glob("in.*"):
        shutil.copy(source, tmp_path / "in.deck")
        assert_runs(checkout, tmp_path, host)


@pytest.mark.parametrize(
    "text, words",
    [
        ("units si\npair_style ${style}\n", ["no command in 'in.deck'"]),
        ("comm_modify vel yes\natom_style granular\n", ["'atom_style granular'", "'comm_modify vel yes'"]),
    ],
    ids=["of none", "of both"],
)
def test_run_says_that_it_cannot_tell(tmp_path, checkout, text, words):
    (tmp_path / "in.deck").write_text(text)
    done = cfpm(checkout, tmp_path, "run", "in.deck")
    assert done.returncode != 0 and done.stdout == ""
    for word in [*words, "./cfpm run in.deck -host liggghts"]:
        assert word in done.stderr
    for host in HOSTS:
        assert_runs(checkout, tmp_path, host, "-host", host)
