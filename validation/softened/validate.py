# SPDX-License-Identifier: GPL-2.0-or-later
"""Stock with a softened material beside the plugin with the same freedom: what the same results cost.

Who wants results sooner divides the stiffness of the contacts, and takes a larger step with that. For each problem the
cheapest setting within tolerance of the unsoftened material is sought, of stock and of the plugin, and both are timed
against each other from other starts.

Finished runs are kept; the same command goes on after an interruption. All cases take some hours; --cases chooses.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / folder) for folder in ("", "packing", "discharge")]
import chute  # noqa: E402
import collapse  # noqa: E402
import column  # noqa: E402
import drum  # noqa: E402
import hole  # noqa: E402
import packing  # noqa: E402
import packings  # noqa: E402
import picture  # noqa: E402
from cases import number  # noqa: E402
from exhibit import Exhibit  # noqa: E402
from finding import SIDES, Finding, advice  # noqa: E402
from measuring import Runner  # noqa: E402
from search import search  # noqa: E402
from settings import SOFTEN, STOCK_NT  # noqa: E402
from tolerance import ratio_and_interval  # noqa: E402

MODULES = (packings, collapse, chute, hole, column, drum)
SELECTION, REPORTED = 86028121, 141650939  # first seeds of the starts to choose settings with, and to report them with


def look(case, folder):
    """The Finding of a case."""
    runner = Runner(case, folder)
    chosen_with = packing.primes(case.count, SELECTION)
    reported_with = packing.primes(case.others, REPORTED)

    def measure(setting, count):
        measured = runner.measure(setting, chosen_with[:count])
        verdict = "within" if measured.within else "outside" if measured.outside else "not known well enough"
        print(f"{case.name}: {setting}: {verdict}, {told(measured)}, {measured.cpu:.2g} s, {count} starts", flush=True)
        return measured

    def find(settings):
        return search(settings, lambda setting: setting.cost(case.exponent), measure, case.count)

    found = {"stock": find(case.stock), "cfpm": find(case.plugin)}
    chosen = [found[side].chosen for side in SIDES]
    if None in chosen:
        return Finding(case, found, {}, None)
    stock, cfpm = runner.pair(chosen, reported_with)
    return Finding(case, found, dict(zip(SIDES, (stock, cfpm))), ratio_and_interval(stock.seconds, cfpm.seconds))


def explain(exhibit):
    if exhibit.quick:
        exhibit.text("Quick: small problems and no tolerances, to see that all of it runs; what it costs says nothing.")
    exhibit.text(
        f"""Stock is at its best here: its stiffness is divided by {", ".join(f"{s:g}" for s in SOFTEN)} at the same
        restitution, with {", ".join(f"{nt:g}" for nt in STOCK_NT)} steps per contact time of what results. The plugin
        has the same freedom and all of its methods; "verlet" is stock's own method at the price of the plugin's step.
        The reference is the unsoftened material with small steps of stock. **The rule**, one for both: with the mean
        difference to the reference d and its standard error s over the starts, a setting is within the tolerance T if
        |d| + t s < T, with Student's t at 95 %; one that is off by T or more passes in less than 5 % of all cases,
        whatever the scatter. What cannot be told apart from outside counts as outside, and so does a setting of which a
        run blew up or, where spheres should lie, has not come to rest. Settings are chosen from one set of starts;
        differences and CPU times in these tables are from another, larger one, so that what was chosen near the
        edge of its tolerance can be told from what is beyond it. There both run one after the other, alone, start by
        start; the ratio is the geometric mean of those of the starts, with its 95 % interval. CPU time: user time of
        the whole process, setting up included."""
    )


def told(measured):
    """Differences to the reference, or why there are none, as text."""
    differences = ", ".join(f"{number(d.mean, '+.2f', d.error)} %" for d in measured.differences.values())
    return differences or " and ".join(sorted(set(measured.failed)))


def summarise(exhibit, findings):
    rows, shown = [], []
    for finding in findings:
        case = finding.case
        name = [case.title, ", ".join(f"{figure} {tolerance:g} %" for figure, tolerance in case.figures.items())]
        cells = []
        for side in SIDES:
            setting = finding.found[side].chosen
            measured = finding.reported.get(side)
            cells += [str(setting) if setting else "none", told(measured) if measured else "-"]
        ratio = "{:.2f} ({:.2f} - {:.2f})".format(*finding.ratio) if finding.ratio else "-"
        shown.append([*name, *cells, ratio, advice(finding)])
        for side, measured in finding.reported.items():
            for figure, d in measured.differences.items():
                row = [case.name, side, *measured.setting, measured.starts, measured.cpu, figure, case.figures[figure]]
                row += [d.mean, d.error, d.within(case.figures[figure]), *finding.ratio]
                rows.append(row)
    columns = ["problem", "tolerance", "stock", "off by", "cfpm", "off by", "stock over cfpm, CPU", "so"]
    exhibit.table(columns, shown)
    names = """case side method soften nt starts user_seconds figure tolerance_percent difference_percent
        difference_error within ratio ratio_low ratio_high"""
    exhibit.csv("ratios", names.split(), [[short(x) for x in row] for row in rows])


def short(x):
    return f"{x:.5g}" if isinstance(x, float) else x


def tell(exhibit, finding):
    """The section of a case."""
    case = finding.case
    starts = f"{case.count} starts and {case.others} others"
    exhibit.text(f"**{case.title}.** {case.text} Reference: {case.reference}; {starts}.")
    rows = []
    for side in SIDES:
        for m in finding.found[side].measured.values():
            differences = [x for d in m.differences.values() for x in (d.mean, d.error)]
            rows.append([side, *m.setting, m.starts, len(m.failed), " and ".join(sorted(set(m.failed))), m.cpu])
            rows[-1] += [m.within, *(differences or [""] * 2 * len(case.figures))]
    figures = [f"{kind}_{figure}".replace(" ", "_") for figure in case.figures for kind in ("percent", "error")]
    names = "side method soften nt starts failed why user_seconds within".split()
    exhibit.csv(case.name, names + figures, [[short(x) for x in row] for row in rows])
    sides = {side: found.measured for side, found in finding.found.items()}
    tried = {side: len(own) for side, own in sides.items()}
    failed = {side: sum(bool(m.failed) for m in own.values()) for side, own in sides.items()}
    exhibit.plot(
        picture.draw(case, sides, [found.chosen for found in finding.found.values()]),
        case.name,
        f"{case.title}: error of the figure that is off most, over its tolerance, with its standard error, against the "
        f"CPU time of a run; {' and '.join(f'{tried[side]} settings of {side}' for side in SIDES)}, of which "
        f"{' and '.join(str(failed[side]) for side in SIDES)} failed and are left out. Lines: fronts, by the error and "
        "one standard error of it. Bold: chosen. Most settings were run from 3 starts, those near the chosen from all.",
    )


def where_not(exhibit, findings):
    """For whom the plugin is not."""
    groups = {"switch": [], "do not": [], "open": []}
    for finding in findings:
        said = advice(finding)
        key = "switch" if said.startswith("switch") else "do not" if "do not" in said else "open"
        groups[key].append(finding.case.title)
    told = {key: "; ".join(titles) or "none" for key, titles in groups.items()}
    exhibit.text(
        f"""**Where not to switch.** Softened stock is as cheap or cheaper, and a user need not switch:
        {told["do not"]}. The plugin is cheaper: {told["switch"]}. Not settled: {told["open"]}. Who needs the
        overlaps themselves, for contact areas, heat, cohesion or wear, should neither soften nor take impulses at few
        steps: both enlarge them (deep column, overlaps)."""
    )


def judge(exhibit, findings):
    for finding in findings:
        title, found = finding.case.title, finding.found
        if exhibit.quick:
            ended = [m for side in SIDES for m in found[side].measured.values() if not m.failed]
            count = sum(len(found[side].measured) for side in SIDES)
            exhibit.verdict(f"{title}: {len(ended)} of {count} settings ended well, expected all", len(ended) == count)
        else:
            exhibit.verdict(
                f"{title}: both have a setting within tolerance, from the starts it was chosen with and from others",
                finding.confirmed,
            )


def add_arguments(parser):
    parser.add_argument("--cases", nargs="+", metavar="CASE", help="some of them; default all")


def chosen_cases(exhibit):
    cases = {case.name: case for module in MODULES for make in module.CASES for case in [make(exhibit.quick)]}
    names = exhibit.arguments.cases or list(cases)
    if unknown := [name for name in names if name not in cases]:
        sys.exit(f"validate softened: --cases {unknown[0]}: expected some of {', '.join(cases)}")
    return [cases[name] for name in names]


def main():
    exhibit = Exhibit("Stock with a softened material", __doc__, add_arguments)
    findings = [look(case, exhibit.runs) for case in chosen_cases(exhibit)]
    explain(exhibit)
    summarise(exhibit, findings)
    where_not(exhibit, findings)
    for finding in findings:
        tell(exhibit, finding)
    judge(exhibit, findings)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
