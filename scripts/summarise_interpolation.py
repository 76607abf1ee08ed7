#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads what bench/interpolation wrote with --benchmark_out, prints it beside the wanted figures, and draws it.

    summarise_interpolation.py RAW.json     keeps the numbers as docs/charts/interpolation.json, draws
                                            docs/charts/interpolation.{svg,png}, writes tables into docs/choosing.md
    summarise_interpolation.py              the same from docs/charts/interpolation.json
    summarise_interpolation.py --print RAW.json     only prints
"""

import argparse
import itertools
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bench_report
from bench_report import label

KEPT = bench_report.CHARTS / "interpolation.json"
STATISTICS = ("fraction_of_peak", "ns_per_particle", "node_updates_per_second", "gflops", "gain", "gain_over_arithmetic",
              "speedup_over_tensor", "split_error_over_tensor")

# Wanted: fraction of the peak and speed against the best plain loop, double, one component, sorted.
WANTED_FRACTION = {("M4Prime", 3): 0.30, ("M6", 3): 0.38, ("M4Prime", 2): 0.24, ("M6", 2): 0.36}
WANTED_SPEEDUP = {("M4Prime", 3): 2.4, ("M6", 3): 3.0}
HEADLINE = ["M4Prime", "M6"]
KERNELS = ["Hat", "M3", "M4", "M4Prime", "Lambda22", "M6TriplePrime", "M6", "Lambda44", "Lambda64", "Lambda84"]


def strip(raw):
    """Counters by the name of the row, and what of the context says something about the numbers."""
    context = {key: raw["context"][key] for key in ("date", "cells_2d", "cells_3d", "compiler") if key in raw["context"]}
    rows = {}
    for row in raw["benchmarks"]:
        name = row["name"].split("/iterations:")[0]
        rows[name] = {
            key: value
            for key, value in row.items()
            if key in STATISTICS or key.startswith(("ratio_", "order_", "tensor_", "split_"))
        }
    return {"context": context, "rows": rows}


class Figures:
    def __init__(self, data):
        self.rows = data["rows"]

    def get(self, row, counter):
        return self.rows.get(row, {}).get(counter)

    def best_plain(self, case):
        """Ratio of the time of the fastest plain loop to the library's, and who compiled it."""
        ratios = [(self.get(f"{case}/1/plain_{by}", "ratio_to_library"), by) for by in ("build", "clang")]
        return min(((ratio, by) for ratio, by in ratios if ratio is not None), default=(None, ""))


def number(value, digits=3):
    return "-" if value is None else f"{value:.{digits}g}"


def beside(value, wanted, at_least):
    """`value (wanted)`, with a mark where it is missed."""
    if value is None:
        return "-"
    text = f"{value:.2f}"
    if wanted is None:
        return text
    met = value >= wanted if at_least else value <= wanted
    return f"{text} ({'≥' if at_least else '≤'} {wanted:g}{'' if met else ', missed'})"


def detail_rows(figures, kernels):
    """Each kernel in 3D and 2D, both ways; those that were not measured are left out."""
    for kernel, dimension, way in itertools.product(kernels, (3, 2), ("p2m", "m2p")):
        if f"{way}/{kernel}/{dimension}D/double/1/sorted" in figures.rows:
            case = f"{way}/{kernel}/{dimension}D/double"
            narrow = f"{way}/{kernel}/{dimension}D/float"
            plain, by = figures.best_plain(case)
            yield [
                f"{dimension}D {label(kernel)} {way}",
                number(figures.get(f"{case}/1/sorted", "ns_per_particle")),
                beside(figures.get(f"{case}/1/sorted", "fraction_of_peak"), WANTED_FRACTION.get((kernel, dimension)), True),
                beside(plain, WANTED_SPEEDUP.get((kernel, dimension)), True) + (" clang" if by == "clang" else ""),
                beside(figures.get(f"{case}/1/user", "ratio_to_library"), None, True),
                beside(figures.get(f"{narrow}/1/sorted", "ratio_to_double"), 0.75, False),
                beside(figures.get(f"{case}/3/sorted", "ratio_to_one_component"), 2.4, False),
                beside(figures.get(f"{case}/1/random", "ratio_to_sorted"), 3.5, False),
                beside(figures.get(f"threads/{case}/1/sorted/2", "gain_over_arithmetic"), 0.9, True),
            ]


DETAIL_HEAD = [
    "double, one component", "ns a particle", "share of FMA peak", "against best plain loop", "against a user's loop",
    "float / double", "3 components / 1", "random / sorted", "gain of 2 threads / arithmetic's"
]


def remesh_rows(figures):
    for kernel in KERNELS:
        ratio = figures.get(f"remesh/{kernel}/3D/split", "speedup_over_tensor")
        if ratio is None:
            continue
        error = f"remesh_error/{kernel}/3D"
        yield [
            label(kernel),
            number(figures.get(f"remesh/{kernel}/3D/tensor", "ns_per_particle")),
            number(figures.get(f"remesh/{kernel}/3D/split", "ns_per_particle")),
            beside(ratio, 5 if kernel in ("M6", "Lambda44") else None, True),
            number(figures.get(error, "order_tensor")),
            number(figures.get(error, "order_split")),
            number(figures.get(error, "split_error_over_tensor")),
        ]


REMESH_HEAD = ["3D", "Tensor, ns a particle", "Split, ns a particle", "Split faster by", "order of Tensor",
               "order of Split", "error of Split / Tensor"]


def draw(figures):
    """Share of the FMA peak: library and plain loops, double and one component, one panel for each dimension."""
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
    series = [("library", bench_report.COLOURS[0]), ("plain loop, clang++", bench_report.COLOURS[4]),
              ("plain loop, compiler of the build", bench_report.COLOURS[1]), ("user's loop", bench_report.COLOURS[8])]
    for panel, dimension in zip(panels, (2, 3)):
        cases = [(kernel, way) for kernel in ("M4Prime", "M6") for way in ("p2m", "m2p")]
        for i, (kernel, way) in enumerate(cases):
            case = f"{way}/{kernel}/{dimension}D/double"
            library = figures.get(f"{case}/1/sorted", "fraction_of_peak")
            if library is None:
                continue
            ratios = [1.0] + [figures.get(f"{case}/1/{who}", "ratio_to_library")
                              for who in ("plain_clang", "plain_build", "user")]
            for k, ratio in enumerate(ratios):
                if ratio is None:
                    continue
                height = 100 * library / ratio
                bar = panel.bar(i + 0.2 * (k - 1.5), height, 0.19, color=series[k][1],
                                label=series[k][0] if i == 0 else None)
                panel.bar_label(bar, fmt="%.0f", fontsize=8, padding=1)
            wanted = 100 * WANTED_FRACTION[kernel, dimension]
            panel.plot([i - 0.45, i + 0.45], [wanted, wanted], color="black", linewidth=1, linestyle=":",
                       label="wanted of the library" if i == 0 else None)
        panel.set_xticks(range(len(cases)), [f"{label(kernel)}\n{way.upper()}" for kernel, way in cases])
        panel.set_title(f"{dimension}D, double, one component, sorted particles", fontsize=10)
        panel.spines[["top", "right"]].set_visible(False)
        panel.set_ylim(0, 50)
    panels[0].set_ylabel("share of the multiply-add peak of one core, %")
    panels[0].legend(frameon=False, fontsize=8.5, loc="upper left")
    figure.tight_layout()
    bench_report.save(figure, "interpolation")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("raw", nargs="?", help="file that bench/interpolation wrote")
    parser.add_argument("--print", action="store_true", dest="only_print", help="write no files")
    arguments = parser.parse_args()
    if arguments.raw:
        with open(arguments.raw, encoding="utf-8") as file:
            data = strip(json.load(file))
    else:
        data = json.loads(KEPT.read_text(encoding="utf-8"))
    figures = Figures(data)
    detail = bench_report.table(DETAIL_HEAD, detail_rows(figures, HEADLINE))
    others = [kernel for kernel in KERNELS if kernel not in HEADLINE]
    kernels = bench_report.table(DETAIL_HEAD, detail_rows(figures, others))
    remesh = bench_report.table(REMESH_HEAD, remesh_rows(figures))
    print("\n\n".join("\n".join(lines) for lines in (detail, kernels, remesh)))
    if arguments.only_print:
        return
    bench_report.CHARTS.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    draw(figures)
    bench_report.replace_between("speed of interpolation", detail)
    bench_report.replace_between("speed of kernels", kernels)
    bench_report.replace_between("speed of remeshing", remesh)


if __name__ == "__main__":
    main()
