#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what bench/surface_pattern wrote with --cost.

    draw_surface_pattern_cost.py RAW.json...    keeps the numbers of all files as docs/charts/surface_pattern_cost.json and draws
                                                docs/charts/surface_pattern_cost.{svg,png}
    draw_surface_pattern_cost.py                the same from docs/charts/surface_pattern_cost.json
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

KEPT = bench_report.CHARTS / "surface_pattern_cost.json"
COLOURS = dict(zip(("RKC2", "Euler", "ARK3, implicit diffusion", "TVDRK2, two halves", "RK4, two halves"),
                   ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")))


def main(*files):
    runs = [run for file in files or [KEPT] for run in json.loads(Path(file).read_text(encoding="utf-8"))["cost"]]
    KEPT.write_text(json.dumps({"cost": runs}, indent=1) + "\n", encoding="utf-8")
    runs = [run for run in runs if run["error"] > 0]
    figure, panels = plt.subplots(1, 2, figsize=(10.5, 4.3), sharey=True, constrained_layout=True)
    for name, cells in dict.fromkeys((run["name"], run["cells"]) for run in runs):
        mine = [run for run in runs if (run["name"], run["cells"]) == (name, cells)]
        for panel, cost in zip(panels, ("evaluations", "processor")):
            panel.loglog([run[cost] for run in mine], [run["error"] for run in mine], marker="o" if cells < 50 else "s",
                         linestyle="-" if cells < 50 else "--", markersize=5, linewidth=1.2, color=COLOURS[name],
                         label=f"{name}, ${cells}^3$")
    for panel, what in zip(panels, ("evaluations of the right-hand side", "seconds of one processor")):
        panel.set_xlabel(what)
        panel.axhline(1e-3, color="k", lw=0.8, ls=":")
        panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
        panel.spines[["top", "right"]].set_visible(False)
    panels[0].set_ylabel("largest error of $c_1$ over its range")
    panels[1].legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.suptitle("Six spots from noise: error of the final state", fontsize=11)
    bench_report.save(figure, "surface_pattern_cost")


if __name__ == "__main__":
    main(*sys.argv[1:])
