#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/swirl wrote with --fields and --json: draw_swirl.py FIELDS JSON PICTURE"""

import sys

from pictures import load, plt, read_runs, save, show_convergence, show_field


def main(folder, table, picture):
    runs = read_runs(table)
    cells = [run["cells"] for run in runs]
    colours = {"cmap": "magma", "vmin": 0.0, "vmax": 1.0}
    figure, axes = plt.subplots(2, 3, figsize=(15, 9))
    figure.suptitle(f"A blob wound up until t = T/2 and unwound until t = T, {cells[-1]} x {cells[-1]} cells")
    show_field(axes[0, 0], load(folder, "exact_half"), "t = T/2, exact", **colours)
    show_field(axes[0, 1], load(folder, "remeshed_half"), "t = T/2, remeshed in every step", **colours)
    show_field(axes[0, 2], load(folder, "scattered_half"), "t = T/2, never remeshed", **colours)
    show_field(axes[1, 0], load(folder, "remeshed_end"), "t = T, remeshed in every step", **colours)

    spacing = 1.0 / cells[-1]
    zoom = (0.165, 0.285, 0.44, 0.56)
    scene = axes[1, 1]
    edges = (-0.5 * spacing, 1 - 0.5 * spacing)
    scene.imshow(load(folder, "exact_half"), extent=2 * edges, cmap="Greys", vmax=2.0, interpolation="bilinear")
    for kind, colour, label in (("remeshed", "tab:blue", "remeshed"), ("scattered", "tab:red", "never remeshed")):
        x, y = load(folder, f"{kind}_particles")
        inside = (x > zoom[0]) & (x < zoom[1]) & (y > zoom[2]) & (y < zoom[3])
        scene.scatter(x[inside], y[inside], s=(1500 if kind == "remeshed" else 3000) * spacing, color=colour,
                      label=label, linewidths=0)
    scene.set(xlim=zoom[:2], ylim=zoom[2:], aspect="equal", xlabel="x", ylabel="y", 
              title="particles at t = T/2, a part of the filament")
    scene.legend(loc="upper right", markerscale=2)

    show_convergence(axes[1, 2], [("remeshed, t = T/2", cells, [run["remeshed_half"] for run in runs]),
                                  ("remeshed, t = T", cells, [run["remeshed_end"] for run in runs]),
                                  ("never remeshed, t = T/2", cells, [run["scattered_half"] for run in runs])],
                     4, "error over resolution")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
