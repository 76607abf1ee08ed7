#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""The last picture of every run of examples/tumour in a folder, on one sheet: draw_tumour_scenes.py FOLDER PICTURE"""

import json
import sys
from pathlib import Path

from pictures import plt, save


def main(folder, picture):
    runs = sorted(Path(folder).glob("*/report.json"))
    if not runs:
        raise SystemExit(f"{folder} has no run of examples/tumour: tumour --scene NAME --out {folder}/NAME makes one")
    columns = 3
    rows = -(-len(runs) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(3.6 * columns, 1.9 * rows), squeeze=False)
    for axes in panels.flat:
        axes.set_axis_off()
    for axes, run in zip(panels.flat, runs):
        report = json.loads(run.read_text())
        frame = report["frames"][-1]
        axes.imshow(plt.imread(run.parent / f"tumour_t{frame['name']}.png"), origin="upper")
        size = "area" if report["dim"] == 2 else "volume"
        axes.set_title(f"{report['scene']}: t = {frame['t']:.3g}, {size} {frame['volume']:.4g}", fontsize=8)
    save(figure, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
