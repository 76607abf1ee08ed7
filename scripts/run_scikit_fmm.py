#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Has scikit-fmm reinitialise the fields that bench/work_precision_levelset wrote: run_scikit_fmm.py FOLDER

Distances go to files of doubles beside the fields, times to scikit_fmm.json. Nothing is done, with a note, where
scikit-fmm is missing (Debian: python3-scikit-fmm).
"""

import json
import pathlib
import sys
import time

import numpy as np

CALLS = 3


def reinitialise(skfmm, phi, spacing, order):
    """The distances of all nodes of the box, which costs less a node than a narrow band, and the median of the processor
    time of a call."""
    seconds = []
    for _ in range(CALLS):
        begin = time.thread_time()
        distance = skfmm.distance(phi, dx=spacing, order=order)
        seconds.append(time.thread_time() - begin)
    return distance, sorted(seconds)[CALLS // 2]


def main(folder):
    try:
        import skfmm
    except ImportError:
        print("scikit-fmm is left out: it was not found (Debian: python3-scikit-fmm)")
        return
    folder = pathlib.Path(folder)
    table = []
    for field in json.loads((folder / "fields.json").read_text(encoding="utf-8")):
        shape = (field["cells"] + 1,) * field["dimension"]
        phi = np.fromfile(folder / field["file"]).reshape(shape)
        for order in (1, 2):
            distance, seconds = reinitialise(skfmm, phi, 1.0 / field["cells"], order)
            file = f"{field['file']}_order_{order}"
            distance.tofile(folder / file)
            table.append({"file": file, "dimension": field["dimension"], "cells": field["cells"], "order": order,
                          "nodes": phi.size, "seconds": seconds})
            print(f"scikit-fmm, order {order}, {field['file']}: {1e9 * seconds / phi.size:.0f} ns a node")
    (folder / "scikit_fmm.json").write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
