# SPDX-License-Identifier: GPL-2.0-or-later
"""Every ./cfpm command and launcher that a page names can be given like that: command, exhibit, options, values, deck.

Programs that take options are asked by --help behind the words of the page: values before it are read as in a run.
"""

import functools
import re
import shlex
import subprocess

import pytest
from harness.decks import variables
from harness.host import ROOT
from pages import PAGES, code_of

PYTHON = "/usr/bin/python3"
HELP = subprocess.run([ROOT / "cfpm", "help"], check=True, capture_output=True, text=True).stdout
COMMANDS = {*re.findall(r"^  ([a-z]+)\b", HELP, re.MULTILINE), "help"}
METHODS = {"exact", "trapezoid", "rk2", "rk4", "impulse", "verlet", "none", "auto"}
# the program behind a command, and what it needs that the user does not give
PROGRAMS = {
    "bench": ["validation/bench/bench.py", "--out", "."],
    "demo": ["validation/packing/demo.py", "--out", "."],
    "gallery": ["validation/gallery/gallery.py", "--out", "."],
    "vtk": ["harness/vtk.py"],
}
PLACEHOLDER = re.compile(r"[A-Z]+(\.\.\.)?|\.\.\.")
COMMAND = re.compile(r"(\./cfpm|liggghts-cfpm|lmp-cfpm)((?: \S+)*)")


def commands_of(page):
    """Every command of a page as a list of words: ["./cfpm", "run", "DECK"]. What is optional is given."""
    for line in code_of(page):
        for program, words in COMMAND.findall(re.sub(r" #.*|  +[a-z\d].*|[|;&].*", "", line.strip())):
            yield [program, *shlex.split(re.sub(r"[\[\]]", "", words))]


def is_placeholder(word):
    return PLACEHOLDER.fullmatch(word) is not None


@functools.lru_cache(maxsize=None)
def assert_takes(program, *words):
    """A program of this project that reads its options with argparse."""
    ask = [PYTHON, ROOT / program, *words, "--help"]
    done = subprocess.run(ask, capture_output=True, text=True, env={"MPLCONFIGDIR": "/tmp", "PATH": "/usr/bin:/bin"})
    assert done.returncode == 0, done.stderr
    for word in words:
        assert not word.startswith("-") or re.search(rf"{re.escape(word)}\b", done.stdout), f"no option {word}"


def assert_deck_takes(words):
    """Words behind ./cfpm run or advise: DECK, then options of that and of the host."""
    deck, words = words[0], words[1:]
    if deck.startswith("inputs/"):
        assert (ROOT / deck).is_file(), deck
    while words:
        option, values = words[0], words[1:]
        if is_placeholder(option):
            words = values
            continue
        takes = {"-np": r"\d+", "-host": "liggghts|lammps", "-predict": "|".join(METHODS), "-suffix": "cfpm",
                 "-speed": r"[\d.e-]+", "-height": r"[\d.e-]+", "-in": r"\S+", "-log": r"\S+", "-var": r"\w+"}
        assert option in takes and values, f"option {option}"
        assert is_placeholder(values[0]) or re.fullmatch(takes[option], values[0]), f"{option} {values[0]}"
        if option == "-var" and deck.startswith("inputs/"):
            assert values[0] in variables(ROOT / deck), f"{deck} has no variable {values[0]}"
        words = values[2:] if option == "-var" else values[1:]


def assert_is_a_test(words):
    names = [f"{path.parent.name}/{path.stem.removeprefix('test_')}" for path in (ROOT / "tests").glob("*/test_*.*")]
    assert any(words[0] in name for name in names), words


def assert_can_be_given(program, words):
    if program != "./cfpm":  # a launcher
        words = [*words[words.index("-in") + 1:][:1], *words] if "-in" in words else ["DECK", *words]
        return assert_deck_takes(words)
    if not words or is_placeholder(words[0]):
        return None
    command, words = words[0], words[1:]
    assert command in COMMANDS, f"no command {command}"
    if not words:
        return None
    if command in ("run", "advise"):
        return assert_deck_takes(words)
    if command == "test":
        return is_placeholder(words[0]) or assert_is_a_test(words)
    if command == "validate" and not words[0].startswith("-"):
        return is_placeholder(words[0]) or assert_takes(f"validation/{words[0]}/validate.py", "--out", ".", *words[1:])
    if command == "validate":
        return assert_takes("validation/report.py", "--out", ".") or words == ["--quick"]
    assert command in PROGRAMS, f"{command} takes no {words}"
    return assert_takes(*PROGRAMS[command], *("1" if is_placeholder(word) else word for word in words))


@pytest.mark.parametrize("page", PAGES)
def test_commands(page):
    for program, *words in commands_of(page):
        assert_can_be_given(program, words)


def test_commands_are_found():
    assert ["./cfpm", "demo"] in list(commands_of("README.md"))
    assert ["./cfpm", "bench", "--rows", "verlet"] in list(commands_of("README.md"))
    assert ["./cfpm", "run", "DECK", "-suffix", "cfpm"] in list(commands_of("README.md"))


@pytest.mark.parametrize(
    "command",
    [
        "./cfpm settle",
        "./cfpm lint --all",
        "./cfpm validate spheres",
        "./cfpm validate packing --seed 3",
        "./cfpm validate packing --seeds many",
        "./cfpm bench --rank 1",
        "./cfpm run inputs/lammps/in.absent",
        "./cfpm run inputs/lammps/in.chute -var height 3",
        "./cfpm run DECK -predict euler -suffix cfpm",
        "build/bin/lmp-cfpm -in inputs/lammps/in.chute -predict euler",
    ],
)
def test_finds_what_cannot_be_given(command, tmp_path, monkeypatch):
    monkeypatch.setattr("pages.ROOT", tmp_path)
    (tmp_path / "page.md").write_text(f"Run `{command}`.\n")
    ((program, *words),) = commands_of("page.md")
    with pytest.raises(AssertionError):
        assert_can_be_given(program, words)
