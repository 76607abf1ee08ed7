# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles the snippets of the pages, put together to one source, with the flags of a build: snippets.py BUILD

A ```cpp block is a whole program (then it is an example), a part of a file of tests/consume (which compiles it), or a part
of a program of its own: the blocks of a page in their order, within a function, after what a comment `<!-- given: ... -->` says
the reader has. Definitions that begin at the margin are put in front of the function.
"""

import re
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(PROJECT / "scripts"))

from compile_flags import compile_flags  # noqa: E402

PAGES = [PROJECT / n for n in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")] + sorted((PROJECT / "docs").rglob("*.md"))
DEFINITION = re.compile(r"^(?:template <.*>\n)?(?:struct|class) \w+ \{.*?^\};\n|^template <.*?^\};\n", re.MULTILINE | re.DOTALL)


def blocks(page, language):
    """Blocks in a language, and `<!-- given: ... -->` comments for C++, in their order."""
    pattern = rf"```{language}\n(.*?)```" + (r"|<!-- given:(.*?)-->" if language == "cpp" else "")
    return [m.group(m.lastindex) for m in re.finditer(pattern, page.read_text(), re.DOTALL)]


def programs(page):
    return [b for b in blocks(page, "cpp") if "int main()" in b]


def consumed():
    return [p.read_text() for p in (PROJECT / "tests" / "consume").rglob("*.[hc]pp")]


def is_compiled_elsewhere(block, known):
    """True for programs, and for definitions that a file of a consumer has."""
    return "int main()" in block or ("{" in block.strip() and any(block.strip() in text for text in known))


def source(pages):
    known, parts = consumed(), []
    for number, page in enumerate(pages):
        mine = [b for b in blocks(page, "cpp") if not is_compiled_elsewhere(b, known)]
        if not mine:
            continue
        whole = "\n".join(mine)
        front = "".join(DEFINITION.findall(whole))
        body = DEFINITION.sub("", whole)
        name = page.relative_to(PROJECT).as_posix()
        parts.append(f"namespace page_{number} {{  // {name}\nusing namespace cambium;\n{front}\nvoid shown() {{\n{body}\n}}\n}}\n")
    headers = ["cambium", "levelset", "surface", "models/surface_pattern", "models/tumour",
               "interface/dirichlet"]
    standard = ["algorithm", "array", "cmath", "cstdio", "numbers", "span", "tuple", "vector"]
    includes = [f"#include <{s}>\n" for s in standard] + [f"#include <cambium/{h}.hpp>\n" for h in headers]
    return "".join(includes) + "\n" + "\n".join(parts)


def main(build):
    """Syntax and types alone: nothing is run. A page shows names that it does not use, hence no warnings."""
    command = [*compile_flags(build), "-w", "-x", "c++", "-"]
    return subprocess.run(command, input=source(PAGES), text=True, check=False).returncode


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
