#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/laplace_young wrote with --json, and with --fields.

    draw_laplace_young.py FIELDS JSON PICTURE    pressure, spurious velocity and errors of one run
    draw_laplace_young.py RAW.json               keeps the figures as docs/charts/laplace_young.json and draws errors
                                                 against R / h, docs/charts/laplace_young.{svg,png}
    draw_laplace_young.py                        the same from docs/charts/laplace_young.json
"""

import json
import sys
from pathlib import Path

import numpy as np

import bench_report
from pictures import load, plt, read_runs, save, show_field

KEPT = bench_report.CHARTS / "laplace_young.json"
RADIUS = 0.25

def show_errors(axes, runs, jump, spread, title, label):
    for dimension, marker in ((2, "o"), (3, "s")):
        chosen = [run for run in runs if run["dimension"] == dimension]
        resolution = [RADIUS * run["cells"] for run in chosen]
        for key, colour, name in ((jump, "tab:blue", "jump"), (spread, "tab:red", "immersed boundary")):
            axes.loglog(resolution, [abs(run[key]) for run in chosen], marker=marker, color=colour,
                        label=f"{name}, {dimension}D")
    axes.set_xticks(resolution, [f"{n:g}" for n in resolution])
    axes.minorticks_off()
    axes.set(title=title, xlabel="R / h", ylabel=label)
    axes.grid(True, alpha=0.3)
    axes.legend()


def main(folder, table, picture):
    runs = read_runs(table)
    jump, spread = load(folder, "pressure_jump"), load(folder, "pressure_spread")
    cells = jump.shape[0]
    velocity = load(folder, "velocity_spread")
    speed = np.sqrt((velocity**2).sum(axis=velocity.shape.index(2)))
    figure, axes = plt.subplots(2, 2, figsize=(12, 10))
    figure.suptitle(f"A drop at rest, gamma = 1, R = 1/4, {cells} x {cells} cells")
    x = np.arange(cells) / cells
    for field, colour, name in ((jump, "tab:blue", "jump"), (spread, "tab:red", "immersed boundary")):
        axes[0, 0].plot(x, (field - field[0, 0])[cells // 2], ".-", color=colour, label=name)
    axes[0, 0].set(title="pressure through the middle", xlabel="x", ylabel="p, gamma / R = 4")
    axes[0, 0].grid(True, alpha=0.3)
    axes[0, 0].legend()
    show_field(axes[0, 1], speed, "spurious velocity of the immersed boundary", cmap="magma")
    show_both(axes[1], runs)
    save(figure, picture)


def show_both(axes, runs):
    show_errors(axes[0], runs, "pressure_error_jump", "pressure_error_spread", "jump of the pressure",
                "relative error")
    show_errors(axes[1], runs, "spurious_jump", "spurious_spread", "spurious velocity", "largest, gamma / R^2 = 16")


def chart(raw=KEPT):
    runs = read_runs(raw)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    Path(KEPT).write_text(json.dumps({"runs": runs}, indent=1) + "\n", encoding="utf-8")
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 4.5))
    show_both(axes, runs)
    bench_report.save(figure, "laplace_young")


if __name__ == "__main__":
    if len(sys.argv) in (1, 2):
        chart(*sys.argv[1:])
    elif len(sys.argv) == 4:
        main(*sys.argv[1:])
    else:
        sys.exit(__doc__)
