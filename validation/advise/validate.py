# SPDX-License-Identifier: GPL-2.0-or-later
"""What ./cfpm advise promises, beside what comes of it: stock decks are run as they are and with each set of lines that
advise prints for them.

A hopper of LIGGGHTS as somebody may have written it, grains of three sizes in a mesh, and a collapse of LAMMPS. Whole
runs, one at a time and in turn, from several random starts; times are user times of the processor.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
from averages import difference, mean_and_error, spread  # noqa: E402
from cases import number  # noqa: E402
from exhibit import Exhibit  # noqa: E402
from judging import judge  # noqa: E402
from measuring import AS_IS, LARGEST, measure  # noqa: E402
from problems import PROBLEMS, USE  # noqa: E402
from promises import WITHIN, ask, read  # noqa: E402

STARTS, QUICK_STARTS = 4, 1


def summarise(exhibit, problem, advice, found):
    """A table of gains and one of figures. Returns rows for the CSV file, one for each way and figure."""
    base, largest = (next(own for way, own in found.items() if way.name == name) for name in (AS_IS, LARGEST))
    gains, figures, rows = [], [], []
    for way, own in found.items():
        promise = advice.promise(way.lines) if way.lines else None
        than_stock = promise.than_stock if way.is_for(USE) else None
        ratios = own.faster_than(base), own.faster_than(largest)
        predict = dict(zip(way.words, way.words[1:])).get("-predict", "")
        gains.append([
            way.name, predict, f"{way.dt:.3g}", f"{np.median(own.seconds):.3g}", spread(ratios[0], ".3g"),
            promise.faster if promise else "", spread(ratios[1], ".3g"), than_stock or "",
        ])
        promised = [x for gain in (promise and promise.faster, than_stock) for x in gain or ("", "")]
        measured = [f"{x:.4g}" for of in ratios for x in np.quantile(of, (0.5, 0, 1))]
        for name in base.figures[0]:
            mean, error = mean_and_error(own.values(name))
            off, off_error = difference(own.values(name), base.values(name))
            shown = f"{own.blown_up} blew up" if own.blown_up else number(mean, ".2f", error)
            figures.append([way.name, name, shown, "" if own is base else number(off, "+.2f", off_error)])
            numbers = [f"{x:.5g}" for x in (mean, error, off, off_error)]
            rows.append([problem.name, way.name, predict, f"{way.dt:.4g}", len(own.seconds), own.blown_up,
                         f"{np.median(own.seconds):.4g}", *measured, *promised, name, *numbers])
    columns = ["run", "predict", "dt [s]", "user time [s]", "times as fast as the deck is", "advise says",
               "as stock at its largest step", "advise says"]
    exhibit.table(columns, gains)
    exhibit.table(["run", "figure", "value", "off by [%]"], figures)
    return rows


def add_arguments(parser):
    parser.add_argument("--starts", type=int, choices=range(1, 9),
                        help=f"random starts of each deck (default {STARTS}, quick {QUICK_STARTS})")
    parser.add_argument("--decks", nargs="+", choices=[problem.name for problem in PROBLEMS], help="only these")


def main():
    exhibit = Exhibit("What advise promises", __doc__, add_arguments)
    starts = exhibit.arguments.starts or (QUICK_STARTS if exhibit.quick else STARTS)
    exhibit.text(
        f"""Stock decks as they are and with each set of lines that `./cfpm advise` prints for them: user time of whole
        runs, one at a time and in turn, median and range of {starts} random starts, ratios start by start. A gain is as
        promised within {100 * WITHIN:.0f} % of the nearer end of its range. Both decks are of {USE}: so the lines for
        these are held to what stock gives at the deck's own step, within the scatter over starts where there are
        several, and to what they are to gain over stock at the largest step that is right for it. Others are timed
        alone; their figures are for the reader."""
    )
    chosen = exhibit.arguments.decks or [problem.name for problem in PROBLEMS]
    rows = []
    for problem in PROBLEMS:
        if problem.name not in chosen or exhibit.quick and problem.quick is None:
            continue
        advice = read(ask(problem.host, problem.deck, problem.variables(exhibit.quick)))
        found = measure(problem, advice, exhibit.quick, starts, exhibit.runs)
        exhibit.text(f"### {problem.title}")
        exhibit.text(f"`inputs/{problem.host}/in.{problem.name}`. {problem.text}")
        rows += summarise(exhibit, problem, advice, found)
        judge(exhibit, problem, advice, found)
    header = "deck run predict dt starts blown_up user_s faster faster_min faster_max than_stock than_stock_min " \
        "than_stock_max promised_min promised_max promised_than_stock_min promised_than_stock_max figure mean error " \
        "off_percent off_error"
    exhibit.csv("advise", header.split(), rows)
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
