# SPDX-License-Identifier: GPL-2.0-or-later
"""The command "plugin" of a LAMMPS built from sources: a plugin built against these, its list, unloading, clear."""

import re

import own_lammps
import pytest
from head_on import COLLISION, energies
from harness.host import ROOT
from harness.lammps import run
from harness.programs import call

STYLES = {
    "gran/cfpm": "pair",
    "gran/hooke/history/cfpm": "pair",
    "gran/hooke/cfpm": "pair",
    "gran/hertz/history/cfpm": "pair",
    "granular/cfpm": "pair",
    "nve/cfpm": "fix",
    "nve/sphere/cfpm": "fix",
    "wall/gran/cfpm": "fix",
    "wall/gran/region/cfpm": "fix",
    "CFPM_CONTACTS": "fix",
}
IMPULSES = COLLISION.replace("0.3 1\n", "0.3 1 predict impulse\n")


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    """Its program, and the folder with the plugin for it."""
    source, built = own_lammps.build()
    folder = tmp_path_factory.mktemp("plugin")
    options = ("-DBUILD_TESTING=OFF", "-DCFPM_VALIDATION=OFF", "-DCFPM_LIGGGHTS=OFF", f"-DLAMMPS_SOURCE_DIR={source}")
    call("cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=None", *options)  # compiles in half the time
    call("cmake", "--build", folder, "--parallel", "2", "--target", "cfpm_lammps")
    return str(built / "lmp"), folder / "lib"


def listed(output):
    """The styles of every "plugin list"."""
    lists = output.split("Currently loaded plugins\n")[1:]
    return [dict(reversed(line) for line in re.findall(r"\d+: (\w+) style plugin (\S+)", part)) for part in lists]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("collision", [COLLISION, IMPULSES], ids=["exact", "impulse"])
def test_load_list_unload_clear(tmp_path, host, collision, ranks):
    """What is unloaded while it is in use goes with its styles; then, and after "clear", it can be loaded again."""
    program, folder = host
    load = f"plugin load {folder}/cfpmplugin.so\n"
    deck = load + "plugin list\n" + collision + "plugin unload fix nve/cfpm\nplugin list\nplugin clear\nplugin list\n"
    output = run(deck + "clear\n" + load + collision + "clear\n" + load + collision, tmp_path, program, np=ranks)
    energy = energies(output.stdout)
    assert len(energy) == 3 and len(set(energy)) == 1
    full, without, empty = listed(output.stdout)
    assert full == STYLES
    assert without == {name: kind for name, kind in STYLES.items() if name != "nve/cfpm"}
    assert empty == {}


def test_the_path_of_plugins(tmp_path, host):
    """A host that knows LAMMPS_PLUGIN_PATH, since 2022, needs no command; an older one says that it has no such style.
    """
    program, folder = host
    process = run(COLLISION, tmp_path, program, env={"LAMMPS_PLUGIN_PATH": str(folder)}, check=False)
    if "LAMMPS (29 Sep 2021" in process.stdout:
        assert process.returncode != 0 and "Unrecognized pair style 'gran/cfpm'" in process.stdout
    else:
        assert process.returncode == 0 and len(energies(process.stdout)) == 1
