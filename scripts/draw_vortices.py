#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/lamb_oseen wrote with --fields and --json: draw_vortices.py FIELDS JSON PICTURE"""

import sys

import numpy as np

from pictures import load, plt, read_runs, save, show_convergence, show_field


def main(folder, table, picture):
    runs = read_runs(table)
    flows = {"lamb_oseen": "Lamb-Oseen", "taylor_green": "Taylor-Green"}
    figure, axes = plt.subplots(2, 4, figsize=(19, 8.5))
    cells = max(run["cells"] for run in runs)
    figure.suptitle(f"Vorticity of viscous vortices carried across a periodic box, {cells} x {cells} vortex particles")
    for row, (flow, name) in zip(axes, flows.items()):
        start, end, exact = (load(folder, f"{flow}_{what}") for what in ("start", "end", "exact"))
        bound = np.abs(start).max()
        colours = {"cmap": "RdBu_r", "vmin": -bound, "vmax": bound}
        show_field(row[0], start, f"{name}, t = 0", **colours)
        show_field(row[1], end, f"{name}, t = 1", **colours)
        error = (end - exact) / bound
        bound = np.abs(error).max()
        show_field(row[2], error, "error at t = 1 relative to the peak", cmap="RdBu_r", vmin=-bound, vmax=bound)
        if flow == "lamb_oseen":  # the vortex went from (0.5, 0.25) once round the box to (0.5, 0.75)
            for scene, low in zip(row, (0.0, 0.5, 0.5)):
                scene.set(xlim=(0.25, 0.75), ylim=(low, low + 0.5))
        mine = [run for run in runs if run["flow"] == flow]
        show_convergence(row[3], [("largest error, t = 1", [r["cells"] for r in mine], [r["error"] for r in mine])], 4,
                         "error over resolution")
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
