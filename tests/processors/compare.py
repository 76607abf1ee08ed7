# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a program that was compiled for several processors agree to round-off: compare.py LEVEL=PROGRAM ...

A level that this processor does not have is left out, with a note.
"""

import subprocess
import sys
from pathlib import Path

NEEDED = {
    "x86-64": set(),
    "x86-64-v3": {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"},
    "x86-64-v4": {"avx2", "fma", "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"},
}
# Sums of a few hundred terms of order one: hundreds of units of round-off at most, and few in truth.
TOLERANCE = {"mesh": 300 * 1.1e-16, "particles": 300 * 1.1e-16}


def figures(program):
    lines = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
    return [(name, float(value), float(scale)) for name, value, scale in map(str.split, lines)]


def main(pairs):
    have = set(Path("/proc/cpuinfo").read_text().split())
    run = {}
    for level, program in (pair.split("=", 1) for pair in pairs):
        if missing := NEEDED[level] - have:
            print(f"{level} is left out: this processor lacks {' '.join(sorted(missing))}")
        else:
            run[level] = figures(program)
    first = run.pop("x86-64")
    wrong = 0
    for level, found in run.items():
        assert len(found) == len(first) > 0
        worst = {}
        for (name, value, scale), (_, other, _) in zip(found, first):
            difference = abs(value - other) / scale / TOLERANCE.get(name, 1e-12)  # interfaces: Newton's tolerance
            worst[name] = max(worst.get(name, 0.0), difference)
        wrong += sum(not d <= 1.0 for d in worst.values())
        print(f"{level}: differences, of what is allowed: " + ", ".join(f"{n} {d:.2g}" for n, d in worst.items()))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
