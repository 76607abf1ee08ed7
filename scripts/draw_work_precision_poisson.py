#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of bench/work_precision_poisson.

    draw_work_precision_poisson.py RAW.json     keeps the numbers as docs/charts/work_precision_poisson.json and draws
                                                docs/charts/work_precision_poisson.{svg,png}
    draw_work_precision_poisson.py              the same from docs/charts/work_precision_poisson.json
"""

import collections
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

STYLE = {
    "lattice, boundary values": ("o", "#0072B2"),
    "lattice, convolution": ("s", "#56B4E9"),
    "points": ("v", "#E69F00"),
    "spectral": ("D", "#009E73"),
}


def draw_panel(panel, runs, dimension):
    series = collections.defaultdict(list)
    for run in runs:
        if run["dimension"] == dimension:
            series[run["method"]].append(run)
    for method, (marker, colour) in STYLE.items():
        line = sorted(series.get(method, []), key=lambda run: run["cells"])
        if line:
            panel.loglog([run["cpu_seconds"] for run in line], [run["error"] for run in line], marker=marker,
                         color=colour, markersize=5, linewidth=1.2, label=f"{method}: {line[-1]['pairs']:.1f} pairs")
    finest = max(run["cells"] for run in runs if run["dimension"] == dimension)
    bench_report.dress_panel(panel, f"{dimension}D, up to {finest} cells along an axis")
    panel.legend(title="at the finest", frameon=False, fontsize=8, title_fontsize=8)


def main(raw=None):
    data = bench_report.keep("work_precision_poisson", raw)
    figure, panels = plt.subplots(1, 2, figsize=(10.0, 4.5), sharey=True)
    for panel, dimension in zip(panels, (2, 3)):
        draw_panel(panel, data["runs"], dimension)
    panels[0].set_ylabel("largest error of the potential of a Gaussian")
    figure.tight_layout()
    bench_report.save(figure, "work_precision_poisson")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
