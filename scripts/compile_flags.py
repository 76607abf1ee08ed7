# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""How the build compiles a file, for checks that call the compiler themselves."""

import json
import shlex
from pathlib import Path

REFERENCE = "tests/headers/all_headers.cpp"


def compile_flags(build):
    """Compiler and flags of the build in folder `build`, without source and output, that check syntax only."""
    database = Path(build) / "compile_commands.json"
    if not database.is_file():
        raise SystemExit(f"{database} is missing: configure the build first (cmake --preset release)")
    for entry in json.loads(database.read_text()):
        if entry["file"].endswith(REFERENCE):
            words = shlex.split(entry["command"])
            output = words.index("-o")
            del words[output : output + 2]
            return [w for w in words if w not in ("-c", entry["file"])] + ["-fsyntax-only"]
    raise SystemExit(f"{database} does not tell how {REFERENCE} is compiled: configure with CAMBIUM_BUILD_TESTS=ON")
