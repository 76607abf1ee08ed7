#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of the compositions of a tumour, from bench/work_precision_tumour --compositions.

    draw_work_precision_tumour.py RAW.json     keeps the numbers as docs/charts/work_precision_tumour.json, draws
                                               docs/charts/work_precision_tumour.{svg,png}
    draw_work_precision_tumour.py              the same from docs/charts/work_precision_tumour.json
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

MARKERS = ["o", "s", "v", "D", "^", "x", "P", "*"]


def main(raw=None):
    data = bench_report.keep("work_precision_tumour", raw)
    runs = [run for run in data["runs"] if run["scene"] == "composition" and not run["stopped"]]
    names = list(dict.fromkeys(run["name"] for run in runs))
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 4.2))
    for panel, error, title in zip(panels, ("radius_error", "wave_error"),
                                   ("radius of a disc at t = 0.1", "height of a wave of l = 4 at t = 0.1")):
        for name, marker, colour in zip(names, MARKERS, bench_report.COLOURS):
            line = sorted((run for run in runs if run["name"] == name), key=lambda run: run["cells"])
            panel.loglog([run["seconds"] for run in line], [abs(run[error]) for run in line], marker=marker,
                         color=colour, markersize=5, linewidth=1.2, label=name)
        bench_report.dress_panel(panel, title)
    panels[0].set_ylabel("relative error")
    panels[1].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    bench_report.save(figure, "work_precision_tumour")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
