# SPDX-License-Identifier: GPL-2.0-or-later
"""Beyond the paper: "predict impulse" of LIGGGHTS, exact collisions at any step, where the paper's method is not.

Packing and discharge as ensembles over the time step, robustness with one step per contact, and the CPU time that is
left. Finished runs are kept; the same command goes on after an interruption, and more seeds add to what is there.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / folder) for folder in ("", "packing", "discharge")]
import drained  # noqa: E402
import packing  # noqa: E402
import robustness  # noqa: E402
import settled  # noqa: E402
import speed  # noqa: E402
from cases import starts  # noqa: E402
from exhibit import Exhibit  # noqa: E402

FIRST_SEED = 67867967  # beyond all of the other exhibits, which begin at that of packing.primes
SEEDS = {"full": 16, "quick": 2}


def add_arguments(parser):
    number = "random starts of each case (default {full}, quick {quick})".format(**SEEDS)
    parser.add_argument("--seeds", type=int, help=number)
    parser.add_argument("--no-timing", action="store_true", help="leave out what wants an idle machine")


def main():
    exhibit = Exhibit("Beyond the paper: the impulse of a contact", __doc__, add_arguments)
    seeds = packing.primes(starts(exhibit, **SEEDS), FIRST_SEED)
    exhibit.text(
        """"predict impulse" gives a contact the impulse of its exact collision, from the moment of touch on. All of
        this is LIGGGHTS, beside its stock style (conventional) and cfpm exact, the paper's method."""
    )
    limits = settled.run(exhibit, seeds)
    drained.run(exhibit, seeds)
    robustness.run(exhibit, FIRST_SEED)
    if not exhibit.arguments.no_timing:
        speed.run(exhibit, limits, seeds[0])
    return exhibit.finish()


if __name__ == "__main__":
    sys.exit(main())
