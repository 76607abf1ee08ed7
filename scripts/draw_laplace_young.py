#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/laplace_young wrote with --fields and --json: draw_laplace_young.py FIELDS JSON PICTURE"""

import sys

import numpy as np

from pictures import load, plt, read_runs, save, show_field


def show_errors(axes, runs, jump, spread, title, label):
    for dimension, marker in ((2, "o"), (3, "s")):
        chosen = [run for run in runs if run["dimension"] == dimension]
        cells = [run["cells"] for run in chosen]
        for key, colour, name in ((jump, "tab:blue", "jump"), (spread, "tab:red", "immersed boundary")):
            axes.loglog(cells, [abs(run[key]) for run in chosen], marker=marker, color=colour,
                        label=f"{name}, {dimension}D")
    axes.set_xticks(cells, [f"{n}" for n in cells])
    axes.minorticks_off()
    axes.set(title=title, xlabel="cells along an axis (4 radii)", ylabel=label)
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
    show_errors(axes[1, 0], runs, "pressure_error_jump", "pressure_error_spread", "jump of the pressure",
                "relative error")
    show_errors(axes[1, 1], runs, "spurious_jump", "spurious_spread", "spurious velocity", "largest, gamma / R^2 = 16")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
