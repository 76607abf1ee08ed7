#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every source of a build, without warnings, with another compiler: check_sources_compile.py BUILD COMPILER [JOBS]"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def openmp():
    """The folder of clang++'s omp.h, to be looked at last: Debian has that of one version of clang at a time."""
    asked = [shutil.which("clang++") or "g++", "-print-file-name=include"]
    return ["-idirafter", subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()]


def said_of(entry, compiler):
    """What `compiler` says of the source of an entry of compile_commands.json; empty if nothing."""
    words = shlex.split(entry["command"])
    first = next(i for i, word in enumerate(words) if re.search(r"\+\+(-\d+)?$", word))  # after ccache, if it is there
    flags = [word for i, word in enumerate(words) if i > first and "-o" not in (word, words[i - 1])]
    command = [compiler, *flags, *openmp(), "-fsyntax-only"]
    run = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True, check=False)
    return run.stderr or ("" if run.returncode == 0 else f"exit status {run.returncode}\n")


def main(build, compiler, jobs=os.cpu_count()):
    entries = json.loads((Path(build) / "compile_commands.json").read_text())
    failed = 0
    with ThreadPoolExecutor(int(jobs)) as pool:
        for entry, said in zip(entries, pool.map(lambda entry: said_of(entry, compiler), entries)):
            failed += bool(said)
            print(f"{entry['file']}:\n{said}" if said else "", end="", flush=True)
    print(f"{len(entries) - failed} of {len(entries)} sources compile without warnings with {compiler}")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
