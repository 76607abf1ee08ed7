#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what examples/tumour left in a folder, and writes its page: draw_tumour.py FOLDER

tumour_t<T>.png: the interface coloured by the pressure on its inner side, beside a cross-section of the nutrient with
the necrotic core. series.png: the time series. index.html: all of it with the parameters, in one file.
"""

import base64
import configparser
import csv
import html
import json
import sys
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from pictures import plt, save


def read_options(folder):
    parser = configparser.ConfigParser()
    parser.optionxform = str
    parser.read_string("[run]\n" + (folder / "options.ini").read_text())
    return {name: value.strip('"') for name, value in parser["run"].items()}


def read_table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    numeric = [name for name in rows[0] if name != "bound"]
    return {name: np.array([float(row[name]) for row in rows]) for name in numeric}


class Frame:
    """Interface and middle plane at one time; in the plane, closed curves, in space, triangles."""

    def __init__(self, folder, report, frame):
        self.t, self.dim, self.cells = frame["t"], report["dim"], report["cells"]
        name = frame["name"]

        def load(what):
            return np.load(folder / "pictures" / f"{what}_t{name}.npy")

        self.nutrient, self.phi = load("nutrient"), load("phi")
        if self.dim == 2:
            table = read_table(folder / f"interface_t{name}.csv")
            self.points = np.stack([table["x"], table["y"]], axis=1)
            self.component, self.pressure = table["component"].astype(int), table["pressure"]
        else:
            self.points, self.triangles = load("vertices"), load("triangles")
            self.pressure = load("surface")


def show_curves(axes, frame, norm):
    for k in np.unique(frame.component):
        mine = frame.component == k
        x, p = frame.points[mine], frame.pressure[mine]
        if len(x) < 3:
            continue
        x, p = np.vstack([x, x[:1]]), np.append(p, p[0])
        pieces = np.stack([x[:-1], x[1:]], axis=1)
        jumps = np.linalg.norm(x[1:] - x[:-1], axis=1)
        keep = jumps < 0.5 * np.ptp(frame.points)  # not across a periodic face
        line = LineCollection(pieces[keep], cmap="viridis", norm=norm, linewidths=2.2)
        line.set_array((0.5 * (p[:-1] + p[1:]))[keep])
        axes.add_collection(line)


def show_surface(axes, frame, norm):
    corners = frame.points[frame.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = np.array([0.4, -0.7, 0.6]) / np.linalg.norm([0.4, -0.7, 0.6])
    shade = 0.55 + 0.45 * np.clip(normal @ light, 0, 1)
    colour = plt.get_cmap("viridis")(norm(frame.pressure[frame.triangles].mean(axis=1)))
    colour[:, :3] *= shade[:, None]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colour, edgecolor="none", linewidth=0, antialiased=False))


def show_nutrient(axes, frame, half, limit):
    """The nutrient inside in the middle plane, the interface, and the core where cells die."""
    x = np.linspace(-half, half, frame.cells + 1)[:frame.nutrient.shape[1]]  # a periodic box has no last node
    step = x[1] - x[0]
    image = axes.imshow(frame.nutrient, extent=[x[0] - step / 2, x[-1] + step / 2] * 2, vmin=0, vmax=1, cmap="YlOrBr",
                        interpolation="bilinear")
    axes.contourf(x, x, frame.phi, levels=[0, np.inf], colors="white")
    axes.contour(x, x, frame.phi, levels=[0], colors="black", linewidths=1)
    if limit > 0 and np.nanmin(np.where(frame.phi < 0, frame.nutrient, 1.0)) < limit:
        dead = np.where(frame.phi < 0, frame.nutrient, 1.0)
        axes.contourf(x, x, dead, levels=[-1, limit], colors="none", hatches=["////"])
        axes.contour(x, x, dead, levels=[limit], colors="tab:blue", linewidths=1)
    axes.set_aspect("equal")
    axes.figure.colorbar(image, ax=axes, shrink=0.8, label="nutrient")


def draw_frame(frame, reach, half, limit, path):
    low, high = np.nanpercentile(frame.pressure, [1, 99])
    norm = plt.Normalize(low, max(high, low + 1e-9))
    figure = plt.figure(figsize=(9.5, 4.2))
    left = figure.add_subplot(1, 2, 1, projection="3d" if frame.dim == 3 else None)
    right = figure.add_subplot(1, 2, 2)
    if frame.dim == 3:
        show_surface(left, frame, norm)
        left.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
        left.set_box_aspect((1, 1, 1), zoom=1.35)
        left.view_init(elev=25, azim=-60)
        left.set_axis_off()
    else:
        show_curves(left, frame, norm)
        left.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x", ylabel="y")
        left.set_aspect("equal")
    scale = plt.cm.ScalarMappable(norm=norm, cmap="viridis")
    figure.colorbar(scale, ax=left, shrink=0.8, label="pressure on the inner side", extend="both")
    show_nutrient(right, frame, half, limit)
    right.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="x", ylabel="y",
              title="nutrient, necrotic core hatched" if limit > 0 else "nutrient")
    if frame.dim == 3:
        right.set_title(right.get_title() + ", z = 0")
    figure.suptitle(f"t = {frame.t:.4g}")
    save(figure, path)
    plt.close(figure)


def draw_series(series, dim, path):
    figure, axes = plt.subplots(2, 3, figsize=(11, 5.6), sharex=True)
    t = series["t"]
    volume, area = ("area", "length") if dim == 2 else ("volume", "area")
    axes[0, 0].plot(t, series["volume"], label=volume)
    axes[0, 0].plot(t, series["expected_volume"], "k--", lw=1, label="by its sources")
    axes[0, 0].plot(t, series["necrotic_volume"], color="tab:blue", ls=":", label="necrotic")
    axes[0, 1].plot(t, series["area"], label=f"{area} of the interface")
    axes[0, 2].plot(t, series["greatest_curvature"], label="greatest curvature")
    axes[0, 2].plot(t, series["least_curvature"], label="least curvature")
    axes[1, 0].plot(t, series["inside_components"], drawstyle="steps-post", label="parts of the inside")
    axes[1, 0].plot(t, series["interface_components"], "--", drawstyle="steps-post", label="parts of the interface")
    axes[1, 0].set_ylim(bottom=0.0)
    axes[1, 0].yaxis.get_major_locator().set_params(integer=True)
    axes[1, 1].plot(t, 100 * series["imbalance"], label=f"{volume} less that by its sources, %")
    axes[1, 2].semilogy(t[1:], series["dt"][1:], label="step")
    for each in axes.flat:
        each.grid(True, alpha=0.3)
        each.legend(fontsize=8)
    for each in axes[1]:
        each.set_xlabel("t")
    save(figure, path)
    plt.close(figure)


STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#222}
img{max-width:100%}table{border-collapse:collapse;margin:1em 0}td,th{border-bottom:1px solid #ddd;padding:.2em .8em;
text-align:right}td:first-child,th:first-child{text-align:left}"""


def embedded(path):
    return f'<img alt="{path.stem}" src="data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}">'


def table(head, rows):
    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"


def write_page(folder, report, options, pictures):
    name = report["scene"] if report["scene"] != "none" else options["shape"]
    frames = [[f"{f['t']:.4g}", f"{f['volume']:.6g}", f"{f['area']:.6g}", f["parts"], f["interfaces"],
               f"{f['necrotic_volume']:.4g}", f"{100 * f['imbalance']:.3f} %"] for f in report["frames"]]
    parts = [[part, f"{seconds:.2f}"] for part, seconds in report["parts"].items()]
    body = [
        f"<h1>Tumour: {html.escape(name)}</h1>",
        f"<p>{report['dim']}D, {report['cells']} cells along a side of {report['box']:g}; {report['steps']} steps in "
        f"{report['seconds']:.1f} s to t = {report['t']:.4g}. It ended because: {html.escape(report['ended'])}.</p>",
        table(["t", "volume", "area", "parts", "interfaces", "necrotic", "imbalance"], frames),
        *(embedded(picture) for picture in pictures),
        "<h2>Parameters</h2>", table(["option", "value"], options.items()),
        "<h2>Where the time went</h2>", table(["part of the step", "seconds"], parts),
    ]
    page = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Tumour: {html.escape(name)}</title>' \
           f"<style>{STYLE}</style>{''.join(body)}</html>\n"
    (folder / "index.html").write_text(page)
    print(folder / "index.html")


def main(folder):
    folder = Path(folder)
    report, options = json.loads((folder / "report.json").read_text()), read_options(folder)
    frames = [Frame(folder, report, frame) for frame in report["frames"]]
    half = 0.5 * report["box"]
    reach = min(half, 1.1 * max(np.abs(frame.points).max() for frame in frames))
    pictures = [folder / "series.png"]
    draw_series(read_table(folder / "series.csv"), report["dim"], pictures[0])
    for frame, entry in zip(frames, report["frames"]):
        pictures.append(folder / f"tumour_t{entry['name']}.png")
        draw_frame(frame, reach, half, float(options["N"]), pictures[-1])
    write_page(folder, report, options, pictures)


if __name__ == "__main__":
    main(*sys.argv[1:])
