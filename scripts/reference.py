#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference with Doxygen; fails if a public name is left without a word or Doxygen warns: reference.py FOLDER

What a concept asks of all its models is said once, in docs/members.txt, not at every model. Doxygen reads the headers twice:
first to find what has no comment, then copies of them in FOLDER/source, with what docs/members.txt says above these lines.
"""

import collections
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from project_version import project_version

PROJECT = Path(__file__).resolve().parent.parent
UNDOCUMENTED = re.compile(r"(\S+?):(\d+): warning: (?:Member|Compound) (.*) is not documented\.$")


def read_members(text):
    """{(place, name): sentence} of lines `name, other name: sentence` under headings `[place]`."""
    said, place = {}, ""
    for line in text.splitlines():
        if heading := re.match(r"\[(.*)\]$", line):
            place = heading.group(1)
        elif line and not line.startswith("#"):
            names, _, sentence = line.partition(": ")
            said.update({(place, name): sentence for name in names.split(", ")})
    return said


def declared_name(member):
    """The last name of what a warning calls `cambium::A< B >::name(arguments) const (function) of class ...`."""
    operator = re.search(r"operator\s*(\(\)|\[\]|[^\s\w(]+)", member)
    if operator:
        return "operator" + operator.group(1)
    return re.match(r"[\w~]+", re.sub(r"<[^<>]*>", "", re.sub(r"<[^<>]*>", "", member)).split("(")[0].split("::")[-1]).group()


def is_constructor(member, name):
    return bool(re.search(rf"\(function\) of (class|struct) \S*\b{re.escape(name)}\b", member))


def sentence_for(said, header, member):
    """What docs/members.txt says of a member of a header such as `core/box.hpp`: by file, by room, anywhere."""
    name = declared_name(member)
    names = [name, "constructor"] if is_constructor(member, name) else [name]
    places = [header, header.split("/")[0], ""]
    return next((said[key] for n in names for place in places if (key := (place, n)) in said), None)


def doxygen(output, headers):
    names = {"CAMBIUM_VERSION": project_version(), "CAMBIUM_DOCS": str(output), "CAMBIUM_HEADERS": str(headers)}
    run = subprocess.run(
        ["doxygen", "Doxyfile"], cwd=PROJECT, env={**os.environ, **names}, capture_output=True, text=True, check=False
    )
    if run.returncode != 0:
        raise SystemExit(run.stderr)
    return run.stderr.splitlines()


def escaped(line):
    """A comment in which Doxygen does not take template parameters for tags; examples, indented more, are left alone."""
    return re.sub(r"<(?=[A-Za-z])", r"\\<", line) if re.match(r"\s*/// {0,4}\S[^`]*$", line) else line


def follows_another(warning):
    """True if the member is declared on a line behind another one, as in `double a, b;`: one comment holds for both."""
    if not (found := UNDOCUMENTED.match(warning)):
        return False
    line = Path(found.group(1)).read_text().splitlines()[int(found.group(2)) - 1]
    return bool(re.search(rf",\s*{re.escape(declared_name(found.group(3)))}\b", line))


def insert(path, sentences):
    """Writes {line: sentence} as comments above the declarations at these lines, above their `template` lines, too."""
    lines = path.read_text().splitlines()
    for number in sorted(sentences, reverse=True):
        at = number - 1
        while re.match(r"\s*(template|requires)\b[^{]*$", lines[at - 1]):
            at -= 1
        lines.insert(at, f"/// {sentences[number]}")
    path.write_text("\n".join(map(escaped, lines)) + "\n")


def main(folder):
    folder = Path(folder).resolve()
    source = folder / "source"
    for made_before in (source, folder / "html"):
        shutil.rmtree(made_before, ignore_errors=True)
    shutil.copytree(PROJECT / "include", source)
    said = read_members((PROJECT / "docs" / "members.txt").read_text())
    comments = collections.defaultdict(dict)
    for warning in doxygen(folder, PROJECT / "include"):
        if found := UNDOCUMENTED.match(warning):
            header = Path(found.group(1)).relative_to(PROJECT / "include")
            if sentence := sentence_for(said, header.relative_to("cambium").as_posix(), found.group(3)):
                comments[header][int(found.group(2))] = sentence
    for header in source.rglob("*.hpp"):
        insert(header, comments[header.relative_to(source)])
    left = [w for w in doxygen(folder, source) if not follows_another(w)]
    print("\n".join(left))
    print(f"{sum(map(len, comments.values()))} members from docs/members.txt, {len(left)} warnings; {folder}/html/index.html")
    return 1 if left else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
