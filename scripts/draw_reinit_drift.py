#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/reinit_drift wrote with --fields and --json: draw_reinit_drift.py FIELDS JSON PICTURE"""

import sys

from pictures import load, plt, read_runs, save

SCENE = "ball off-centre"
FLOOR = 1e-8  # what is less is drawn there


def main(folder, table, picture):
    runs = read_runs(table)
    policies = list(dict.fromkeys(run["policy"] for run in runs))
    figure, axes = plt.subplots(1, 3, figsize=(18, 6))
    figure.suptitle(f"Reinitialised again and again: {SCENE}, radius 10.7 spacings")
    colours = plt.get_cmap("tab20").colors
    for number, policy in enumerate(policies):
        run = next((r for r in runs if r["policy"] == policy and r["scene"] == SCENE), None)
        if run is None:
            continue
        style = {"color": colours[number % 20], "label": policy, "lw": 2.5 if number == 0 else 1.2}
        calls = [state["calls"] for state in run["history"]]
        for plot, what in zip(axes, ("volume", "displacement")):
            plot.loglog(calls, [max(abs(state[what]), FLOOR) for state in run["history"]], marker=".", **style)
            if run["vanished"]:
                plot.axvline(run["vanished"], color=style["color"], ls=":", lw=1)
        section = load(folder, f"section_{number}_{calls[-1]}")
        half = 0.5 * (section.shape[0] - 1) * 0.1875
        edge = [k * 0.1875 - half for k in range(section.shape[0])]
        axes[2].contour(edge, edge, section, levels=[0.0], colors=[style["color"]], linewidths=style["lw"])
    axes[0].set(title="change of the volume", xlabel="calls", ylabel="relative")
    axes[1].set(title="displacement of the interface", xlabel="calls", ylabel="spacings")
    axes[2].set(title="section y = 0 at the last call drawn", xlabel="x", ylabel="z", aspect="equal")
    for plot in axes[:2]:
        plot.grid(True, alpha=0.3)
    axes[0].legend(fontsize=8)
    save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
