#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles every header alone, without warnings: check_headers_alone.py BUILD [COMPILER]"""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compile_flags import compile_flags

INCLUDE = Path(__file__).resolve().parent.parent / "include"


def compile_alone(flags, header):
    """What the compiler says of a file that includes `header` alone, twice; empty if nothing."""
    source = f"#include <{header}>\n#include <{header}>\n"
    run = subprocess.run(
        [*flags, "-Werror", "-x", "c++", "-"], input=source, capture_output=True, text=True, check=False
    )
    return "" if run.returncode == 0 else run.stderr or f"exit status {run.returncode}"


def main(build, compiler=None):
    flags = compile_flags(build)
    if compiler:
        flags[0] = compiler
    headers = sorted(path.relative_to(INCLUDE).as_posix() for path in INCLUDE.rglob("*.hpp"))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda header: compile_alone(flags, header), headers))
    failed = [(header, said) for header, said in zip(headers, results) if said]
    for header, said in failed:
        print(f"<{header}> does not compile alone:\n{said}")
    print(f"{len(headers) - len(failed)} of {len(headers)} headers compile alone with {Path(flags[0]).name}")
    return 1 if failed or not headers else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
