#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws where reinitialisations and advections of level sets fail, from bench/failure_map_levelset.

    draw_failure_map_levelset.py RAW.json     keeps the numbers as docs/charts/failure_map_levelset.json, draws
                                              docs/charts/failure_map_levelset.{svg,png}, writes tables into
                                              docs/choosing.md
    draw_failure_map_levelset.py              the same from docs/charts/failure_map_levelset.json
"""

import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Patch

import bench_report

KEPT = bench_report.CHARTS / "failure_map_levelset.json"
COLOUR = {"kept": "#9BD3B4", "degraded": "#F5DE9B", "error": "#B9CFE4", "broken": "#E8907C"}


def in_order(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def numbers(row):
    """Drift of the interface and error of the distance, in spacings."""
    if row["outcome"] == "error":
        return "error"
    return f"{row['drift']:.2f} / {row['distance']:.2f}"


def cells_of(rows, kind, dimension):
    chosen = [row for row in rows if row["kind"] == kind and row["dimension"] == dimension]
    return in_order(chosen, "method"), in_order(chosen, "scene"), {(row["method"], row["scene"]): row for row in chosen}


def draw_panel(panel, rows, kind, dimension):
    methods, scenes, cells = cells_of(rows, kind, dimension)
    for i, method in enumerate(methods):
        for j, scene in enumerate(scenes):
            row = cells[method, scene]
            panel.add_patch(plt.Rectangle((j, i), 1, 1, facecolor=COLOUR[row["outcome"]], edgecolor="white", linewidth=2))
            panel.text(j + 0.5, i + 0.5, numbers(row), ha="center", va="center", fontsize=7.5)
    panel.set(xlim=(0, len(scenes)), ylim=(len(methods), 0), title=f"{dimension}D, {kind}")
    panel.set_xticks([j + 0.5 for j in range(len(scenes))], [scene.replace(" ", "\n", 1) for scene in scenes], fontsize=8)
    panel.set_yticks([i + 0.5 for i in range(len(methods))], methods, fontsize=8)
    panel.tick_params(length=0)
    panel.spines[:].set_visible(False)


def draw(rows):
    counts = [len(cells_of(rows, kind, 2)[0]) for kind in ("reinitialisation", "advection")]
    figure, panels = plt.subplots(2, 2, figsize=(15, 1.8 + 0.42 * sum(counts)), height_ratios=counts)
    for line, kind in zip(panels, ("reinitialisation", "advection")):
        for panel, dimension in zip(line, (2, 3)):
            draw_panel(panel, rows, kind, dimension)
    handles = [Patch(facecolor=colour, label=outcome) for outcome, colour in COLOUR.items()]
    figure.legend(handles=handles, loc="lower center", ncols=4, frameon=False, bbox_to_anchor=(0.5, -0.08),
                  title="drift of the interface / error of the distance, in spacings")
    figure.tight_layout()
    bench_report.save(figure, "failure_map_levelset")
    plt.close(figure)


def table(rows, kind):
    """Outcomes in 2D and 3D, one row for every method."""
    flat, deep = cells_of(rows, kind, 2), cells_of(rows, kind, 3)
    lines = []
    for method in flat[0]:
        line = [method]
        for first, second in zip(flat[1], deep[1]):
            outcomes = [flat[2][method, first]["outcome"], deep[2][method, second]["outcome"]]
            line.append(outcomes[0] if outcomes[0] == outcomes[1] else " / ".join(outcomes))
        lines.append(line)
    heads = [first if first == second else f"{first} / {second}" for first, second in zip(flat[1], deep[1])]
    return bench_report.table(["method", *heads], lines)


def main(raw=KEPT):
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    draw(data["runs"])
    bench_report.replace_between("failures of reinitialisations", table(data["runs"], "reinitialisation"))
    bench_report.replace_between("failures of advections", table(data["runs"], "advection"))


if __name__ == "__main__":
    main(*sys.argv[1:])
