#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/zalesak wrote with --fields and --json: draw_zalesak.py FIELDS JSON PICTURE"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection

from pictures import load, plt, read_runs, save

COLOURS = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00"]


def slotted_disk():
    """The exact outline of the slotted disk."""
    mouth = np.arcsin(0.025 / 0.15)
    angle = np.linspace(mouth, 2 * np.pi - mouth, 200) - 0.5 * np.pi
    x, y = 0.5 + 0.15 * np.cos(angle), 0.75 + 0.15 * np.sin(angle)
    return np.append(x, [0.475, 0.525, x[0]]), np.append(y, [0.85, 0.85, y[0]])


def disk():
    angle = np.linspace(0, 2 * np.pi, 200)
    return 0.5 + 0.15 * np.cos(angle), 0.75 + 0.15 * np.sin(angle)


def show(axes, folder, scene, when, policies, exact, title):
    if exact is not None:
        axes.plot(*exact, color="0.6", lw=3, label="exact")
    for number, (policy, colour) in enumerate(zip(policies, COLOURS)):
        name = f"{scene}_{number}_{when}"
        if not (Path(folder) / f"{name}.npy").exists():
            continue
        ends = load(folder, name).T if load(folder, name).shape[0] == 4 else load(folder, name)
        axes.add_collection(LineCollection(ends.reshape(-1, 2, 2), colors=colour, lw=1.0 if number else 1.6))
        axes.plot([], [], color=colour, label=policy)
    axes.autoscale()
    axes.set(title=title, aspect="equal", xlabel="x", ylabel="y")


def main(folder, table, picture):
    runs = read_runs(table)
    policies = list(dict.fromkeys(run["policy"] for run in runs))

    def summary(scene, periods):
        run = next(r for r in runs if r["scene"] == scene and r["periods"] == periods)
        return f"backward: area {100 * run['area']:+.2f}%, L1 {run['distance']:.3f} h"

    turns = max(run["periods"] for run in runs if run["scene"] == "disk")
    cells = {scene: next(run["cells"] for run in runs if run["scene"] == scene) for scene in ("disk", "vortex")}
    figure, axes = plt.subplots(2, 2, figsize=(12, 12))
    show(axes[0, 0], folder, "disk", 1, policies, slotted_disk(),
         f"slotted disk, {cells['disk']}^2, 1 turn\n{summary('disk', 1)}")
    show(axes[0, 1], folder, "disk", turns, policies, slotted_disk(),
         f"slotted disk, {cells['disk']}^2, {turns} turns\n{summary('disk', turns)}")
    show(axes[1, 0], folder, "vortex", "half", policies, None, f"vortex, {cells['vortex']}^2, t = T/2")
    show(axes[1, 1], folder, "vortex", 1, policies, disk(),
         f"vortex, {cells['vortex']}^2, t = T\n{summary('vortex', 1)}")
    for plot in axes.flat[:2]:
        plot.set(xlim=(0.32, 0.68), ylim=(0.57, 0.93))
    axes[0, 0].legend(loc="lower left", fontsize=8)
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
