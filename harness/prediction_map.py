# SPDX-License-Identifier: GPL-2.0-or-later
"""What the predictors make of a linear contact in one step, from their definitions (Table 3), not from the code."""

import numpy as np
from scipy.linalg import expm


def scaled_map(predictor, theta, zeta):
    """The predictor's map of (omega d, u). theta: omega dt; zeta: damping ratio."""
    generator = theta * np.array([[0.0, 1.0], [-1.0, -2.0 * zeta]])
    one = np.eye(2)
    if predictor == "exact":
        return expm(generator)
    if predictor == "trapezoid":
        return np.linalg.solve(one - generator / 2, one + generator / 2)
    square = generator @ generator
    if predictor == "rk4":
        return one + generator + square / 2 + square @ generator / 6 + square @ square / 24
    if predictor == "rk2":  # (31-33), then (34)
        rate = (one + generator + square / 2)[1]
        return np.array([[1.0 + theta / 2 * rate[0], theta / 2 * (1.0 + rate[1])], rate])
    raise ValueError(f"no map of predictor '{predictor}'")
