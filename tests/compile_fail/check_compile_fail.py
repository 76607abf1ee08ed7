#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a source is rejected with the message it expects: check_compile_fail.py BUILD SOURCE

The first line of SOURCE is `// expect: REGULAR EXPRESSION`. It must not compile, and what the compiler says must match.
If SOURCE looks at CAMBIUM_CONTROL, it must compile when that is defined: then it fails for the stated reason alone.
"""

import re
import subprocess
import sys
from pathlib import Path


def check_source(flags, source):
    """What is wrong with the text of a must-fail source; empty if nothing."""

    def compile_it(*more):
        command = [*flags, *more, "-x", "c++", "-"]
        return subprocess.run(command, input=source, capture_output=True, text=True, check=False)

    first = re.match(r"// expect: (.+)\n", source)
    if not first:
        return "its first line must be `// expect: REGULAR EXPRESSION`"
    run = compile_it()
    if run.returncode == 0:
        return "it compiles but must be rejected"
    if not re.search(first.group(1), run.stderr):
        return f"the compiler does not say {first.group(1)!r} but:\n{run.stderr}"
    if "CAMBIUM_CONTROL" in source and (control := compile_it("-DCAMBIUM_CONTROL")).returncode != 0:
        return f"the control (with CAMBIUM_CONTROL defined) must compile, but the compiler says:\n{control.stderr}"
    return ""


def main(build, source):
    tests = Path(__file__).resolve().parent.parent
    sys.path.append(str(tests.parent / "scripts"))
    from compile_flags import compile_flags

    if complaint := check_source([*compile_flags(build), f"-I{tests}"], Path(source).read_text()):
        print(f"{source}: {complaint}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
