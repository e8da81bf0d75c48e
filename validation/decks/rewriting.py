# SPDX-License-Identifier: GPL-2.0-or-later
"""The text of a deck for another step, another start, or a shorter run.

Nothing of the physics is touched. Of a deck's commands only these are rewritten: "timestep"; what is counted in steps
("run", "thermo", insert_every, fix adapt, fix check/timestep/gran, the step in a formula that does not make a time of
it); the seed of an insertion or of velocities; and "dump", in whose place one text file with the same particles is
written at a few times. Without the dashpot of friction the physics is another one, on request.
"""

import re

SNAPSHOTS = 24  # in a run
DUMP = "decks.dump"
COLUMNS = {True: "id mass radius x y z vx vy vz omegax omegay omegaz", False: "id mass x y z vx vy vz"}  # if granular
RUN = re.compile(r"run (\S+)( upto)?")
FRICTION = re.compile(r"(pair_style gran|fix \S+ \S+ wall/gran) model .*tangential history")
# a variable that is a number
LITERAL = re.compile(r"variable (\S+) equal ([\d.eE+-]+)$")
VARIABLE = re.compile(r"\$\{(\w+)\}")
# in these the group before the number is kept
SEEDS = [
    re.compile(r"(fix \S+ \S+ insert/.* seed )\d+"),
    re.compile(r"(fix \S+ \S+ pour \S+ \S+ )\d+"),
    re.compile(r"(velocity \S+ create \S+ )\d+"),
]
COUNTS = [
    re.compile(r"(thermo )(\d+)"),
    re.compile(r"(fix \S+ \S+ insert/.* insert_every )(\d+)"),
    re.compile(r"(fix \S+ \S+ adapt )(\d+)"),
    re.compile(r"(fix \S+ \S+ check/timestep/gran )(\d+)"),
]


def has_seed(deck):
    return any(pattern.match(line) for line in deck.commands for pattern in SEEDS)


def name_in(word):
    """Of the variable that a word like ${name} stands for; None if it is another word."""
    found = re.fullmatch(r"\$\{(\w+)\}", word)
    return found and found.group(1)


class Rewriting:
    """A deck with a step `ratio` times its own and the same times otherwise; of every stage of its run only a `part`;
    seed: in place of the deck's own, None to keep it. dashpot: False for LIGGGHTS's friction without one."""

    def __init__(self, deck, ratio=1.0, part=1.0, seed=None, dashpot=True):
        self._deck, self._ratio, self._part, self._seed, self._dashpot = deck, ratio, part, seed, dashpot
        self._literals = {m.group(1): float(m.group(2)) for m in map(LITERAL.match, deck.commands) if m}
        self._steps, counts = set(), set()
        for line in deck.commands:
            if line.startswith("timestep "):
                self._steps.add(name_in(line.split()[1]))
            elif RUN.match(line):
                counts.add(name_in(line.split()[1]))
            elif re.match(r"fix \S+ \S+ adapt ", line):
                counts.add(name_in(line.split()[4]))
        # a number of steps that is computed follows from the step, which is rewritten
        self._counts = counts & set(self._literals)

    def steps(self):
        """Of the whole run that is made, in the deck's own steps."""
        end = 0.0
        for run in filter(None, map(RUN.match, self._deck.commands)):
            stage = self._part * self._number(run.group(1))
            end = stage if run.group(2) else end + stage
        return end

    def interval(self):
        """Between snapshots, in the deck's own steps; times are the same with a step three times as large."""
        return 3 * max(1, int(self.steps() / SNAPSHOTS / 3))

    def text(self):
        lines = [line for command in self._deck.commands for line in self._rewritten(command)]
        dumps = [k for k, line in enumerate(lines) if line.startswith("dump ")]
        lines = [line for k, line in enumerate(lines) if k not in dumps[1:]]
        if not dumps:
            first = next((k for k, line in enumerate(lines) if line.startswith("run ")), len(lines))
            lines.insert(first, self._dump())
        return "\n".join(lines) + "\n"

    def _number(self, word):
        """Of steps, of which only literals are known: else a guess, that does for the times of snapshots."""
        return self._literals.get(name_in(word), 10000.0) if name_in(word) else float(word)

    def _scaled(self, count):
        """As many of the new steps as take the time of so many of the deck's."""
        return max(1, round(count / self._ratio)) if count else 0

    def _dump(self, properties=()):
        columns = [COLUMNS[self._deck.granular], *properties]
        return f"dump decks all custom {self._scaled(self.interval())} {DUMP} {' '.join(columns)}"

    def _rewritten(self, line):
        """The lines in its place."""
        words = line.split()
        name = words[1] if words[0] == "variable" else None
        if words[0] in ("dump", "dump_modify", "undump"):
            # the deck's own dump of particles also says which properties they have
            particles = words[0] == "dump" and words[3].startswith("custom")
            return [self._dump(word for word in words[6:] if word.startswith("f_"))] if particles else []
        if RUN.match(line):
            return self._run(line)
        if words[0] == "timestep" and not name_in(words[1]):
            return [f"timestep {self._ratio * float(words[1]):.12g}"]
        if name and name in self._steps:
            return [f"variable {name} equal {self._ratio:.12g}*({' '.join(words[3:])})"]
        if name and name in self._counts:
            return [f"variable {name} equal {self._scaled(self._literals[name])}"]
        if name and self._ratio != 1.0 and not self._steps & set(VARIABLE.findall(line)):
            return [re.sub(r"( equal .*)\bstep\b", rf"\1({self._ratio:.12g}*step)", line)]
        if not self._dashpot and FRICTION.match(line):
            return [f"{line} tangential_damping off"]
        for pattern in COUNTS:
            line = pattern.sub(lambda found: f"{found.group(1)}{self._scaled(int(found.group(2)))}", line)
        if self._seed:
            for pattern in SEEDS:
                line = pattern.sub(rf"\g<1>{self._seed}", line)
        return [line]

    def _run(self, line):
        run = RUN.match(line)
        rest = line[run.end(1):]
        if not name_in(run.group(1)):
            return [f"run {self._scaled(self._part * float(run.group(1)))}{rest}"]
        if name_in(run.group(1)) in self._counts:
            return [f"run {max(1, round(self._part * self._scaled(self._number(run.group(1)))))}{rest}"]
        return [f"variable decks_run equal ceil({self._part:g}*{run.group(1)})", f"run ${{decks_run}}{rest}"]
