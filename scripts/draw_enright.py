#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/enright wrote with --fields and --json: draw_enright.py FIELDS JSON PICTURE"""

import sys

import numpy as np

from pictures import load, plt, read_runs, save


def show_surface(axes, folder, name, title):
    vertices = load(folder, f"{name}_vertices")
    triangles = load(folder, f"{name}_triangles").astype(int).T
    axes.plot_trisurf(*vertices, triangles=triangles, color="#56B4E9", edgecolor="none", antialiased=False, shade=True)
    middle = 0.5 * (vertices.max(axis=1) + vertices.min(axis=1))
    half = 0.5 * np.ptp(vertices, axis=1).max()
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half),
             zlim=(middle[2] - half, middle[2] + half), xlabel="x", ylabel="y", zlabel="z")
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(elev=20, azim=-60)
    axes.set_title(title)


def main(folder, table, picture):
    runs = read_runs(table)
    last = runs[-1]
    figure = plt.figure(figsize=(13, 6))
    figure.suptitle(f"A ball in LeVeque's deformation, {last['cells']}^3 cells, {last['interpolations']} interpolations")
    show_surface(figure.add_subplot(1, 2, 1, projection="3d"), folder, "half",
                 f"t = T/2, volume {100 * last['volume_half']:+.2f}%")
    show_surface(figure.add_subplot(1, 2, 2, projection="3d"), folder, "end",
                 f"t = T, volume {100 * last['volume_end']:+.2f}%, L1 {last['distance']:.2f} h")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
