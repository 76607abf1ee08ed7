# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the drawing scripts share: style, fields, charts of convergence."""

import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({
    "font.size": 10,
    "axes.titlesize": 11,
    "figure.titlesize": 13,
    "image.origin": "lower",
    "savefig.dpi": 150,
    "figure.constrained_layout.use": True,
})


def load(folder, name):
    return np.load(Path(folder) / f"{name}.npy")


def read_runs(path):
    return json.loads(Path(path).read_text())["runs"]


def show_field(axes, field, title, extent=(0, 1, 0, 1), **style):
    """A periodic field as an image with equal scales and a colour bar; values beyond the colours are marked on it."""
    half = 0.5 * (extent[1] - extent[0]) / field.shape[1]  # pixels are centred on nodes
    image = axes.imshow(field, extent=[edge - half for edge in extent], interpolation="bilinear", **style)
    axes.set(xlim=extent[:2], ylim=extent[2:])
    low, high = image.get_clim()
    below, above = field.min() < low - 1e-2 * (high - low), field.max() > high + 1e-2 * (high - low)
    extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get((below, above), "neither")
    axes.figure.colorbar(image, ax=axes, shrink=0.85, extend=extend)
    axes.set(title=title, xlabel="x", ylabel="y")
    return image


def show_convergence(axes, series, order, title):
    """Errors over cells per axis, doubly logarithmic; `series` is [(label, cells, errors)]."""
    for (label, cells, errors), marker in zip(series, "osD^"):
        axes.loglog(cells, errors, marker=marker, label=label)
    cells, errors = np.asarray(series[0][1], float), series[0][2]
    last = cells[-2:]
    axes.loglog(last, 0.5 * errors[-1] * (last / last[-1]) ** -order, "k--", lw=1, label=f"order {order}")
    axes.set_xticks(cells, [f"{int(n)}" for n in cells])
    axes.minorticks_off()
    axes.set(title=title, xlabel="cells along an axis", ylabel="relative error")
    axes.grid(True, alpha=0.3)
    axes.legend()


def save(figure, path):
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
    print(path)
