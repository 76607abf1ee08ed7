#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws scenes that examples/surface_pattern wrote with --fields and --json: draw_surface_pattern.py FIELDS JSON PICTURE

Every scene is a row, or, where each has one picture, all are in one row of three.
"""

import sys

import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from pictures import load, plt, read_runs, save


def show_surface(axes, folder, name, title, half):
    """The surface coloured by the first species, dark to light from its lowest value to its highest, shaded."""
    x = load(folder, f"{name}_vertices").T
    triangles = load(folder, f"{name}_triangles").astype(int).T
    c = load(folder, f"{name}_c").ravel()
    if x.shape[1] != 3:
        x, triangles = x.T, triangles.T
    corners = x[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = np.array([0.4, -0.7, 0.6]) / np.linalg.norm([0.4, -0.7, 0.6])
    shade = 0.55 + 0.45 * np.clip(normal @ light, 0, 1)
    value = (c[triangles].mean(axis=1) - c.min()) / max(np.ptp(c), 1e-12)
    colour = plt.get_cmap("viridis")(value)
    colour[:, :3] *= shade[:, None]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colour, edgecolor="none", linewidth=0, antialiased=False))
    axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(-half, half))
    axes.set_box_aspect((1, 1, 1), zoom=1.5)
    axes.view_init(elev=25, azim=-60)
    axes.set_axis_off()
    axes.set_title(title, fontsize=9)


def main(folder, table, picture):
    runs = read_runs(table)
    single = all(len(run["frames"]) == 1 for run in runs)
    columns = min(len(runs), 4) if single else max(len(run["frames"]) for run in runs)
    rows = -(-len(runs) // columns) if single else len(runs)
    figure = plt.figure(figsize=(3.0 * columns, 3.2 * rows))
    for r, run in enumerate(runs):
        vertices = [load(folder, f"{run['scene']}{f}_vertices") for f in range(len(run["frames"]))]
        half = max(np.abs(v).max() for v in vertices)
        for f, frame in enumerate(run["frames"]):
            place = r + 1 if single else r * columns + f + 1
            title = f"{run['scene'].replace('_', ' ')}, {run['cells']}$^3$, t = {frame['t']:.4g}\n" \
                    f"$c_1$ in [{frame['low']:.2f}, {frame['high']:.2f}]"
            if frame["parts"] > 1:
                title += f", {frame['parts']} parts"
            show_surface(figure.add_subplot(rows, columns, place, projection="3d"), folder, f"{run['scene']}{f}", title,
                         half)
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
