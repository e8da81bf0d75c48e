# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks that others wrote, unmodified: all tutorials of LIGGGHTS and the granular examples of LAMMPS, as Debian's
packages liggghts-doc and lammps-examples have them, with -suffix cfpm beside the stock host.

At the deck's own step with "predict auto", and at three times that step with impulse, beside stock at three times its
step. Figures of the particles over some random starts decide whether a deck comes out as with stock; what does not run
must say why.
"""

import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import figures  # noqa: E402
import runs  # noqa: E402
from averages import mean_and_error, spread  # noqa: E402
from cases import NAMES, starts  # noqa: E402
from decks import FOLDERS, PARTS, all_decks  # noqa: E402
from exhibit import Exhibit, progress  # noqa: E402
from rewriting import FRICTION, has_seed  # noqa: E402
from runs import AUTO, IMPULSE3, IMPULSE3_OFF, STOCK, STOCK3, STOCK_OFF, Run  # noqa: E402

GLANCE = 0.001  # part of a run that shows whether it begins at all
QUICK = 0.01  # part of the runs in the tests
# the decks that are compared at three times the step in the tests, with the part that takes some seconds
QUICK_COMPARED = {"meshGran/in.meshGran": 0.39, "hysteresis/in.noHysteresis": 0.2}
# What the method does not cover, in the words of the messages: a deck that asks for it is refused rightly.
REASONS = {
    "unknown model 'hooke/hysteresis'": "a normal law with history of its own",
    "unknown surface 'multicontact'": "a model of contacts that act on each other",
    "'mdr' has a fix of the host that looks for the host's own": "a model with a fix of the host's own",
    "moves bodies of several particles": "bodies of several particles",
    "has no form for sub-models of granular": "pair_style granular",
    "has no predicted form; expected 'predict verlet', or hooke": "sub-models of granular",
    "changes the box, where contacts that begin inside a step": "a box that changes",
    "would integrate step-mean forces as forces of one instant": "an integrator of its own",
}
# What may come out otherwise, in the words of the warning that says so.
WARNED = {"this cohesion is not predicted": "cohesion beside hertz"}
SEEDS = {"full": 5, "quick": 2}
COMPARED = {AUTO: "auto, own step", IMPULSE3: "impulse, 3 x step", STOCK3: "stock, 3 x step"}


def add_arguments(parser):
    parser.add_argument("--seeds", type=int, help="random starts (default {full}, quick {quick})".format(**SEEDS))
    parser.add_argument("--decks", nargs="+", help="only those whose name contains one of these words")


def part_of(name, quick):
    full = PARTS.get(name, 1.0)
    return QUICK_COMPARED.get(name, min(full, QUICK)) if quick else full


class Judged:
    """A deck with all that was run of it."""

    def __init__(self, deck, part):
        self.deck, self.part = deck, part
        self.outcomes = {}  # {(mode, start): Outcome}

    def run(self, mode, start=0, part=None):
        return Run(self.deck, mode, part or self.part, start)

    def first(self, mode):
        return self.outcomes.get((mode, 0))

    def all_figures(self, mode):
        """Of all starts, in their order."""
        return [outcome.figures for (own, _), outcome in sorted(self.outcomes.items()) if own == mode]

    def same(self, mode):
        """Whether the first start is stock's to the last digit."""
        return self.first(mode).dump != "" and self.first(mode).dump == self.first(STOCK).dump

    def differences(self, mode, from_mode=STOCK):
        """Of each figure; none where a run stopped, or none was asked for."""
        both = self.all_figures(mode), self.all_figures(from_mode)
        return figures.compare(*both) if all(both) and all(both[0] + both[1]) else []

    def differing(self, mode, from_mode=STOCK):
        return [difference for difference in self.differences(mode, from_mode) if difference.differs]

    def has_dashpot(self):
        """Whether stock's friction is another one than the plugin's: LIGGGHTS adds the dashpot to Coulomb's limit."""
        return self.deck.host == "liggghts" and any(map(FRICTION.match, self.deck.commands))


def all_started(judged):
    """Those that begin with -suffix cfpm and as stock, and have something to predict."""
    return [j for j in judged if not j.first(AUTO).error and not j.first(AUTO).nothing]


def main():
    exhibit = Exhibit("Decks of others", __doc__, add_arguments)
    count = starts(exhibit, **SEEDS)
    if count > runs.STARTS:
        sys.exit(f"validate: --seeds is {count}; expected at most {runs.STARTS}")
    words = exhibit.arguments.decks or [""]
    judged = []
    for host, folder in FOLDERS.items():
        if not folder.is_dir():
            exhibit.text(f"{NAMES[host]}'s decks are not at {folder}: dpkg may be told to leave out documentation.")
            print(f"no folder {folder}: its decks are left out", flush=True)
            continue
        judged += [
            Judged(deck, part_of(deck.name, exhibit.quick))
            for deck in all_decks(host)
            if any(word in deck.name for word in words)
        ]

    def run(wanted, what):
        """wanted: (judged, mode, start) each."""
        jobs = [j.run(mode, start) for j, mode, start in wanted]
        found = runs.execute(jobs, exhibit.runs, lambda done, total: progress(done, total, what))
        for (j, mode, start), job in zip(wanted, jobs):
            j.outcomes[mode, start] = found[job]

    run([(j, AUTO, 0) for j in judged], "with -suffix cfpm")
    refused = [j for j in judged if j.first(AUTO).error]
    glances = runs.execute([j.run(STOCK, part=GLANCE) for j in refused], exhibit.runs, lambda *_: None)
    for j, outcome in zip(refused, glances.values()):
        j.outcomes[STOCK, 0] = outcome
    going = all_started(judged)
    run([(j, STOCK, 0) for j in going], "stock")
    larger = [j for j in going if not exhibit.quick or j.deck.name in QUICK_COMPARED]
    run([(j, IMPULSE3, 0) for j in larger], "impulse at three times the step")
    others = range(1, count)
    by_chance = [j for j in going if not j.same(AUTO)]
    compared = [j for j in larger if not j.first(IMPULSE3).error]
    more = [(j, AUTO, k) for j in by_chance for k in others]
    more += [(j, IMPULSE3, k) for j in compared for k in others]
    more += [(j, STOCK3, k) for j in compared for k in range(count)]
    more += [(j, STOCK, k) for j in going if j in by_chance or j in compared for k in others]
    run(more, "other starts")
    one_law = [j for j in compared if j.has_dashpot() and j.differing(IMPULSE3)]
    modes = STOCK_OFF, IMPULSE3_OFF
    run([(j, mode, k) for j in one_law for mode in modes for k in range(count)], "with one law of friction")
    report(exhibit, judged, count)
    return exhibit.finish()


def verdict(j, mode):
    """What the table says, and whether it is as it should be."""
    first = j.first(mode)
    if first is None:
        return "", True
    if first.error:
        if mode == AUTO and j.first(STOCK).error:
            return f"stock stops: {first.error}", True
        known = next((reason for words, reason in REASONS.items() if words in first.error), None)
        return (f"refused, {known}: {first.error}", True) if known else (f"STOPS: {first.error}", False)
    stopped = [outcome.error for (m, _), outcome in j.outcomes.items() if m in (mode, STOCK) and outcome.error]
    if stopped:
        return f"STOPS from another start: {stopped[0]}", False
    if first.nothing:
        return "nothing to predict: the host's own styles, as a warning says", True
    if mode == AUTO and j.same(mode):
        return "same to the last digit", True
    differing = j.differing(mode)
    if not differing:
        return "as stock", True
    found = ", ".join(map(str, differing))
    for words, reason in WARNED.items():
        if any(words in warning for warning in first.warnings):
            return f"differs, as a warning says, {reason}: {found}", True
    if mode == IMPULSE3:
        stock3 = {d.figure: abs(d.value) for d in j.differences(STOCK3)}
        if not has_seed(j.deck) and all(abs(d.value) <= stock3.get(d.figure, 0.0) for d in differing):
            return f"as stock at that step: {found}", True
        one_law = j.differences(IMPULSE3_OFF, STOCK_OFF)
        if one_law and not any(d.differs for d in one_law):
            return f"differs by the law of friction, as stock without its dashpot: {found}", True
    return f"differs: {found}", False


def report(exhibit, judged, count):
    exhibit.text(
        f"""Part: of every stage of the deck's run. nt: steps per contact time of the shortest contact of pairs, at the
        deck's own step, for Hertz at the deck's characteristic velocity or 1 m/s. A deck is as stock if no figure
        (particles, kinetic energy, largest speed, centre of mass, what its dump has of fixes) differs by more than
        Student's quantile times the standard error over {count} starts allows at a level of {100 * figures.LEVEL:g} %
        for all figures of the deck together, and by more than it changes in a step. Starts are seeds of the insertion
        or of the velocities; of a deck without any, steps that differ by 1 %, and what three times the step changes
        without chance is allowed as much as in stock. Stock's friction of LIGGGHTS has a dashpot beyond Coulomb's
        limit, the plugin's has not (docs: pair_style gran/cfpm): where a deck differs, both are run once more with
        tangential_damping off. In mesh_tet nothing moves, with stock neither, as its group is made before its
        particles."""
    )
    rows, lines, held = [], [], Counter()
    for j in judged:
        verdicts = {mode: verdict(j, mode) for mode in COMPARED}
        nt = j.first(AUTO).nt
        rows.append([NAMES[j.deck.host], j.deck.name, f"{j.part:g}", f"{nt:.3g}" if nt else "",
                     *(text for text, _ in verdicts.values())])
        for mode in COMPARED:
            for d in j.differences(mode) if verdicts[mode][0].startswith(("as stock", "differs")) else []:
                stock = mean_and_error([one[d.figure][0] for one in j.all_figures(STOCK)])
                numbers = [*stock, d.value, d.error, d.allowed]
                lines.append([j.deck.name, COMPARED[mode], d.figure, *(f"{number:.4g}" for number in numbers)])
        for mode in (AUTO, IMPULSE3):
            held[mode] += verdicts[mode][0].startswith(("same to the last digit", "as stock"))
            text, good = verdicts[mode]
            if not good:
                exhibit.verdict(f"{j.deck.name}, {COMPARED[mode]}: {text}", False)
    header = ["host", "deck", "part", "nt", *COMPARED.values()]
    exhibit.table(header, rows)
    exhibit.csv("decks", header, rows)
    exhibit.csv("figures", ["deck", "mode", "figure", "stock", "stock_error", "difference", "error", "allowed"], lines)
    energies = [line for line in lines if line[1:3] == [COMPARED[IMPULSE3], "kinetic energy"] and float(line[3])]
    if energies:
        found, allowed = (spread([100 * abs(float(line[k]) / float(line[3])) for line in energies]) for k in (5, 7))
        exhibit.text(
            f"""How much that tells: the kinetic energy with impulse at three times the step differs by {found} % from
            stock's, median and range over the decks, where chance allows {allowed} %."""
        )
    for mode in (AUTO, IMPULSE3):
        tried = sum(j.first(mode) is not None for j in judged)
        claim = f"{held[mode]} of {tried} decks come out as with stock, and why the others do not is known"
        exhibit.verdict(f"{COMPARED[mode]}: {claim}", all(verdict(j, mode)[1] for j in judged))


if __name__ == "__main__":
    sys.exit(main())
