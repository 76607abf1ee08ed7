#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/gaussian_strain wrote with --fields and --json: draw_gaussian.py FIELDS JSON PICTURE"""

import sys

import numpy as np

from pictures import load, plt, read_runs, save, show_convergence, show_field


def main(folder, table, picture):
    runs = read_runs(table)
    cells = [run["cells"] for run in runs]
    box = (-1, 1, -1, 1)
    figure, axes = plt.subplots(2, 3, figsize=(15, 9))
    figure.suptitle("Heat in a turning and straining flow: particle strength exchange, remeshed in every step "
                    f"({cells[-1]} x {cells[-1]} cells; white: exact contours)")
    for number, scene in enumerate(axes.flat[:4]):
        heat, exact = load(folder, f"heat_{number}"), load(folder, f"exact_{number}")
        show_field(scene, heat, f"t = {number / 3:.2f}", extent=box, cmap="inferno", vmin=0.0)
        nodes = np.linspace(-1, 1, exact.shape[0], endpoint=False)
        levels = exact.max() * np.array([0.1, 0.5, 0.9])
        scene.contour(nodes, nodes, exact, levels=levels, colors="white", linewidths=0.8)
        scene.set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8))
    error = (heat - exact) / exact.max()
    bound = np.abs(error).max()
    show_field(axes[1, 1], error, "error at t = 1 relative to the peak", extent=box, cmap="RdBu_r", vmin=-bound,
               vmax=bound)
    axes[1, 1].set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8))
    show_convergence(axes[1, 2], [("largest error, t = 1", cells, [run["error"] for run in runs])], 4,
                     "error over resolution")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
