# SPDX-License-Identifier: GPL-2.0-or-later
"""What the bench times: contact models, what predicts them, and the bed they do it in."""

from typing import NamedTuple

REST = 30  # steps per contact time at which every style keeps a bed at rest


class Row(NamedTuple):
    host: str
    model: str
    predict: str
    nt: int = REST
    state: str = "bed"  # at rest; or landing: half of it still falls on what lies

    def __str__(self):
        return f"{self.host:9} {self.model:16} {self.predict:8} {self.nt:3} {self.state:8}"


LINEAR = ("exact", "impulse", "verlet")
HERTZ = ("rk2", "rk4", "verlet")
MODELS = {
    "liggghts": {"hooke": LINEAR, "hooke/stiffness": LINEAR, "hertz": (*HERTZ, "exact", "impulse")},
    "lammps": {"hooke": LINEAR, "hertz": (*HERTZ, "impulse"), "granular": (*HERTZ, "exact", "impulse")},
}
ROWS = [
    Row(host, model, predict)
    for host, models in MODELS.items()
    for model, predictors in models.items()
    for predict in predictors
]
# a step as long as a contact, which no stock style takes: beside another build only
IMPULSE = [row for row in ROWS if row.predict == "impulse"]
LONG_STEPS = [row._replace(nt=1, state=state) for row in IMPULSE for state in ("bed", "landing")]


def chosen(hosts, words, against):
    """The rows of these hosts that have one of the words, where there are words. against: whether beside a build."""
    rows = [row for row in [*ROWS, *(LONG_STEPS if against else [])] if row.host in hosts]
    return [row for row in rows if not words or set(words) & set(str(row).split())]
