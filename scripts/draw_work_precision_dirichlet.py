#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time, and time against residual, of bench/work_precision_dirichlet.

    draw_work_precision_dirichlet.py RAW.json     keeps the numbers as docs/charts/work_precision_dirichlet.json and
                                                  draws docs/charts/work_precision_dirichlet.{svg,png}
    draw_work_precision_dirichlet.py              the same from docs/charts/work_precision_dirichlet.json
"""

import collections
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

KEPT = bench_report.CHARTS / "work_precision_dirichlet.json"
COLOURS = ["#0072B2", "#56B4E9", "#009E73", "#E69F00"]
MARKERS = "osDv"


def name_of(run):
    return f"{run['method']}, V({run['smoothings']},{run['smoothings']})"


def draw_errors(panel, runs, error, title):
    series = collections.defaultdict(list)
    for run in runs:
        series[name_of(run)].append(run)
    for (method, line), colour, marker in zip(series.items(), COLOURS, MARKERS):
        line.sort(key=lambda run: run["cells"])
        panel.loglog([run["setup_seconds"] + run["solve_seconds"] for run in line], [run[error] for run in line],
                     marker=marker, color=colour, markersize=5, linewidth=1.2, label=method)
    panel.set_title(title, fontsize=10)
    panel.set_xlabel("setup and solution, s of one thread")
    panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
    panel.spines[["top", "right"]].set_visible(False)


def draw_costs(panel, data):
    """Setup and solution at the finest resolution, in pairs of transforms."""
    finest = max(run["cells"] for run in data["runs"])
    bars = [(name_of(run), run["setup_pairs"], run["solve_pairs"]) for run in data["runs"] if run["cells"] == finest]
    bars += [(run["method"], run["setup_pairs"], run["solve_pairs"]) for run in data["others"]
             if run["cells"] == finest]
    bars.sort(key=lambda bar: -bar[1] - bar[2])
    names = [bar[0] for bar in bars]
    setups = [bar[1] for bar in bars]
    solves = [bar[2] for bar in bars]
    panel.barh(names, setups, color="#E69F00", label="setup")
    panel.barh(names, solves, left=setups, color="#0072B2", label="solution")
    for row, (setup, solve) in enumerate(zip(setups, solves)):
        panel.text(setup + solve, row, f" {setup + solve:.1f}", va="center", fontsize=7)
    panel.tick_params(axis="y", labelsize=7)
    panel.set_xlim(0, 1.12 * max(setup + solve for setup, solve in zip(setups, solves)))
    panel.set_xlabel("pairs of Fourier transforms")
    panel.set_title(f"{finest} cells along an axis, to 1e-8", fontsize=10)
    panel.spines[["top", "right"]].set_visible(False)
    panel.legend(frameon=False, fontsize=8, loc="upper right")


def main(raw=KEPT):
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    figure, panels = plt.subplots(1, 3, figsize=(14.0, 4.5))
    draw_errors(panels[0], data["runs"], "value_error", "largest error of c")
    draw_errors(panels[1], data["runs"], "derivative_error", "largest error of dc/dn at the interface")
    panels[0].legend(frameon=False, fontsize=7)
    draw_costs(panels[2], data)
    figure.tight_layout()
    bench_report.save(figure, "work_precision_dirichlet")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
