# SPDX-License-Identifier: GPL-2.0-or-later
"""The cheapest setting within tolerance, found without running all of them from all starts.

Settings are tried from the one that should be cheapest on. Each is run from a few starts first; only one that is not
shown to be outside there, and not dearer than what has been found, is run from all. So no setting is taken, or left
out, that the whole grid from all starts would not: what is skipped costs more, or is outside already.
"""

from typing import NamedTuple

FIRST = 3  # starts that every setting is tried with
NEAR = 1.25  # how much dearer than the first within tolerance others may be: CPU times of so few runs scatter
BEYOND = 4  # how much dearer settings still are tried, from the first starts, for the picture of the front


class Found(NamedTuple):
    chosen: object  # the cheapest within tolerance; None if there is none
    measured: dict  # {setting: what was measured of it, from as many starts as it came to}


def search(settings, cost, measure, count, first=FIRST):
    """Found. cost(setting): expected, in any unit; measure(setting, number of starts): a Measured."""
    measured, within = {}, []
    for setting in sorted(settings, key=cost):
        if within and cost(setting) > BEYOND * cost(within[0]):
            break
        measured[setting] = measure(setting, min(first, count))
        if measured[setting].outside:
            continue
        if within and measured[setting].cpu > NEAR * measured[within[0]].cpu:
            continue
        measured[setting] = measure(setting, count)
        if measured[setting].within:
            within.append(setting)
    return Found(min(within, key=lambda setting: measured[setting].cpu, default=None), measured)


def front(points):
    """Of points (cost, error): those with a smaller error than all that cost less, in the order of the cost."""
    found = []
    for cost, error in sorted(points):
        if not found or error < found[-1][1]:
            found.append((cost, error))
    return found
