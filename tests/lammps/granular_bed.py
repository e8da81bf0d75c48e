# SPDX-License-Identifier: GPL-2.0-or-later
"""The bed of kicked_bed.py as a deck of the host's own: pair_style granular and its wall, nothing of the plugin."""

import re

from kicked_bed import bed

# Sub-models by pairs of types. Not dmt: the host of 2021 takes its Coulomb limit from a variable that it has not set;
# and all pairs of types are given, as for others it reads models that it has not set.
MODELS = {
    "hooke": {"* *": "hooke 2e4 0.4 tangential linear_history 8e3 0.5 0.5 damping velocity"},
    "no history": {"* *": "hooke 2e4 100 tangential linear_nohistory 0.5 0.5 damping mass_velocity limit_damping"},
    "material": {
        "* *": "hertz/material 1e7 0.3 0.3 tangential mindlin_rescale NULL 1.0 0.5 "
        "rolling sds 2e3 1 0.3 twisting marshall damping tsuji"
    },
    "types": {
        "1 1": "jkr 1e7 50 0.3 0.1 tangential mindlin NULL 1.0 0.5",
        "1 2": "hertz/material 1e7 50 0.3 tangential mindlin/force NULL 1.0 0.4",
        "2 2": "hertz 1e7 5e4 tangential mindlin_rescale/force 1e7 0.5 0.3 twisting sds 1 1e-3 0.2 limit_damping",
    },
}
WALL = "fix floor all wall/gran granular hertz/material 1e7 0.3 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji"


def granular_bed(models, newton, style="granular", **options):
    deck = bed(style, newton, **options)
    coefficients = "\n".join(f"pair_coeff {types} {words}" for types, words in MODELS[models].items())
    deck = deck.replace("pair_coeff * *", coefficients)
    return re.sub(r"fix floor .* zplane", f"{WALL} zplane", deck)
