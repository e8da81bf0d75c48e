# SPDX-License-Identifier: GPL-2.0-or-later
"""Every way into the stock binary, in serial and on 2 ranks, again after the command "clear"."""

import os
import re
import shutil
import subprocess

import drum
import pytest
from head_on import COLLISION, energies
from harness.host import BUILD
from harness.lammps import INCLUDE, LAUNCHER, PRELOAD, STOCK, run
from stock_words import in_stock_words

WAYS = {
    "launcher": (LAUNCHER, {}, ""),
    "preload": (STOCK, {"LD_PRELOAD": PRELOAD}, ""),
    "include": (STOCK, {}, INCLUDE),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("way", WAYS)
def test_styles_are_there(tmp_path, way, ranks):
    program, env, line = WAYS[way]
    deck = line + COLLISION + "clear\n" + line + COLLISION
    found = energies(run(deck, tmp_path, program=program, env=env, np=ranks).stdout)
    assert len(found) == 2 and found[0] == found[1]
    start = 0.5 * 800 * 3.141592653589793 / 6 * 0.05**3
    assert 0.5 * start < found[0] < start  # they met, and half of the energy stays with the centre of mass


@pytest.mark.parametrize("law", ["hooke", "hertz"])
@pytest.mark.parametrize("hybrid", [False, True], ids=["alone", "hybrid"])
def test_suffix_turns_a_stock_deck_into_a_predicted_run(tmp_path, law, hybrid):
    """The same to the last digit, with a floor and a region as walls."""
    deck = drum.deck(drum.FRESH, law)
    if hybrid:
        deck = deck.replace("pair_style gran/cfpm", "pair_style hybrid gran/cfpm")
        deck = deck.replace("pair_coeff * *", "pair_coeff * * gran/cfpm")
    run(deck + drum.half("bed"), tmp_path)
    expected = (tmp_path / "bed.dump").read_text()
    stock = deck.replace("pair_coeff * * gran/cfpm", f"pair_coeff * * gran/{law}/history")
    predictor = "exact" if law == "hooke" else "rk4"
    run(in_stock_words(stock) + drum.half("bed"), tmp_path, options=["-suffix", "cfpm", "-predict", predictor])
    same = (tmp_path / "bed.dump").read_text() == expected
    assert same


def test_suffix_survives_a_restart(tmp_path):
    deck = drum.deck(drum.FRESH, "hooke", walls=()).replace("gran/cfpm hooke", "gran/hooke/history")
    output = run(deck + "run 10\nwrite_restart bed.restart\n", tmp_path, options=["-suffix", "cfpm"]).stdout
    again = drum.deck("read_restart bed.restart", "hooke", pair=False, walls=()) + "run 10\n"
    assert "gran/cfpm: predict auto" in output
    assert "gran/cfpm: predict auto" in run(again, tmp_path, options=["-suffix", "cfpm"]).stdout


def test_stock_has_no_such_style(tmp_path):
    process = run(COLLISION, tmp_path, program=STOCK, check=False)
    assert process.returncode != 0 and "Unrecognized pair style 'gran/cfpm'" in process.stdout


def include_in(folder):
    """Copies plugin and include file into the folder."""
    folder.mkdir()
    shutil.copy(BUILD / "lib" / "cfpmplugin.so", folder)
    text = (BUILD / "lib" / "cfpm.lammps").read_text()
    path = os.fsencode(folder / "cfpmplugin.so").hex()
    text, changes = re.subn(r'fromhex\("[0-9a-f]+"\)', f'fromhex("{path}")', text)
    assert changes == 1
    (folder / "cfpm.lammps").write_text(text)


@pytest.mark.parametrize("locale", ["C.UTF-8", "C"])
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", ["with space", "with:colon", "with'quotes\"", "w\u00efth \u00fcmlaut"])
def test_include_from_any_folder(tmp_path, name, ranks, locale):
    folder = tmp_path / name
    include_in(folder)
    line = "include cfpm.lammps\n"
    deck = line + COLLISION + "clear\n" + line + COLLISION
    assert len(energies(run(deck, folder, program=STOCK, np=ranks, env={"LC_ALL": locale}).stdout)) == 2


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("content, words", [(None, "is missing"), ("no library", "is there but cannot be loaded")])
def test_include_without_a_plugin(tmp_path, content, words, ranks):
    folder = tmp_path / "with space"
    include_in(folder)
    plugin = folder / "cfpmplugin.so"
    if content is None:
        plugin.unlink()
    else:
        plugin.write_text(content)
    process = run("include cfpm.lammps\n" + COLLISION, folder, program=STOCK, np=ranks, check=False)
    assert process.returncode != 0 and f"ERROR: cfpm.lammps: the plugin {plugin} {words}" in process.stdout
    assert "Loop time" not in process.stdout


def test_exports_no_more_than_its_entries():
    table = subprocess.run(
        ["nm", "-D", "--defined-only", BUILD / "lib" / "cfpmplugin.so"], capture_output=True, text=True, check=True
    ).stdout
    assert sorted(line.split()[-1] for line in table.splitlines()) == ["cfpm_register", "lammpsplugin_init"]
