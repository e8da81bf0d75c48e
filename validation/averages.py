# SPDX-License-Identifier: GPL-2.0-or-later
"""Means over an ensemble and their standard errors. NaN stands for a run without a value: it is left out."""

import numpy as np


def mean_and_error(values):
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    if not len(values):
        return np.nan, np.nan
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan


def paired_difference(values, reference):
    """Mean and standard error of the differences start by start, in percent of the mean reference."""
    return mean_and_error(100 * (values - reference) / np.nanmean(reference))


def difference(values, others):
    """Mean and standard error of the difference of two ensembles with starts of their own, in percent of the others."""
    (a, a_error), (b, b_error) = mean_and_error(values), mean_and_error(others)
    return 100 * (a - b) / b, 100 * np.hypot(a_error, b_error) / b


def spread(values, form=".2f"):
    """Median and range as text."""
    low, middle, high = np.quantile(values, (0, 0.5, 1))
    return f"{middle:{form}} ({low:{form}} - {high:{form}})"
