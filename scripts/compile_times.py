#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Seconds of processor time that compiling takes, the least of a few tries: compile_times.py [COMPILER] [TRIES]

Umbrella headers alone, the first programs, and the tumour in space with its defaults; with -O0 and with -O2.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
TUMOUR = """#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour.hpp>
int main() {
  const auto lattice = cambium::Lattice<3>::bounded_box(cambium::Box<3>::cube(12.0), 48);
  cambium::Tumour<3> tumour(lattice, cambium::Ball<3>({6.0, 6.0, 6.0}, 2.0));
  tumour.step(0.1);
}
"""


def sources():
    """(name, text) of what is compiled."""
    umbrellas = ["cambium"] + sorted(p.stem for p in (PROJECT / "include/cambium").glob("*.hpp") if p.stem != "cambium")
    for name in umbrellas:
        yield f"<cambium/{name}.hpp>", f"#include <cambium/{name}.hpp>\nint main() {{}}\n"
    for name in ("first_program", "first_interface"):
        yield f"examples/{name}.cpp", (PROJECT / "examples" / f"{name}.cpp").read_text()
    yield "Tumour<3>", TUMOUR


def seconds(compiler, flags, text):
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "program.cpp"
        source.write_text(text)
        eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True).stdout.split()
        before = os.times()
        command = [compiler, "-std=c++20", *flags, f"-I{PROJECT}/include", *eigen, "-c", str(source), "-o", f"{folder}/o"]
        subprocess.run(command, check=True)
        after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main(compiler="g++", tries="2"):
    print(f"| {compiler} | -O0 | -O2 |\n|---|---|---|")
    for name, text in sources():
        least = [min(seconds(compiler, ["-fopenmp", o], text) for _ in range(int(tries))) for o in ("-O0", "-O2")]
        print(f"| `{name}` | {least[0]:.1f} | {least[1]:.1f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
