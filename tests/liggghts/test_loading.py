# SPDX-License-Identifier: GPL-2.0-or-later
"""Every way into the plugin: the launcher, mpirun, partitions, standard input, clear, LD_PRELOAD, -suffix."""

import os
import subprocess

import falling_bed as bed
import pytest
from harness.host import BUILD, ENVIRONMENT
from harness.liggghts import PRELOAD, STOCK, run

STEPS = 200  # the lowest spheres have bounced by then


def fall(styles=bed.PREDICTED, name="bed.dump"):
    deck = bed.box() + bed.pair(styles) + bed.fixes(styles)
    return deck + bed.dump_particles(name, every=STEPS) + f"run {STEPS}\n"


@pytest.fixture
def folder(tmp_path):
    bed.write(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """What a serial run by the launcher writes."""
    folder = tmp_path_factory.mktemp("launcher")
    bed.write(folder)
    process = run(fall(), folder)
    assert "gran/cfpm: predict exact" in process.stdout
    return folder / "bed.dump"


def test_run_says_more_than_free_fall(folder, expected):
    """Otherwise all the comparisons with it would be hollow."""
    run(fall(bed.STOCK), folder, program=STOCK)
    assert (folder / "bed.dump").read_bytes() != expected.read_bytes()


def test_launcher_on_two_ranks(folder):
    """Trajectories are compared in test_rank_independence.py."""
    process = run(fall(), folder, np=2)
    assert "gran/cfpm: predict exact" in process.stdout and "2 by 1 by 1 MPI processor grid" in process.stdout


@pytest.mark.parametrize("ranks", [1, 2])
def test_standard_input(folder, expected, ranks):
    process = run(fall(), folder, np=ranks, stdin=True)
    assert "gran/cfpm: predict exact" in process.stdout
    if ranks == 1:
        bed.assert_same_text(folder / "bed.dump", expected, "through stdin")


def test_partitions(folder, expected):
    run("variable part world a b\n" + fall(name="${part}.dump"), folder, np=2, options=("-partition", "2x1"))
    for part in ("a.dump", "b.dump"):
        bed.assert_same_text(folder / part, expected, part)


def test_clear(folder, expected):
    """The host forgets all styles at "clear" and makes its own again."""
    run(fall(name="1.dump") + "clear\n" + fall(name="2.dump"), folder)
    for dump in ("1.dump", "2.dump"):
        bed.assert_same_text(folder / dump, expected, dump)


@pytest.mark.parametrize("ranks", [1, 2])
def test_preload_with_stock_program(folder, expected, ranks):
    process = run(fall(), folder, np=ranks, program=STOCK, env={"LD_PRELOAD": PRELOAD})
    assert "gran/cfpm: predict exact" in process.stdout
    if ranks == 1:
        bed.assert_same_text(folder / "bed.dump", expected, "with LD_PRELOAD")


@pytest.mark.parametrize("ranks", [1, 2])
def test_suffix_turns_a_stock_deck_into_a_predicted_run(folder, expected, ranks):
    process = run(fall(bed.STOCK), folder, np=ranks, options=("-predict", "exact", "-suffix", "cfpm"))
    assert "gran/cfpm: predict exact" in process.stdout
    if ranks == 1:
        bed.assert_same_text(folder / "bed.dump", expected, "with -suffix cfpm")


def test_preload_is_harmless_elsewhere(tmp_path):
    process = subprocess.run(["/bin/true"], env={**ENVIRONMENT, "LD_PRELOAD": PRELOAD}, capture_output=True)
    assert (process.returncode, process.stdout, process.stderr) == (0, b"", b"")
    # programs that a deck starts inherit it
    process = run("shell echo from the shell > said\n", tmp_path)
    assert (tmp_path / "said").read_text() == "from the shell\n"
    assert "ld.so" not in process.stdout


@pytest.mark.parametrize(
    "library, symbol",
    [("cfpm_liggghts.so", "cfpm_register"), ("cfpm_liggghts_preload.so", "_ZN9LAMMPS_NS6LAMMPS6createEv")],
)
def test_exports_no_more_than_it_must(library, symbol):
    """Any other would stand in front of the host's own of that name."""
    table = subprocess.check_output(["nm", "-D", "--defined-only", os.path.join(BUILD, "lib", library)], text=True)
    of_preload = ["MPI_Abort"] if "preload" in library else []
    assert sorted(line.split()[-1] for line in table.splitlines()) == [*of_preload, symbol]
