#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws error against time of bench/work_precision_levelset and writes its tables into docs/choosing.md.

    draw_work_precision_levelset.py RAW.json     keeps the numbers as docs/charts/work_precision_levelset.json, draws
                                                 docs/charts/work_precision_levelset_*.{svg,png}, writes the tables
    draw_work_precision_levelset.py              the same from docs/charts/work_precision_levelset.json
"""

import collections
import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

import bench_report

KEPT = bench_report.CHARTS / "work_precision_levelset.json"
BLUE, RED, GREEN, PINK, ORANGE, SKY, BLACK = bench_report.COLOURS[:7]
ADVECTION = {"Backward": BLUE, "Lagrangian": GREEN, "ParticleCorrected": ORANGE, "Eulerian": PINK, "OpenVDB": BLACK}
REINITIALISATION = {"closest points": BLUE, "marching and sweeping": GREEN, "PDE": PINK, "Lagrangian": ORANGE,
                    "OpenVDB": BLACK, "scikit-fmm": RED}
MARKERS = "osD^v<>PXhp*"
CELLS_MARKERS = "osD^"


def plain(value, _):
    return f"{value:g}"


def finish(panel):
    panel.grid(True, which="major", color="#dddddd", linewidth=0.6)
    panel.grid(True, which="minor", color="#f2f2f2", linewidth=0.4)
    panel.spines[["top", "right"]].set_visible(False)


def draw_advection(rows):
    sizes = sorted({row["cells"] for row in rows})
    figure, panels = plt.subplots(1, 3, figsize=(14.5, 5.2), sharex=True)
    shown = (("distance", "L1 distance to the ball at T, in spacings"),
             ("volume_half", "error of the volume at T/2, %"), ("volume_end", "error of the volume at T, %"))
    for panel, (key, title) in zip(panels, shown):
        for family, colour in ADVECTION.items():
            for size, marker in zip(sizes, CELLS_MARKERS):
                line = [row for row in rows if row["family"] == family and row["cells"] == size and key in row]
                scale = 1.0 if key == "distance" else 100.0
                errors = [scale * abs(row[key]) for row in line]
                panel.loglog([row["seconds"] for row in line], errors, "-", marker=marker, color=colour, markersize=7,
                             markerfacecolor=colour if size == sizes[-1] else "white", linewidth=1.3)
                for row, error in zip(line, errors):
                    finer = [other for other in rows if other["method"] == row["method"] and key in other and
                             other["cells"] > size]
                    if finer:
                        panel.loglog([row["seconds"], finer[0]["seconds"]], [error, scale * abs(finer[0][key])], ":",
                                     color=colour, linewidth=0.8)
                    if family != "OpenVDB":
                        panel.annotate(str(row["steps"] if family != "Eulerian" else row["work"]),
                                       (row["seconds"], error), xytext=(4, 4), textcoords="offset points", fontsize=7,
                                       color=colour)
        panel.set_title(title, fontsize=10)
        panel.set_xlabel("time of one thread, s")
        panel.xaxis.set_major_formatter(FuncFormatter(plain))
        panel.yaxis.set_major_formatter(FuncFormatter(plain))
        finish(panel)
    handles = [Line2D([], [], color=colour, linewidth=3, label=family) for family, colour in ADVECTION.items()]
    handles += [Line2D([], [], color="#555555", marker=marker, linestyle="", label=f"{size}³ cells",
                       markerfacecolor="#555555" if size == sizes[-1] else "white")
                for size, marker in zip(sizes, CELLS_MARKERS)]
    handles.append(Line2D([], [], color="#555555", linestyle=":", linewidth=0.8, label="same steps, finer"))
    handles.append(Line2D([], [], linestyle="", label="numbers: steps"))
    figure.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.55), frameon=False, fontsize=9)
    figure.tight_layout()
    bench_report.save(figure, "work_precision_levelset_advection")
    plt.close(figure)


def lines_of(rows, dimension):
    """Rows of one dimension by (family, method), coarse to fine, families in the order of their colours."""
    result = collections.OrderedDict()
    for family in REINITIALISATION:
        for row in rows:
            if row["family"] == family and row["dimension"] == dimension:
                result.setdefault((family, row["method"]), []).append(row)
    for line in result.values():
        line.sort(key=lambda row: row["cells"])
    return result


def best_geometry(line):
    """The geometry with the smallest mean error of the curvature on the finest lattice."""
    errors = line[-1]["curvature"]
    return min(errors, key=lambda name: errors[name]["mean"])


def error_of(line, row, what, norm):
    return row["distance"][norm] if what == "distance" else row["curvature"][best_geometry(line)][norm]


def styles(lines):
    """Colour, marker and line of each method: one colour for a family, a marker for each method in it."""
    count = collections.Counter()
    result = {}
    for family, method in lines:
        marker = MARKERS[count[family] % len(MARKERS)]
        result[family, method] = (REINITIALISATION[family], marker)
        count[family] += 1
    return result


def draw_reinitialisation(lines, what, name, heading):
    look = styles(lines)
    figure, panels = plt.subplots(1, 2, figsize=(13.5, 7.0))
    unit = "spacings" if what == "distance" else "relative"
    for panel, norm in zip(panels, ("max", "mean")):
        for key, line in lines.items():
            colour, marker = look[key]
            panel.loglog([row["ns_per_node"] for row in line], [error_of(line, row, what, norm) for row in line], "-",
                         color=colour, linewidth=1.0, alpha=0.7)
            for place, row in enumerate(line):
                finest = place + 1 == len(line)
                panel.loglog(row["ns_per_node"], error_of(line, row, what, norm), marker=marker, linestyle="",
                             color=colour, markersize=8 if finest else 5, markerfacecolor=colour if finest else "white")
        panel.set_title(f"{heading}, {'largest' if norm == 'max' else 'mean'} error ({unit})", fontsize=10)
        panel.set_xlabel("reinitialisation on one thread, ns a node")
        panel.xaxis.set_major_formatter(FuncFormatter(plain))
        finish(panel)
    handles = []
    for family in REINITIALISATION:
        of_family = [key for key in lines if key[0] == family]
        if of_family:
            handles.append(Line2D([], [], linestyle="", label=family))
        handles += [Line2D([], [], color=look[key][0], marker=look[key][1], linewidth=1.0,
                           label=key[1] + (f"; {best_geometry(lines[key])}" if what == "curvature" else ""))
                    for key in of_family]
    sizes = sorted({row["cells"] for line in lines.values() for row in line})
    handles.append(Line2D([], [], linestyle="", label=f"down a line: {', '.join(map(str, sizes))} cells"))
    legend = figure.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
    for text in legend.get_texts():
        if text.get_text() in REINITIALISATION:
            text.set_weight("bold")
    figure.tight_layout()
    bench_report.save(figure, name)
    plt.close(figure)


def percent(row, key):
    return f"{100 * row[key]:+.2f}%" if key in row else "lost"


def advection_rows(rows):
    for row in sorted(rows, key=lambda row: (row["cells"], list(ADVECTION).index(row["family"]))):
        rival = [other for other in rows if other["family"] == "OpenVDB" and other["cells"] == row["cells"]]
        ratio = f"{rival[0]['seconds'] / row['seconds']:.1f}" if rival else "-"
        distance = f"{row['distance']:.3f}" if "distance" in row else "lost"
        yield [f"{row['cells']}³", row["method"], row["work"], percent(row, "volume_half"), percent(row, "volume_end"),
               distance, f"{row['seconds']:.2f}", ratio]


def order_between(coarse, fine, norm="max"):
    refinement = math.log(fine["cells"] / coarse["cells"])
    # In spacings, which themselves fall by one order.
    return 1.0 + math.log(coarse["distance"][norm] / fine["distance"][norm]) / refinement


def reinitialisation_rows(lines):
    for (_, method), line in lines.items():
        fine = line[-1]
        geometry = best_geometry(line)
        order = f"{order_between(line[-2], fine):.1f}" if len(line) > 1 else "-"
        yield [method, f"{fine['ns_per_node']:.0f}", f"{fine['distance']['max']:.1e}", order,
               f"{fine['distance']['mean']:.1e}", f"{fine['curvature'][geometry]['max']:.1e}",
               f"{fine['curvature'][geometry]['mean']:.1e}", geometry]


ADVECTION_HEAD = ["cells", "method", "parts of steps", "volume at T/2", "volume at T", "L1 at T, h", "s",
                  "OpenVDB's time over this"]
REINITIALISATION_HEAD = ["method", "ns a node", "distance, largest error, h", "order", "mean error, h",
                         "curvature, largest error", "mean error", "curvature taken by"]


def main(raw=KEPT):
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    if data["advection"]:
        draw_advection(data["advection"])
        bench_report.replace_between("advection of level sets",
                                     bench_report.table(ADVECTION_HEAD, advection_rows(data["advection"])))
    for dimension in (2, 3):
        lines = lines_of(data["reinitialisation"], dimension)
        if not lines:
            continue
        body = "ellipse" if dimension == 2 else "ellipsoid"
        finest = max(row["cells"] for line in lines.values() for row in line)
        draw_reinitialisation(lines, "distance", f"work_precision_levelset_distance_{dimension}d",
                              f"Distance of an {body}")
        draw_reinitialisation(lines, "curvature", f"work_precision_levelset_curvature_{dimension}d",
                              f"Curvature of an {body}")
        table = bench_report.table(REINITIALISATION_HEAD, reinitialisation_rows(lines))
        cells = f"{finest}{'²' if dimension == 2 else '³'}"
        bench_report.replace_between(f"reinitialisation in {dimension}D", [f"On {cells} cells:", ""] + table)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
