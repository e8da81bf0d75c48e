# SPDX-License-Identifier: GPL-2.0-or-later
"""The launchers: in any folder, and never a stock run in place of a predicted one."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from harness import HOSTS
from harness.host import BUILD
from hosts import DECKS, PREDICTED

# LD_PRELOAD ends a path at a space and at a colon, and replaces $LIB
ODD_NAMES = ["with space", "with:colon", "with$LIB", "with'quotes\"", "w\u00efth \u00fcmlaut"]


@pytest.fixture(params=HOSTS)
def host(request):
    return request.param


def installed(folder, host):
    """The launcher of a build that was copied to the folder."""
    for part, names in (("bin", [Path(HOSTS[host].LAUNCHER).name]), ("lib", os.listdir(BUILD / "lib"))):
        (folder / part).mkdir(parents=True)
        for name in names:
            shutil.copy(BUILD / part / name, folder / part)
    return str(folder / "bin" / Path(HOSTS[host].LAUNCHER).name)


def preload_object(launcher, host):
    return Path(launcher).parents[1] / "lib" / Path(HOSTS[host].PRELOAD).name


def launch(host, folder, launcher=None, env=None, **options):
    """A stock deck with -suffix cfpm by a launcher; the finished process."""
    launcher = launcher or HOSTS[host].LAUNCHER
    return HOSTS[host].run(
        DECKS[host], folder, program=launcher, options=["-suffix", "cfpm"], env=env, check=False, **options
    )


def assert_refused(process, *words):
    assert process.returncode != 0 and "ERROR" in process.stdout, process.stdout
    for word in words:
        assert word in process.stdout
    assert "Loop time" not in process.stdout  # not one step


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", ODD_NAMES)
def test_works_in_any_folder(tmp_path, host, name, ranks):
    launcher = installed(tmp_path / name, host)
    deck = "shell echo from the shell > said\n" + DECKS[host]
    process = HOSTS[host].run(deck, tmp_path, program=launcher, options=["-suffix", "cfpm"], np=ranks)
    assert PREDICTED in process.stdout
    assert "ld.so" not in process.stdout and (tmp_path / "said").read_text() == "from the shell\n"


@pytest.mark.parametrize("name", ["plain", "with space"])
@pytest.mark.parametrize("before", ["", "libdl.so.2"])
def test_programs_that_a_deck_starts_are_as_without_it(tmp_path, host, name, before):
    launcher = installed(tmp_path / name, host)
    env = {"LD_PRELOAD": before} if before else {}
    process = HOSTS[host].run("shell env > environment\n", tmp_path, program=launcher, env=env)
    assert "ld.so" not in process.stdout
    environment = dict(line.partition("=")[::2] for line in (tmp_path / "environment").read_text().splitlines())
    assert environment.get("LD_PRELOAD", "") == before and "CFPM_LAUNCHED" not in environment


def test_help_has_the_status_of_the_host(host):
    commands = ([program, "-h"] for program in (HOSTS[host].STOCK, HOSTS[host].LAUNCHER))
    stock, ours = (subprocess.run(c, capture_output=True, text=True, stdin=subprocess.DEVNULL) for c in commands)
    assert ours.returncode == stock.returncode
    assert ours.stderr == stock.stderr and "pair styles" in ours.stdout.lower()


def test_object_is_missing(tmp_path, host):
    launcher = installed(tmp_path, host)
    preload_object(launcher, host).unlink()
    assert_refused(launch(host, tmp_path, launcher), "cannot read", preload_object(launcher, host).name)


def test_object_is_broken(tmp_path, host):
    launcher = installed(tmp_path, host)
    preload_object(launcher, host).write_text("no library")
    assert_refused(launch(host, tmp_path, launcher), "does not get into")


def test_plugin_is_missing(tmp_path, host):
    launcher = installed(tmp_path / "with$LIB", host)
    plugin = preload_object(launcher, host).with_name(HOSTS[host].PLUGIN.name)
    plugin.unlink()
    assert_refused(launch(host, tmp_path, launcher), str(plugin))


def before_path(folder):
    return {"PATH": f"{folder}:{os.environ['PATH']}"}


def compiled(file, text, *options):
    subprocess.run(["cc", "-o", file, "-x", "c", "-", "-x", "none", *options], input=text, text=True, check=True)


def test_static_host(tmp_path, host):
    compiled(tmp_path / HOSTS[host].STOCK, '#include <stdio.h>\nint main() { puts("a stock run"); }', "-static")
    process = launch(host, tmp_path, env=before_path(tmp_path))
    assert_refused(process, "does not get into")
    assert "a stock run" not in process.stdout


def test_host_with_privileges(tmp_path, host):
    if os.getuid() != 0:
        pytest.skip("only root can give a program to another user")
    program = tmp_path / HOSTS[host].STOCK
    shutil.copy(shutil.which(HOSTS[host].STOCK), program)
    os.chown(program, 65534, 65534)
    program.chmod(0o4755)
    assert_refused(launch(host, tmp_path, env=before_path(tmp_path)), "does not get into")


def test_host_is_a_script(tmp_path, host):
    program = tmp_path / HOSTS[host].STOCK
    program.write_text("#!/bin/sh\necho a stock run\n")
    program.chmod(0o755)
    process = launch(host, tmp_path, env=before_path(tmp_path))
    assert_refused(process, "cannot come into", "a script that starts it")
    assert "a stock run" not in process.stdout


def test_host_never_calls_the_function(tmp_path, host):
    """As a host whose library was linked with -Bsymbolic: the function is there, but no call of it gets here."""
    table = subprocess.check_output(["nm", "-D", "--defined-only", HOSTS[host].PRELOAD], text=True)
    library = tmp_path / "libhost.so"
    compiled(library, f"void {table.split()[-1]}(void *lammps) {{}}", "-shared", "-fPIC")
    link = ["-Wl,--no-as-needed", library, f"-Wl,-rpath,{tmp_path}"]
    compiled(tmp_path / HOSTS[host].STOCK, '#include <stdio.h>\nint main() { puts("a stock run"); }', *link)
    assert_refused(launch(host, tmp_path, env=before_path(tmp_path)), "a stock run", "a run without the plugin")
