# SPDX-License-Identifier: GPL-2.0-or-later
"""Robustness: how often a bed blows up when a step is as long as a contact, over its damping."""

import ensemble
import matplotlib.pyplot as plt
import packing
from cases import IMPULSE, SPLIT, predictor

HOST = "liggghts"
NT = 1
DAMPINGS = (0.1, 0.2, 0.5, 1, 2)  # gamma
QUICK_DAMPINGS = (0.1, 0.2)
METHODS = IMPULSE, "cfpm impulse split 0.1", SPLIT, "cfpm impulse split 0.5"
QUICK_METHODS = IMPULSE, SPLIT
STARTS = {"full": 20, "quick": 4}


def run(exhibit, first_seed):
    methods, dampings = (QUICK_METHODS, QUICK_DAMPINGS) if exhibit.quick else (METHODS, DAMPINGS)
    seeds = packing.primes(STARTS["quick" if exhibit.quick else "full"], first_seed)
    jobs = [(method, gamma, seed) for seed in seeds for method in methods for gamma in dampings]
    runs = [packing.settling(HOST, "cfpm", NT, seed, predict=predictor(m), gamma=gamma) for m, gamma, seed in jobs]
    blown = {(method, gamma): [] for method in methods for gamma in dampings}
    for (method, gamma, _), result in zip(jobs, ensemble.run(runs, exhibit.runs, "beyond, robustness")):
        blown[method, gamma].append(packing.read(result).blown_up)

    exhibit.text(
        f"""**Robustness.** The packing with one step per contact, nt = {NT}, where the damping is eta = gamma sqrt(m
        k), with the tangential dashpot, from {len(seeds)} random starts each: how many blew up."""
    )
    totals = {method: sum(sum(blown[method, gamma]) for gamma in dampings) for method in methods}
    count = len(seeds) * len(dampings)
    exhibit.table(
        ["method", *(f"gamma = {gamma:g}" for gamma in dampings), "all"],
        [
            [method, *(f"{sum(blown[method, gamma])} of {len(seeds)}" for gamma in dampings), f"{total} of {count}"]
            for method, total in totals.items()
        ],
    )
    rows = [[HOST, "on", m, NT, gamma, len(own), sum(own)] for (m, gamma), own in blown.items()]
    exhibit.csv("robustness", ["host", "dashpot", "method", "nt", "gamma", "runs", "blown_up"], rows)
    exhibit.plot(plot(blown, methods, dampings), "robustness", f"Runs that blew up at nt = {NT}.")
    for method, total in totals.items():
        exhibit.verdict(f"{method}, nt = {NT}: {total} of {count} runs blew up, allowed none", total == 0)


def plot(blown, methods, dampings):
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for k, method in enumerate(methods):
        percent = [100 * sum(blown[method, gamma]) / len(blown[method, gamma]) for gamma in dampings]
        axes.plot([gamma * 1.03**k for gamma in dampings], percent, "sod^"[k], color=f"C{k}", label=method)
    axes.set(xscale="log", xlabel="gamma", ylabel="Runs that blew up, %", ylim=(-5, 105))
    axes.set(xticks=dampings, xticklabels=dampings)
    axes.minorticks_off()
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3)
    figure.tight_layout()
    return figure
