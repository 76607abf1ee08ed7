#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of bench/work_precision_neumann.

    draw_work_precision_neumann.py RAW.json     keeps the numbers as docs/charts/work_precision_neumann.json, draws
                                                docs/charts/work_precision_neumann.{svg,png}, writes the table of
                                                docs/choosing.md
    draw_work_precision_neumann.py              the same from docs/charts/work_precision_neumann.json
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

STYLE = {
    "FaceCentroid": ("o", "#0072B2"),
    "FaceCentre": ("s", "#009E73"),
    "PSE with images": ("v", "#D55E00"),
}


def draw_panel(panel, runs, title):
    for method, (marker, colour) in STYLE.items():
        line = sorted((run for run in runs if run["method"] == method), key=lambda run: run["cells"])
        panel.loglog([run["cpu_seconds"] for run in line], [run["error"] for run in line], marker=marker, color=colour,
                     markersize=5, linewidth=1.2, label=method)
    bench_report.dress_panel(panel, title)


def main(raw=None):
    data = bench_report.keep("work_precision_neumann", raw)
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 4.2), sharey=True)
    for panel, dimension in zip(panels, (2, 3)):
        draw_panel(panel, [run for run in data["runs"] if run["dimension"] == dimension],
                   f"{dimension}D, a mode of a {'disk' if dimension == 2 else 'ball'}")
    panels[0].set_ylabel("largest error of the concentration")
    panels[0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    bench_report.save(figure, "work_precision_neumann")
    plt.close(figure)
    rows = [[f"{run['dimension']}D", run["method"], run["cells"], f"{run['error']:.1e}", f"{run['drift']:.0e}",
             run["steps"], f"{run['cpu_seconds']:.2g}"] for run in data["runs"]]
    bench_report.replace_between(
        "diffusion in a closed geometry",
        bench_report.table(["", "method", "cells", "largest error", "drift of the total", "steps", "s"], rows))


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
