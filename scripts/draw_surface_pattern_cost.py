#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what bench/surface_pattern wrote with --cost: draw_surface_pattern_cost.py JSON PICTURE"""

import json
import sys
from pathlib import Path

from pictures import plt, save


def main(table, picture):
    runs = [run for run in json.loads(Path(table).read_text())["cost"] if run["error"] > 0]
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5))
    for name, marker in zip(dict.fromkeys(run["name"] for run in runs), "osD^vP"):
        mine = [run for run in runs if run["name"] == name]
        for panel, cost in zip(axes, ("evaluations", "processor")):
            panel.loglog([run[cost] for run in mine], [run["error"] for run in mine], marker=marker, label=name)
    for panel, what in zip(axes, ("evaluations of the right-hand side", "seconds of one processor")):
        panel.set(xlabel=what, ylabel="largest error of $c_1$ over its range")
        panel.axhline(1e-3, color="k", lw=0.8, ls="--")
        panel.grid(True, alpha=0.3)
    axes[0].legend()
    figure.suptitle("Six spots from noise: error of the final state")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
