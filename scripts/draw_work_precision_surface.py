#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what bench/work_precision_surface measured.

    draw_work_precision_surface.py RAW.json     keeps the numbers as docs/charts/work_precision_surface.json and draws
                                                docs/charts/work_precision_surface.{svg,png}, and the tables of docs/surface.md
    draw_work_precision_surface.py              the same from docs/charts/work_precision_surface.json
"""

import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report

KEPT = bench_report.CHARTS / "work_precision_surface.json"
PAGE = bench_report.ROOT / "docs" / "surface.md"
MARKERS = {2: "o", 4: "s"}


def series(runs, order, **wanted):
    chosen = [run for run in runs if run["order"] == order and all(run.get(k) == v for k, v in wanted.items())]
    return sorted(chosen, key=lambda run: run["cells"])


def draw(panel, runs, x, y, label, order, colour, style="-"):
    panel.loglog([run[x] for run in runs], [run[y] for run in runs], marker=MARKERS[order], color=colour, linestyle=style,
                 markersize=5, linewidth=1.2, label=label)


def finish(panel, title, x, legend="best"):
    panel.set_title(title, fontsize=10)
    panel.set_xlabel(x)
    panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
    panel.spines[["top", "right"]].set_visible(False)
    panel.legend(frameon=False, fontsize=8, loc=legend)


def show_cells(panel, cells):
    panel.set_xticks(cells, [str(n) for n in cells])
    panel.minorticks_off()


def write_tables(data):
    """Largest errors and seconds, and what rare extensions cost, in docs/surface.md."""
    cells = sorted({run["cells"] for run in data["runs"]})
    rows = []
    for title, wanted, key in (("Y10", {"case": "diffusion", "degree": 1}, "largest"),
                               ("Y10, L2", {"case": "diffusion", "degree": 1}, "l2"),
                               ("Y32", {"case": "diffusion", "degree": 3}, "largest"),
                               ("Y32, rate", {"case": "diffusion", "degree": 3}, "rate_error"),
                               ("Y32, seconds", {"case": "diffusion", "degree": 3}, "seconds"),
                               ("Y32 at rest, t = 0.2", {"case": "at rest"}, "largest"),
                               ("Y32 moving, t = 0.2", {"case": "moving"}, "largest"),
                               ("growing, c", {"case": "growing"}, "largest"),
                               ("growing, interface", {"case": "growing"}, "interface"),
                               ("growing, mass", {"case": "growing"}, "mass"),
                               ("ellipsoid, c", {"case": "ellipsoid"}, "largest"),
                               ("ellipsoid, mass", {"case": "ellipsoid"}, "mass")):
        for order in (2, 4):
            values = [run[key] for run in series(data["runs"], order, **wanted)]
            rows.append([title, order] + [f"{v:.2f}" if key == "seconds" else f"{v:.1e}" for v in values])
    on_particles = sorted(data["particles"], key=lambda run: run["cells"])
    for title, key in (("growing on particles, c", "largest"), ("growing on particles, strengths", "strengths")):
        rows.append([title, "M6"] + [f"{run[key]:.1e}" for run in on_particles])
    grown = [series(data["runs"], order, case="growing") for order in (2, 4)]
    for title, values in (("growing, seconds", grown[0]), ("growing, seconds", grown[1]),
                          ("growing on particles, seconds", on_particles)):
        order = values[0].get("order", "M6")
        rows.append([title, order] + [f"{run['seconds']:.2f}" for run in values])
    head = ["what", "order"] + [f"{n} cells" for n in cells]
    bench_report.replace_between("work_precision_surface", bench_report.table(head, rows), PAGE)
    rows = [[r["every"] if r["every"] <= 128 else "never", f"{r['closest_point']:.1e}", f"{r['pde']:.1e}"]
            for r in data["rare_extensions"]]
    head = ["extension every", "error, by closest points", "error, by PDE"]
    bench_report.replace_between("rare_extensions", bench_report.table(head, rows), PAGE)


def main(raw=KEPT):
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    write_tables(data)
    runs = data["runs"]
    colours = bench_report.COLOURS
    figure, panels = plt.subplots(1, 3, figsize=(13.5, 4.3))
    for order in (2, 4):
        for degree, name, colour in ((1, "Y10", colours[0]), (3, "Y32", colours[1])):
            draw(panels[0], series(runs, order, case="diffusion", degree=degree), "seconds", "largest",
                 f"{name}, order {order}", order, colour)
        draw(panels[1], series(runs, order, case="at rest"), "cells", "largest", f"at rest, order {order}", order,
             colours[2])
        draw(panels[1], series(runs, order, case="moving"), "cells", "largest", f"turning, travelling, order {order}",
             order, colours[3], "--")
        for case, colour, style in (("growing", colours[4], "-"), ("ellipsoid", colours[5], "--")):
            draw(panels[2], series(runs, order, case=case), "cells", "largest", f"c, {case}, order {order}", order, colour,
                 style)
    for case, style in (("growing", "-"), ("ellipsoid", "--")):
        draw(panels[2], series(runs, 4, case=case), "cells", "mass", f"mass, {case}, order 4", 4, colours[8], style)
    cells = sorted({run["cells"] for run in runs})
    for panel in panels[1:]:
        show_cells(panel, cells)
    finish(panels[0], "Diffusion on the unit sphere until t = 0.5", "time of one thread, s")
    finish(panels[1], "Y32 until t = 0.2", "cells along an axis")
    panels[2].set_ylim(bottom=1e-9)
    finish(panels[2], "Interfaces that grow until t = 0.5", "cells along an axis", "lower left")
    panels[0].set_ylabel("largest error over what is left of the amplitude")
    figure.tight_layout()
    bench_report.save(figure, "work_precision_surface")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
