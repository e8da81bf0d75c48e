# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of in.bidisperse, the deck of beds for timing."""

import ensemble
from harness.decks import deck

NT = 6  # that beds settle with, of the contacts that last shortest


def settle(hosts, runs):
    """{host: file with the small bed}, kept in the folder of runs."""
    variables = {"phase": "settle", "style": "stock", "nt": NT}
    cases = [ensemble.Run(host, deck(host, "bidisperse"), variables, keep=("bed.data",)) for host in hosts]
    results = ensemble.run(cases, runs, "settling of beds of two sizes")
    return {host: result.folder / "bed.data" for host, result in zip(hosts, results)}


def timed(host, bed, nx, ny, **variables):
    """The run that continues nx by ny copies of it. variables: further ones of the deck."""
    variables = {"phase": "time", "bed": bed, "nx": nx, "ny": ny, **variables}
    return ensemble.Run(host, deck(host, "bidisperse"), variables)
