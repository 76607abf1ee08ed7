#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of bench/work_precision_interface.

    draw_work_precision_interface.py RAW.json     keeps the numbers as docs/charts/work_precision_interface.json and
                                                  draws docs/charts/work_precision_interface.{svg,png}
    draw_work_precision_interface.py              the same from docs/charts/work_precision_interface.json
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

STYLE = {
    "Jump": ("o", "#0072B2"),
    "JumpMayo": ("s", "#E69F00"),
    "ImmersedBoundary": ("v", "#D55E00"),
}


def draw_panel(panel, runs, title):
    for method, (marker, colour) in STYLE.items():
        line = sorted((run for run in runs if run["method"] == method), key=lambda run: run["cells"])
        seconds = [run["cpu_seconds"] for run in line]
        panel.loglog(seconds, [run["error"] for run in line], marker=marker, color=colour, markersize=5, linewidth=1.2,
                     label=f"{method}: p")
        panel.loglog(seconds, [run["error_of_speed"] for run in line], marker=marker, color=colour, markersize=5,
                     linewidth=1.2, linestyle="--", markerfacecolor="white", label=f"{method}: velocity at the interface")
    bench_report.dress_panel(panel, title)


def main(raw=None):
    data = bench_report.keep("work_precision_interface", raw)
    figure, panels = plt.subplots(1, 2, figsize=(10.0, 5.2), sharey=True)
    for panel, dimension in zip(panels, (2, 3)):
        runs = [run for run in data["runs"] if run["dimension"] == dimension]
        cells = sorted({run["cells"] for run in runs})
        draw_panel(panel, runs, f"{dimension}D, {cells[0]} to {cells[-1]} cells along an axis")
    panels[0].set_ylabel("largest error of p, and of the velocity relative to it")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3, frameon=False, fontsize=8)
    figure.tight_layout(rect=(0.0, 0.09, 1.0, 1.0))
    bench_report.save(figure, "work_precision_interface")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
