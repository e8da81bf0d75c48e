# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/softened: the rule of what is within tolerance, the search for the cheapest setting, runs that are timed
against each other."""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

VALIDATION = Path(__file__).resolve().parents[2] / "validation"
sys.path[:0] = [str(VALIDATION / folder) for folder in ("", "packing", "softened")]
import case  # noqa: E402
import column  # noqa: E402
import ensemble  # noqa: E402
import finding  # noqa: E402
import measuring  # noqa: E402
import packing  # noqa: E402
import search  # noqa: E402
import settings  # noqa: E402
from tolerance import Difference, difference, ratio_and_interval  # noqa: E402


@pytest.mark.parametrize("scatter", [0.1, 1.0, 5.0])
@pytest.mark.parametrize("starts", [2, 4, 16])
def test_what_is_off_by_the_tolerance_passes_in_at_most_a_twentieth(starts, scatter):
    """20,000 ensembles at the edge: that share scatters by sqrt(.05 .95/20000) = .0015; four of these are allowed."""
    random = np.random.default_rng(20050101)
    samples = random.normal(1.0, scatter, (20000, starts))
    errors = samples.std(axis=1, ddof=1) / np.sqrt(starts)
    passed = np.mean([Difference(m, e, starts).within(1.0) for m, e in zip(samples.mean(axis=1), errors)])
    assert passed < 0.05 + 4 * 0.0015
    if scatter == 0.1 and starts == 16:  # where the far edge is out of reach the share is exactly that
        assert passed > 0.05 - 4 * 0.0015


def test_within_outside_and_neither():
    """Four starts: t = 2.353."""
    assert Difference(0.5, 0.2, 4).within(1.0) and not Difference(0.5, 0.22, 4).within(1.0)
    assert Difference(-1.5, 0.2, 4).outside(1.0) and not Difference(-1.5, 0.22, 4).outside(1.0)
    known_too_little = Difference(0.0, 1.0, 4)
    assert not known_too_little.within(1.0) and not known_too_little.outside(1.0)
    assert Difference(0.0, 0.0, 2).within(0.1)  # the reference itself


def test_differences_are_paired_and_in_percent():
    """Starts differ by a factor, settings by 2 % of the mean."""
    found = difference([1.03, 2.03, 4.03], [1.0, 2.0, 4.0])
    assert found.mean == pytest.approx(100 * 0.03 * 3 / 7) and found.error == pytest.approx(0, abs=1e-12)
    assert found.starts == 3


def test_ratio_is_that_of_pairs():
    """However the load of the machine changes from pair to pair."""
    load = np.array([1.0, 3.0, 0.5])
    assert ratio_and_interval(2 * load, load) == pytest.approx((2, 2, 2))
    middle, low, high = ratio_and_interval([1, 4], [1, 1])
    # two ratios, 1 and 4: t = 12.706, standard error log(2)
    assert middle == pytest.approx(2) and high == pytest.approx(2 * 2**12.706, rel=1e-3)
    assert low * high == pytest.approx(middle**2)


class Known(NamedTuple):
    """A setting of which all is known."""

    name: str
    cpu: float
    off: bool = False  # shown outside at once
    right: bool = True  # from all starts


class Seen(NamedTuple):
    cpu: float
    outside: bool
    within: bool
    starts: int


def look_for(settings, count=8):
    def measure(setting, starts):
        full = starts == count
        return Seen(setting.cpu, setting.off, full and setting.right and not setting.off, starts)

    return search.search(settings, lambda setting: setting.cpu, measure, count, first=2)


def test_search_finds_the_cheapest_that_is_right():
    cheap, doubtful = Known("cheap", 1, off=True), Known("doubtful", 2, right=False)
    right, dearer, dear = Known("right", 3), Known("dearer", 5), Known("dear", 13)
    found = look_for([dear, right, doubtful, cheap, dearer])
    assert found.chosen is right
    starts = {setting.name: seen.starts for setting, seen in found.measured.items()}
    # what is off, or dearer than what is right, is not run from all starts; beyond four times its cost not at all
    assert starts == {"cheap": 2, "doubtful": 8, "right": 8, "dearer": 2}


def test_search_goes_by_what_was_measured_among_those_that_cost_about_the_same():
    first, second = Known("first", 1.2), Known("second", 1.0)
    expected = {first: 1.0, second: 1.1}

    def measure(setting, starts):
        return Seen(setting.cpu, False, starts == 4, starts)

    assert search.search([first, second], expected.get, measure, 4).chosen is second


def test_search_says_when_there_is_none():
    assert look_for([Known("off", 1, off=True), Known("doubtful", 2, right=False)]).chosen is None


def test_front():
    points = [(1, 5), (2, 6), (3, 2), (4, 2), (5, 1)]
    assert search.front(reversed(points)) == [(1, 5), (3, 2), (5, 1)]
    assert search.front([]) == []


def test_a_setting_fails_with_one_of_its_runs():
    one = measuring.Measured(None, np.array([1.0, 2.0]), (case.BLEW_UP,), {}, {"ratio": 0.5})
    assert one.outside and not one.within and one.cpu == 1.5
    right, off = Difference(0.1, 0.01, 8), Difference(-5.0, 0.01, 8)
    two = measuring.Measured(None, np.array([1.0]), (), {"a": right, "b": off}, {"a": 0.5, "b": 3.0})
    assert two.outside and not two.within and two.error == pytest.approx((5 / 3, 0.01 / 3))


def found(stock, cfpm, ratio, within=True):
    """What is said of a case that came to these settings."""
    chosen = {side: search.Found(setting, {}) for side, setting in zip(finding.SIDES, (stock, cfpm))}
    off = Difference(0.1 if within else 0.9, 0.1, 16)
    measured = measuring.Measured(stock, np.ones(16), (), {"height": off}, {"height": 1.0})
    reported = dict.fromkeys(finding.SIDES, measured)
    return finding.advice(finding.Finding(None, chosen, reported, ratio))


def test_advice():
    stock = settings.Setting("stock", 16, 8)
    same, other = stock._replace(method="verlet"), settings.Setting("exact", 16, 4)
    gain, none, loss = (1.5, 1.4, 1.6), (1.0, 0.9, 1.1), (0.5, 0.4, 0.6)
    assert found(stock, other, gain) == "switch"
    assert found(stock, same, gain) == "switch: what pays is the price of a step alone"
    assert found(stock, other, none).startswith("**do not switch** for speed")
    assert found(stock, other, loss).startswith("**do not switch**:")
    # not within tolerance from other starts: to be compared only where both have the same error
    assert found(stock, other, gain, within=False).startswith("not settled")
    assert found(stock, same._replace(nt=6), gain, within=False).startswith("not settled")
    assert found(stock, same, gain, within=False).startswith("switch: what pays is the price of a step alone; that")


def test_resting():
    """A thousandth of m g d for each sphere."""
    assert case.resting(0.99e-3 * 7 * 2 * 9.81 * 0.5, 7, 2, 0.5)
    assert not case.resting(1.01e-3 * 7 * 2 * 9.81 * 0.5, 7, 2, 0.5)


def test_overlaps_by_thirds():
    """A vertical row whose overlaps grow downwards; the spheres beside it do not touch."""
    heights = np.cumsum([0.0, *[0.05 * (1 - d) for d in (0.03, 0.03, 0.02, 0.02, 0.01, 0.01)]])
    row = np.column_stack([np.zeros(7), np.zeros(7), heights])
    apart = row + [0.06, 0, 0]
    lower, middle, upper = column.overlaps(np.concatenate([row, apart[:1]]))
    assert lower > middle > upper and lower == pytest.approx(0.03)


def test_soft_contacts_last_longer():
    assert settings.Setting("exact", 16, 4).cost(0.5) == pytest.approx(0.25 * settings.Setting("exact", 1, 4).cost(0.5))


@pytest.mark.parametrize("host", ensemble.HOSTS)
def test_a_softened_deck_takes_larger_steps(tmp_path, host):
    runs = [packing.settling(host, "stock", 6, packing.primes(1)[0], n=20, duration=0.006, soften=s) for s in (1, 16)]
    stiff, soft = ensemble.run(runs, tmp_path, "test")
    assert 179 <= stiff.steps <= 180 and 44 <= soft.steps <= 45  # LIGGGHTS's deck does one when it puts the spheres in
    assert stiff.user_seconds <= stiff.cpu_seconds


def short(nt):
    return packing.settling("lammps", "stock", nt, packing.primes(1)[0], n=20, duration=0.006)


def test_runs_that_are_timed_together_are_kept_together(tmp_path, monkeypatch):
    runs = [short(6), short(3)]
    first = ensemble.together(runs, tmp_path, "test")
    assert [result.steps for result in first] == [180, 90]
    monkeypatch.setattr(ensemble, "execute", None)
    assert ensemble.together(runs, tmp_path, "test") == first
    # which of them was first is part of what was measured
    with pytest.raises(TypeError):
        ensemble.together(runs[::-1], tmp_path, "test")


def test_half_a_pair_is_not_kept(tmp_path, monkeypatch):
    real, calls = ensemble.finish, []

    def interrupted(*arguments):
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        real(*arguments)

    monkeypatch.setattr(ensemble, "finish", interrupted)
    with pytest.raises(SystemExit):
        ensemble.together([short(6), short(3)], tmp_path, "test")
    assert [f.name for f in tmp_path.iterdir() if f.is_dir() and not f.name.endswith(".unfinished")] == []
    monkeypatch.setattr(ensemble, "finish", real)
    assert len(ensemble.together([short(6), short(3)], tmp_path, "test")) == 2
