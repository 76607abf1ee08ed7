#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the times of bench/far_field.

    draw_far_field.py RAW.json     keeps the numbers as docs/charts/far_field.json and draws
                                   docs/charts/far_field.{svg,png}
    draw_far_field.py              the same from docs/charts/far_field.json
"""

import collections
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

STYLE = {
    "lattice, boundary values": ("o", "#0072B2"),
    "points, convolution": ("v", "#E69F00"),
    "points, then Dirichlet": ("s", "#CC79A7"),
    "plain sum": ("x", "#000000"),
}
TREES = ["#A6DDCB", "#5CBFA0", "#009E73", "#00573F"]
TITLES = {"box": "sources at all nodes", "ball": "sources in a ball a tenth as wide as the box"}


def draw_against_size(panel, runs, sources):
    series = collections.defaultdict(list)
    for run in runs:
        if run["sources"] == sources:
            series[(run["method"], run["tolerance"])].append((run["cells"], run["cpu_seconds"]))
    trees = sorted((key for key in series if key[0] == "tree"), key=lambda key: -key[1])
    for colour, key in zip(TREES, trees):
        panel.loglog(*zip(*sorted(series[key])), marker="D", color=colour, markersize=4, linewidth=1.2,
                     label=f"tree, tolerance {key[1]:.0e}")
    for method, (marker, colour) in STYLE.items():
        if (method, 0.0) in series:
            panel.loglog(*zip(*sorted(series[(method, 0.0)])), marker=marker, color=colour, markersize=5,
                         linewidth=1.2, linestyle=":" if method == "plain sum" else "-", label=method)
    panel.set_title(TITLES[sources], fontsize=10)
    panel.set_xlabel("cells along an axis")
    cells = sorted({run["cells"] for run in runs})
    panel.set_xticks(cells, [str(n) for n in cells])
    panel.minorticks_off()


def draw_against_error(panel, runs):
    finest = max(run["cells"] for run in runs)
    for sources, line in (("box", "-"), ("ball", "--")):
        points = sorted((run["error"], run["cpu_seconds"]) for run in runs
                        if run["cells"] == finest and run["sources"] == sources and run["method"] == "tree")
        panel.loglog(*zip(*points), marker="D", color=TREES[2], markersize=4, linewidth=1.2, linestyle=line,
                     label=f"tree, {TITLES[sources]}")
    for run in runs:
        if run["cells"] == finest and run["sources"] == "box" and run["method"] in STYLE:
            marker, colour = STYLE[run["method"]]
            panel.loglog([run["error"]], [run["cpu_seconds"]], marker=marker, color=colour, linestyle="",
                         label=run["method"])
    panel.set_title(f"{finest} cells along an axis", fontsize=10)
    panel.set_xlabel("error / potential of the absolute strengths")


def main(raw=None):
    data = bench_report.keep("far_field", raw)
    figure, panels = plt.subplots(1, 3, figsize=(14.0, 4.8), sharey=True)
    draw_against_size(panels[0], data["runs"], "box")
    draw_against_size(panels[1], data["runs"], "ball")
    draw_against_error(panels[2], data["runs"])
    panels[0].set_ylabel("time of one thread, s")
    for panel in panels:
        panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
        panel.spines[["top", "right"]].set_visible(False)
    panels[0].legend(frameon=False, fontsize=7)
    panels[2].legend(frameon=False, fontsize=7)
    figure.tight_layout()
    bench_report.save(figure, "far_field")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
