#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of bench/work_precision_remeshing, and says which kernel is the cheapest for an error.

    draw_work_precision_remeshing.py RAW.json     keeps the numbers as docs/charts/work_precision_remeshing.json, draws
                                                  docs/charts/work_precision_remeshing{,_3d}.{svg,png}, writes tables
                                                  into docs/choosing.md
    draw_work_precision_remeshing.py              the same from docs/charts/work_precision_remeshing.json
"""

import collections
import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import LogFormatterSciNotation

import bench_report
from bench_report import label

KEPT = bench_report.CHARTS / "work_precision_remeshing.json"
ORDER = ["Hat", "M3", "M4", "M4Prime", "Lambda22", "M6TriplePrime", "M6", "Lambda44", "Lambda64", "Lambda84"]
COLOUR = dict(zip(ORDER, ["#999999", "#CFA2C8", "#8C6D31", "#E69F00", "#D55E00", "#CC79A7", "#56B4E9", "#0072B2",
                          "#009E73", "#000000"]))
STRATEGIES = {"tensor": ("Tensor", "o", "-"), "threshold": ("Tensor, threshold", "v", "--"), "split": ("Split", "s", ":")}


def series_of(runs, scene):
    """Runs by (kernel, strategy), coarse to fine."""
    result = collections.defaultdict(list)
    for run in runs:
        if run["scene"] == scene:
            result[run["kernel"], run["strategy"]].append(run)
    for line in result.values():
        line.sort(key=lambda run: run["cells"])
    return result


def draw_panel(panel, series, when, title, strategies, time="cpu_seconds"):
    for kernel in ORDER:
        for strategy in strategies:
            _, marker, style = STRATEGIES[strategy]
            line = series.get((kernel, strategy))
            if line:
                panel.loglog([run[time] for run in line], [run[when]["l2"] for run in line], style,
                             marker=marker, color=COLOUR[kernel], markersize=5, linewidth=1.2,
                             markerfacecolor=COLOUR[kernel] if strategy == "tensor" else "white")
    line = series.get(("none", "never"))
    if line and when == "half":
        panel.loglog([run["cpu_seconds"] for run in line], [run[when]["l2"] for run in line], "-", marker="x",
                     color="red", linewidth=1.8, markersize=7)
    panel.set_title(title, fontsize=10)
    panel.set_xlabel("time of one thread, s" if time == "cpu_seconds" else "time of remeshing alone, s")
    panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
    panel.grid(True, which="minor", axis="y", color="#f2f2f2", linewidth=0.4)
    panel.xaxis.set_minor_formatter(LogFormatterSciNotation(minor_thresholds=(0, 0)))
    panel.spines[["top", "right"]].set_visible(False)


def legend(series):
    handles = [Line2D([], [], color=COLOUR[kernel], linewidth=3, label=label(kernel))
               for kernel in ORDER if any(key[0] == kernel for key in series)]
    for name, marker, style in STRATEGIES.values():
        handles.append(Line2D([], [], color="#555555", marker=marker, linestyle=style, label=name,
                              markerfacecolor="#555555" if style == "-" else "white"))
    if ("none", "never") in series:
        handles.append(Line2D([], [], color="red", marker="x", linewidth=1.8, label="never remeshed"))
    return handles


def draw(series, name, heading):
    figure, panels = plt.subplots(1, 3, figsize=(13.5, 5.0), sharey=True)
    draw_panel(panels[0], series, "half", f"{heading} at half time", ["tensor"])
    back = f"{heading} forward and back"
    draw_panel(panels[1], series, "end", back, ["threshold", "split"])
    draw_panel(panels[2], series, "end", back, ["tensor", "split"], "remesh_cpu_seconds")
    panels[0].set_ylabel("error, root mean square, relative")
    figure.legend(handles=legend(series), loc="center left", bbox_to_anchor=(1.0, 0.55), frameon=False, fontsize=9)
    figure.tight_layout()
    bench_report.save(figure, name)
    plt.close(figure)


def time_for(line, error):
    """Time at which a series reaches an error, between its points on the log-log line; None beyond them."""
    for coarse, fine in zip(line, line[1:]):
        e0, e1 = coarse["end"]["l2"], fine["end"]["l2"]
        if e0 >= error >= e1 and e0 > e1:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return coarse["cpu_seconds"] * (fine["cpu_seconds"] / coarse["cpu_seconds"])**share
    return None


def cheapest_rows(series):
    """For falling errors the cheapest three kernels, each with its cheapest strategy."""
    errors = [0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001]
    for error in errors:
        best = {}
        for (kernel, strategy), line in series.items():
            seconds = time_for(line, error) if strategy != "never" else None
            if seconds is not None and seconds < best.get(kernel, (math.inf, ""))[0]:
                best[kernel] = (seconds, strategy)
        ranked = sorted((seconds, kernel, strategy) for kernel, (seconds, strategy) in best.items())[:3]
        if ranked:
            cells = [f"{label(kernel)}, {STRATEGIES[strategy][0]}: {seconds:.2g} s" for seconds, kernel, strategy in ranked]
            yield [f"{error:g}"] + cells + ["-"] * (3 - len(cells))


def order_rows(series):
    for kernel in ORDER:
        for strategy, (name, _, _) in STRATEGIES.items():
            line = series.get((kernel, strategy))
            if not line:
                continue
            finest = line[-1]
            per_step = 1e9 * finest["remesh_cpu_seconds"] / finest["steps"] / finest["mean_particles"]
            yield [
                label(kernel), name, f"{finest['cells']}", f"{finest['half']['l2']:.1e}",
                f"{finest['half'].get('order', float('nan')):.1f}", f"{finest['end']['l2']:.1e}",
                f"{finest['end'].get('order', float('nan')):.1f}", f"{finest['cpu_seconds']:.2g}", f"{per_step:.0f}",
                f"{finest['mean_particles']:.0f}"
            ]


def stretch_rows(runs):
    for run in sorted((run for run in runs if run["scene"] == "stretch"), key=lambda run: ORDER.index(run["kernel"])):
        errors = run["errors"]
        yield [label(run["kernel"])] + [f"{error:.1e}" for error in errors] + [f"{math.log2(errors[-2] / errors[-1]):.1f}"]


STRETCH_HEAD = ["kernel", "stretch 0.2", "0.1", "0.05", "order"]
ORDER_HEAD = ["kernel", "strategy", "cells", "error at T/2", "order", "error at T", "order", "s", "ns a remeshed particle",
              "particles"]


def main(raw=KEPT):
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    for scene, name, heading in (("swirl", "work_precision_remeshing", "2D swirl, T = 8,"),
                                 ("deformation", "work_precision_remeshing_3d", "3D deformation, T = 3,")):
        series = series_of(data["runs"], scene)
        if series:
            draw(series, name, heading)
            bench_report.replace_between(f"orders of the {scene}", bench_report.table(ORDER_HEAD, order_rows(series)))
    stretch = bench_report.table(STRETCH_HEAD, stretch_rows(data["runs"]))
    bench_report.replace_between("error of a stretch", stretch)
    swirl = series_of(data["runs"], "swirl")
    head = ["error wanted at T", "cheapest", "second", "third"]
    bench_report.replace_between("cheapest kernel", bench_report.table(head, cheapest_rows(swirl)))
    never = swirl.get(("none", "never"), [])
    rows = [[run["cells"], f"{run['half']['l2']:.2f}", f"{run['end']['l2']:.1e}"] for run in never]
    bench_report.replace_between("never remeshed", bench_report.table(["cells", "error at T/2", "error at T"], rows))


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
