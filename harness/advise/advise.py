# SPDX-License-Identifier: GPL-2.0-or-later
"""./cfpm advise DECK: how soft its grains are, and which method and time step they support."""

import argparse
import sys
from math import floor, hypot, log10
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from harness.advise import softness  # noqa: E402
from harness.advise.choices import USES, candidates, choices, stock_step  # noqa: E402
from harness.advise.setups import Unknown, refusal, setups_of  # noqa: E402


def positive(word):
    value = float(word)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"found '{word}', expected a positive number")
    return value


def table(header, rows):
    rows = [header, *rows]
    widths = [max(len(row[k]) for row in rows) for k in range(len(header))]
    return "\n".join("  " + "  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows)


def span(low, high, pattern="{:.3g}"):
    texts = [pattern.format(value) for value in (low, high)]
    return texts[0] if texts[0] == texts[1] else f"{texts[0]} to {texts[1]}"


def percent(value):
    return "?" if value is None else f"{100 * value:.2g} %"


def times_as_fast(pair):
    """Two digits, also above a hundred."""
    return span(*(float(f"{value:.2g}") for value in pair), "{:g}")


def rounded_down(value):
    """To three digits."""
    unit = 10.0 ** (floor(log10(value)) - 2)
    return floor(value / unit * (1 + 1e-9)) * unit


def in_words(resting, hitting):
    """How soft, against the usual limit."""
    known = [value for value in (resting, hitting) if value is not None]
    if not known:
        return "?"
    if max(known) <= softness.USUAL_LIMIT:
        return "usual"
    return "soft" if max(known) <= 5 * softness.USUAL_LIMIT else "very soft"


class Setup:
    """The facts of one setup with what follows from them; lengths, times and masses in the deck's units."""

    def __init__(self, facts, speed, height):
        self.facts, self.contacts, self.dt = facts, facts["contacts"], facts["dt"]
        self.gravity = None if facts["gravity"] is None else hypot(*facts["gravity"])
        self.height, self.height_given = height, height is not None
        if height is None and self.gravity:
            self.height = sum(abs(g) * edge for g, edge in zip(facts["gravity"], facts["box"])) / self.gravity
        self.speed_given = speed is not None
        self.impact = speed
        if speed is None and self.gravity is not None:
            drop = 2 * self.gravity * self.height if self.gravity else 0.0
            self.impact = (facts["largest_speed"] ** 2 + drop) ** 0.5 or None
        # contacts of Hertz's law are timed at the faster of the impacts that are known, as they are the shorter
        self.timed_at = self.impact if self.speed_given else max(self.impact or 0.0, facts["impact_speed"])

    @property
    def hertz(self):
        return any(c["hertz"] for contact in self.contacts for c in contact["collisions"])

    def times(self, contact):
        found = [softness.contact_time(c, self.facts["impact_speed"], self.timed_at) for c in contact["collisions"]]
        return min(found), max(found)

    def shortest(self, contact):
        return self.times(contact)[0]

    def resting(self, contact):
        """Largest overlap at rest over radius; None if gravity or height are not known."""
        if not self.gravity:
            return None
        of = [softness.static_overlap(c, self.facts["impact_speed"], self.gravity, self.height)
              / softness.least_radius(c) for c in contact["collisions"]]
        return max(of)

    def hitting(self, contact):
        """Largest overlap in an impact over radius; None if no speed is known."""
        if self.impact is None:
            return None
        return max(softness.impact_overlap(c, self.facts["impact_speed"], self.impact) / softness.least_radius(c)
                   for c in contact["collisions"])


def taken_for_granted(setup, setups):
    """Lines that say what the numbers rest on, and what is not known."""
    facts = setup.facts
    lines = [f"units {facts['units']}, dt = {setup.dt:.4g}, particles at the start: {facts['particles']:.0f}"
             + ("; sizes are those that the deck's templates will insert" if not facts["particles"] else "")]
    if len(setups) > 1:
        steps = sorted({s["dt"] for s in setups})
        lines.append(f"of {len(setups)} setups of the deck this is the last"
                     + (f"; dt is {span(steps[0], steps[-1], '{:.4g}')} in them" if len(steps) > 1 else ""))
    given = "as given" if setup.height_given else "the domain's height, a bound"
    if setup.gravity is None:
        lines.append("gravity is not known: no particle feels it yet")
    elif not setup.gravity:
        lines.append("no gravity: no overlap under weight")
    else:
        lines.append(f"gravity {setup.gravity:.4g}, height {setup.height:.4g} ({given}): overlap at rest is that under "
                     "a column of that height, of single spheres")
    if setup.impact is None:
        lines.append("impact speed not known: nothing moves at the start, and nothing falls; give it with -speed V")
    elif setup.speed_given:
        lines.append(f"impact speed {setup.impact:.4g}, as given")
    else:
        lines.append(f"impact speed {setup.impact:.4g}, a bound from the largest speed at the start"
                     + (" and a fall over that height" if setup.gravity else "")
                     + "; speeds of later insertions and of moving walls are not known: -speed V gives another")
    if setup.hertz:
        lines.append(f"Hertz: tc and nt are those of an impact at speed {setup.timed_at:.4g}")
    return lines


def kinds_of_contact(setup):
    rows = []
    for contact in setup.contacts:
        if not contact["collisions"]:
            rows.append([contact["who"].rstrip(":"), *6 * ["?"]])
            continue
        times = setup.times(contact)
        radii = [r for c in contact["collisions"] for r in c["radii"] if r]
        resting, hitting = setup.resting(contact), setup.hitting(contact)
        rows.append([contact["who"].rstrip(":"), span(min(radii), max(radii)), span(*times, "{:.4g}"),
                     span(times[0] / setup.dt, times[1] / setup.dt, "{:.4g}"), percent(resting), percent(hitting),
                     in_words(resting, hitting)])
    return table(["contact", "radius", "tc", "nt = tc/dt", "at rest", "in impact", "material"], rows)


def advice(setup, refused):
    """Text on each use, and the choices to paste by use."""
    contacts = setup.contacts
    resting = [setup.resting(contact) for contact in contacts]
    resting = None if None in resting else max(resting)
    rows, chosen = [], {}
    for use, name in USES.items():
        found = choices(setup.facts["host"], contacts, use, setup.shortest, resting, refused)
        least = stock_step(contacts, use, setup.shortest)
        for k, choice in enumerate(found):
            if not k:
                chosen[use] = choice
            rows.append([
                "" if k else name, ("* " if not k else "  ") + choice.method, f"{choice.nt:.3g}",
                f"{rounded_down(choice.dt):.3g}", f"{choice.dt / setup.dt:.3g}",
                span(choice.cost.least, choice.cost.largest, "{:.2f}"), times_as_fast(choice.faster_than(setup.dt)),
                times_as_fast(choice.faster_than(least)) if least else "?",
                f"{choice.softer:.3g}" if choice.softer != 1 else "",
            ])
        if not found:
            rows.append([name, "  not measured", *7 * [""]])
    header = ["use", "  predict", "nt", "dt", "dt/deck's", "cost", "faster", "than stock's", "softer"]
    return table(header, rows), chosen


EXPLAINED = """\
nt, dt: the fewest steps per contact at which results were measured to be right. cost: of a step over stock's, on a
settled bed; where sizes differ up to that of a bed in which no two are alike. faster: whole runs than stock at the
deck's dt; than stock's: than stock at its own largest dt; the less of the two with the largest cost of whole decks, and
with what larger steps cost more as they find more collisions and build more lists. softer: overlaps at rest over the
law's; where impulse would rest above 1 % of a radius for that it gets more steps, or is left out for beds.
*: the least work. Only methods with both numbers are listed."""


UNTIMED = """\
  not known: of contacts without a tc above there is no closed form of the collision, or no coefficient that has a
  predicted form"""


def lines_to_paste(setup, chosen, deck):
    """Choices that are the same share lines."""
    texts = []
    for choice in dict.fromkeys(chosen.values()):
        uses = ", ".join(USES[use] for use in chosen if chosen[use] == choice)
        dt = rounded_down(choice.dt)
        run = (f"./cfpm run {deck} -predict {choice.method} -suffix cfpm\n"
               f"  or in a deck whose pair_style says predict: predict {choice.method}")
        texts.append(f"for {uses}:\n  timestep {dt:.3g}\n  {run}\n"
                     f"  what is counted in steps (run, dump, thermo ...) becomes {setup.dt / dt:.3g} times as many")
    return "\n".join(texts)


def report(deck, arguments):
    path = Path(deck).resolve()
    setups = setups_of(path, arguments.host, arguments.np, arguments.options)
    setup = Setup(setups.with_contacts[-1], arguments.speed, arguments.height)
    timed = all(contact["collisions"] for contact in setup.contacts)
    tried = {method: refusal(path, arguments.host, method, arguments.np, arguments.options)
             for method in candidates(setup.facts["host"], setup.contacts)}
    refused = {method: why for method, why in tried.items() if why}
    choices_table, chosen = advice(setup, refused) if timed else (UNTIMED, {})
    parts = [
        f"{deck}, on {arguments.host}", *("  " + line for line in taken_for_granted(setup, setups.with_contacts)),
        *([f"  {setups.remark}"] if setups.remark else []), "",
        "Contacts; overlaps over the radius of the smaller body", kinds_of_contact(setup),
        "usual: up to 1 % of the radius, what soft spheres are commonly allowed (Cleary 2004); soft: up to 5 %", "",
        "Methods" + (", as measured with linear contacts" if setup.hertz else ""), choices_table,
        *([EXPLAINED] if timed else []), *(f"{method} is refused: {why}" for method, why in refused.items()), "",
    ]
    if chosen:
        parts += ["Lines to paste", lines_to_paste(setup, chosen, deck)]
    if setups.warnings:
        parts += ["", "The plugin says at the deck's own step", *(f"  {warning}" for warning in setups.warnings)]
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(prog="./cfpm advise", description=__doc__, allow_abbrev=False)
    parser.add_argument("deck")
    parser.add_argument("-host", required=True, choices=("liggghts", "lammps"))
    parser.add_argument("-np", type=int, default=1)
    parser.add_argument("-speed", type=positive, help="of impacts, in the deck's units")
    parser.add_argument("-height", type=positive, help="of a column at rest and of a fall, in the deck's units")
    arguments, arguments.options = parser.parse_known_args()
    try:
        print(report(arguments.deck, arguments))
    except Unknown as why:
        sys.exit(f"cfpm: advise: {arguments.deck}: {why}")


if __name__ == "__main__":
    main()
