# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/advise: what it reads of the text of advise, what it takes of a host's output, and what it lets pass."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from harness.host import ROOT
from harness.output import thermo

VALIDATION = Path(__file__).resolve().parents[2] / "validation"
sys.path[:0] = [str(VALIDATION / "advise"), str(VALIDATION)]
import ensemble  # noqa: E402
import judging  # noqa: E402
import measuring  # noqa: E402
import problems  # noqa: E402
import promises  # noqa: E402

# tests/loader/test_advise.py: what the page shows is what advise prints now
ADVICE = promises.read((ROOT / "docs" / "advise.md").read_text())
WHEAT, COLLAPSE = problems.PROBLEMS
TABLES = """
    Step    Atoms         KinEng
       0      100            2.5
WARNING: a particle is fast
      50      100              1
Loop time of 1 on 1 procs for 50 steps with 100 atoms
7 8 9
    Step    Atoms         KinEng
      50      100              1
     150       60            0.5
Loop time of 1 on 1 procs for 100 steps with 60 atoms
"""


def test_what_advise_says_is_read():
    assert ADVICE.dt == 0.0005991 and len(ADVICE.rows) == 9
    assert [lines.uses for lines in ADVICE.lines] == [("dense beds at rest",), ("flows",), ("agitated grains",)]
    flows = ADVICE.lines[1]
    assert flows.dt == 0.00179 and flows.words == ("-predict", "impulse", "-suffix", "cfpm")
    row = ADVICE.promise(flows)
    assert (row.method, row.nt, row.faster, row.than_stock) == ("impulse", 2, (1.9, 3.6), (1.9, 3.6))
    assert ADVICE.stock_step("flows") == 0.000599
    assert ADVICE.rows[7] == promises.Row("agitated grains", "impulse", False, 4.82, 0.000745, (0.92, 1.5), (0.92, 1.5))


def test_lines_and_rows_belong_together():
    """Of the decks that are run: steps are those of the table. What the lines gain at most over stock at its own
    largest step is less than over the deck by the ratio of these steps; gains have two digits, each off by 5 % at most.
    """
    for problem in problems.PROBLEMS:
        advice = promises.read(promises.ask(problem.host, problem.deck, problem.given))
        assert {use for lines in advice.lines for use in lines.uses} == {row.use for row in advice.rows}
        for lines in advice.lines:
            row = advice.promise(lines)
            assert lines.dt == row.dt and row.method in lines.words
            if problems.USE in lines.uses:
                larger = advice.stock_step(problems.USE) / advice.dt
                assert larger > 1 and row.faster.most / row.than_stock.most == pytest.approx(larger, rel=0.1)


@pytest.mark.parametrize("measured, kept", [(3.49, False), (3.51, True), (12.9, True), (13.1, False)])
def test_within_thirty_percent_of_its_ends(measured, kept):
    assert promises.Gain(5.0, 10.0).keeps(measured) is kept


def test_a_single_number():
    assert promises.gain("6", "") == (6, 6) and promises.gain("", "") is None


def test_tables_of_a_host():
    table = thermo(TABLES)
    assert list(table) == ["Step", "Atoms", "KinEng"]
    assert table["Step"].tolist() == [0, 50, 50, 150] and table["Atoms"].tolist() == [100, 100, 100, 60]


def test_outflow():
    """40 grains in the second half of 100 steps, at a constant rate from step 50 on: 0.4 a step."""
    table = thermo(TABLES)
    values = {"dt": "1e-3", "fill": "0.05", "duration": "0.1"}
    assert problems.outflow(table, values) == {"outflow [1/s]": pytest.approx(400)}


def test_steps_of_the_decks():
    assert WHEAT.at(5.79) == {"dt": "5.79e-05"} and COLLAPSE.at(10) == {"nt": "2"}


def judged(promise=1.0, outflow=100.0, blown_up=False):
    """Which verdicts hold where lines for flows came out 2.5 times as fast, as promised times a factor."""
    rows = [row._replace(faster=promises.Gain(*(promise * x for x in row.faster))) for row in ADVICE.rows]
    advice = promises.Advice(ADVICE.dt, rows, ADVICE.lines[1:2])
    scatter = np.array([-1.0, 0.0, 1.0])
    stock = measuring.Measured(np.full(3, 10.0), [{"outflow": 100 + x} for x in scatter])
    figures = [{"outflow": outflow + x} for x in scatter]
    own = measuring.Measured(np.full(3, 4.0), [{}, *figures[1:]] if blown_up else figures)
    found, verdicts = dict(zip(measuring.ways_of(advice), (stock, stock, own))), []
    judging.judge(SimpleNamespace(verdict=lambda _, holds: verdicts.append(holds)), WHEAT, advice, found)
    return verdicts


def test_what_passes():
    """Over the deck, over stock at its largest step, the flow. Three starts of each scatter by 1: chance makes 4.60
    sqrt(2/3) = 3.8 of it."""
    assert judged() == [True, True, True]
    assert judged(promise=2.0) == judged(promise=0.5) == [False, True, True]
    assert judged(outflow=103.7) == [True, True, True] and judged(outflow=103.8) == [True, True, False]
    assert judged(blown_up=True) == [False, False, False]


def test_words_make_a_deck_predicted():
    stock = ensemble.Run("lammps", COLLAPSE.deck, {"nt": 2})
    words = ensemble.Run("lammps", COLLAPSE.deck, {"nt": 2}, words=("-suffix", "cfpm"))
    assert not stock.predicted and words.predicted and stock.name() != words.name()
    assert "words" not in stock.identity()  # what was run before there were any is found again
