# SPDX-License-Identifier: GPL-2.0-or-later
"""Copies sources with mutations in them, each of which a switch turns on while the program runs.

A mutation is a small deliberate fault. A test suite that notices none of them has not looked there. So that many are
tried with one build, the copy holds every one beside the original:

    expression   (cfpm::mutated(7) ? (mutated) : (original))
    statement    { if (cfpm::mutated(7)) { mutated } else { original } }

The environment variable CFPM_MUTATION names the one that is on; without it the copy does what the original does.
From the command line: mutate.py core FROM TO copies the folder src in FROM to TO, with the table of core.py.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

SWITCH = "src/core/mutation_switch.h"  # generated, in the copy only
HEADER = """\
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace cfpm {

/// 1 for the first mutation of the table, 0 for none.
inline int active_mutation() {
  static const int active = [] {
    const char *const name = std::getenv("CFPM_MUTATION");
    if (!name || !*name) return 0;
    int k = 0;
    for (const char *const known : {%s}) {
      ++k;
      if (std::strcmp(name, known) == 0) return k;
    }
    std::fprintf(stderr, "CFPM_MUTATION is '%%s', which is no mutation of this build\\n", name);
    std::abort();
  }();
  return active;
}

/// What the compiler evaluates is never mutated: the variable is not known there.
constexpr bool mutated(int k) { return !__builtin_is_constant_evaluated() && active_mutation() == k; }

} // namespace cfpm
"""


@dataclass(frozen=True)
class Mutation:
    """One row of a table. To point it to sources that have changed, change file, original and mutated."""

    name: str  # as CFPM_MUTATION gives it
    file: str  # from the root of the project
    original: str  # occurs once in the file: a whole expression, or statements if it ends with ";"
    mutated: str  # what stands in for it; of an expression the same type
    breaks: str  # in words
    noticed_by: str  # a test that is about that, and must fail
    message: str = ""  # what it must say then


class Misfit(Exception):
    """A row does not fit the sources."""


def place(text, row):
    """Where the original of a row begins and ends. Any white space in it stands for any: sources are formatted."""
    if any(row.original.count(a) != row.original.count(b) for a, b in ("()", "[]", "{}")):
        raise Misfit(f"mutation {row.name}: expected a whole expression or whole statements, found '{row.original}'")
    pattern = r"\s+".join(re.escape(word) for word in row.original.split())
    found = list(re.finditer(pattern, text))
    if len(found) != 1:
        raise Misfit(f"mutation {row.name}: expected its original once in {row.file}, found it {len(found)} times")
    return found[0].span()


def mutate(text, rows, number):
    """The text of one file with the rows in it; number: of a row in its table. Originals may be the same, or one a part
    of the other."""
    places = sorted(((*place(text, row), row) for row in rows), key=lambda p: (p[0], -p[1]))

    def render(begin, end, inside):
        """The text from begin to end with the mutations inside it, in their order."""
        parts = []
        while inside:
            start, stop, row = inside[0]
            if stop > end:
                raise Misfit(f"mutation {row.name}: its original overlaps with another one's in {row.file}")
            within = [p for p in inside[1:] if p[0] < stop]
            on = f"cfpm::mutated({number[row.name]})"
            original = render(start, stop, within)
            if row.original.endswith(";"):
                both = f"{{ if ({on}) {{ {row.mutated} }} else {{ {original} }} }}"
            else:
                both = f"({on} ? ({row.mutated}) : ({original}))"
            parts += [text[begin:start], both]
            begin = stop
            inside = inside[1 + len(within) :]
        return "".join([*parts, text[begin:end]])

    mutated = render(0, len(text), places)
    # the switch goes before everything else: behind "#pragma once" of a header
    once = "#pragma once\n"
    at = mutated.index(once) + len(once) if once in mutated else 0
    return mutated[:at] + f'#include "{Path(SWITCH).relative_to("src")}"\n' + mutated[at:]


def copy(table, source, target, folder="src"):
    """Writes the folder of source with all mutations of the table under target. What has not changed is not touched:
    no build is repeated for nothing."""
    number = {row.name: k for k, row in enumerate(table, 1)}
    if len(number) < len(table):
        raise Misfit("a name stands twice in the table of mutations")
    files = {path.relative_to(source): path for path in (source / folder).rglob("*") if path.is_file()}
    for row in table:
        if Path(row.file) not in files:
            raise Misfit(f"mutation {row.name}: expected the file {row.file}, found none")
    written = {Path(SWITCH): HEADER % ",\n".join(f'"{row.name}"' for row in table)}
    for name, path in files.items():
        rows = [row for row in table if Path(row.file) == name]
        written[name] = mutate(path.read_text(), rows, number) if rows else path.read_text()
    for old in [path for path in (target / folder).rglob("*") if path.is_file()]:
        if old.relative_to(target) not in written:
            old.unlink()
    for name, text in written.items():
        path = target / name
        if not path.is_file() or path.read_text() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            if name in files:
                path.chmod(files[name].stat().st_mode)


if __name__ == "__main__":
    import core

    try:
        copy(core.CORE, Path(sys.argv[2]), Path(sys.argv[3]), folder="src/core")
    except Misfit as misfit:
        sys.exit(str(misfit))
