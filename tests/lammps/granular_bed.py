# SPDX-License-Identifier: GPL-2.0-or-later
"""The bed of kicked_bed.py as a deck of the host's own: pair_style granular and its wall, nothing of the plugin."""

import re
from itertools import combinations_with_replacement, cycle

from harness.lammps import version
from kicked_bed import bed

IS_NEWER = version() >= 20221222  # its sub-models are classes of their own

TSUJI = "hertz/material 1e7 0.3 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji"
ROLLING = f"{TSUJI} rolling sds 2e3 1 0.1"
NORMAL = {"hooke": "hooke 2e4 {}", "hertz": "hertz 1e7 {}", "material": "hertz/material 1e7 {} 0.3"}
DAMPING = {"velocity": 0.4, "mass_velocity": 100, "viscoelastic": 5e4, "tsuji": 0.3}
if IS_NEWER:
    DAMPING["coeff_restitution"] = 0.3
MINDLIN = {"hooke": 6e6, "hertz": 6e6, "material": "NULL"}


def by_types(words):
    """Each pair of types has one of these, in turn, if there are enough types."""
    count = 1
    while count * (count + 1) // 2 < len(words):
        count += 1
    pairs = combinations_with_replacement(range(1, count + 1), 2)
    return {f"{i} {j}": model for (i, j), model in zip(pairs, cycle(words))}


def combinations(tangential_of):
    """Of all normal models and dampings. tangential_of(normal): words, of which each combination has another one."""
    return [
        f"{words.format(coefficient)} tangential {tangential} damping {damping}{' limit_damping' * (k % 2)}"
        for normal, words in NORMAL.items()
        for k, (damping, coefficient) in enumerate(DAMPING.items())
        for tangential in tangential_of(normal)
    ]


AREA = ["mindlin/force", "mindlin_rescale", "mindlin_rescale/force"]
TWISTING = "twisting sds 1 1e-4 1e-4"


def of_area(spring, words=TSUJI):
    return words.replace("mindlin ", f"{spring} ")


# Sub-models by pairs of types. In LAMMPS of 2021 not dmt, whose Coulomb limit it takes from a variable that it has not
# set; and all pairs of types are given, as for others it reads models that it has not set.
MODELS = {
    "hooke": {"* *": "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.5 damping velocity"},
    "no history": {"* *": "hooke 2e4 100 tangential linear_nohistory 0.5 0.5 damping mass_velocity limit_damping"},
    "tsuji": {"* *": TSUJI},
    "all with springs": by_types(
        combinations(lambda normal: ["linear_history 8e3 0.5 0.5", f"mindlin {MINDLIN[normal]} 0.8 0.4"])
    ),
    "all without": by_types(combinations(lambda normal: ["linear_nohistory 0.5 0.5"])),
    "sizes": by_types(
        [
            TSUJI,
            "hertz 1e7 5e4 tangential mindlin 6e6 0.5 0.4",
            "hooke 2e4 0.3 tangential linear_history 8e3 0.5 0.5 damping tsuji",
        ]
    ),
    "sizes without": {"* *": "hertz 1e7 5e4 tangential linear_nohistory 0.5 0.4"},
    "rolling": {"* *": ROLLING},
    "sizes rolling": by_types(
        [
            ROLLING,
            "hertz 1e7 5e4 tangential mindlin 6e6 0.5 0.4 rolling sds 4e3 2 0.2",
            "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.5 damping velocity rolling sds 1e3 0 0.05 limit_damping",
        ]
    ),
    **{spring: {"* *": of_area(spring)} for spring in AREA},
    "twisting": {"* *": f"{TSUJI} {TWISTING}"},
    "marshall": {"* *": f"{TSUJI} twisting marshall"},
    "rolling twisting": {"* *": f"{ROLLING} {TWISTING}"},
    "material": {
        "* *": "hertz/material 1e7 0.3 0.3 tangential mindlin_rescale NULL 1.0 0.5 "
        "rolling sds 2e3 1 0.3 twisting marshall damping tsuji"
    },
    "sizes of all": by_types(
        [
            f"{of_area('mindlin_rescale/force')} {TWISTING}",
            "hertz 1e7 5e4 tangential mindlin/force 6e6 0.5 0.4 rolling sds 4e3 2 0.2 twisting marshall",
            "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.5 damping velocity twisting marshall limit_damping",
            f"{of_area('mindlin_rescale', ROLLING)} {TWISTING}",
            "hooke 2e4 0.4 tangential linear_nohistory 0.5 0.5 damping velocity rolling sds 1e3 0 0.05",
            TSUJI,
        ]
    ),
    "types": {
        "1 1": "jkr 1e7 50 0.3 0.1 tangential mindlin NULL 1.0 0.5",
        "1 2": "hertz/material 1e7 50 0.3 tangential mindlin/force NULL 1.0 0.4",
        "2 2": "hertz 1e7 5e4 tangential mindlin_rescale/force 1e7 0.5 0.3 twisting sds 1 1e-3 0.2 limit_damping",
    },
    "some rolling": {"1 *": ROLLING, "2 2": f"{TSUJI} rolling none"},
    "some without": {
        "1 *": "hertz 1e7 5e4 tangential linear_nohistory 0.5 0.4",
        "2 2": "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.5 damping velocity",
    },
}
# Why the host's style computes them.
LEFT_TO_HOST = {
    "types": "'jkr' is computed there alone",
}
if IS_NEWER:
    MODELS["mixed by the host"] = {"1 1": TSUJI, "2 2": TSUJI.replace("1e7 0.3", "2e7 0.4")}
    LEFT_TO_HOST["mixed by the host"] = "it mixes types without a pair_coeff of their own"
    MODELS["dmt"] = {"* *": "dmt 1e7 1e3 0.3 0.05 tangential mindlin NULL 1.0 0.5 rolling sds 2e3 1 0.1"}
    MODELS["some dmt"] = {**MODELS["dmt"], "2 2": f"{TSUJI} {TWISTING}"}
    MODELS["dmt without"] = {"* *": "dmt 1e7 1e3 0.3 0.05 tangential linear_nohistory 0.5 0.5"}
WALL = f"fix floor all wall/gran granular {TSUJI}"


def granular_bed(models, newton, style="granular", **options):
    deck = bed(style, newton, **options)
    types = max(int(kind) for pair in ["2 2", *MODELS[models]] for kind in pair.split() if kind != "*")
    more = "".join(f"\nset group all type/fraction {k} {1 / k} {8000 + k}" for k in range(3, types + 1))
    deck = deck.replace("create_box 2 box", f"create_box {types} box")
    if "sizes" in models:
        more += "\nvariable size atom random(0.006,0.01,4711)\nset group all diameter v_size"
    deck = deck.replace("set type 2 diameter 0.006", f"set type 2 diameter 0.006{more}")
    coefficients = "\n".join(f"pair_coeff {types} {words}" for types, words in MODELS[models].items())
    deck = deck.replace("pair_coeff * *", coefficients)
    return re.sub(r"fix floor .* zplane", f"{WALL} zplane", deck)
