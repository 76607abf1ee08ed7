#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the include graph of include/cambium against tests/layering.txt: check_layering.py [PROJECT]"""

import re
import sys
from pathlib import Path

PREFIX = "cambium/"
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
INCLUDE = re.compile(r'^\s*#\s*include\s*(<[^>\n]*>|"[^"\n]*")', re.MULTILINE)


def read_table(text):
    """The sections of layering.txt: {room: rooms it may include}, [(regular expression, place)], {header}."""
    rooms, only, apart, section = {}, [], set(), ""
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        if line in ("[rooms]", "[only]", "[apart]"):
            section = line
            continue
        if section == "[apart]":
            apart.add(line)
            continue
        name, colon, rest = line.rpartition(":")
        if not section or not colon:
            raise SystemExit(f"tests/layering.txt:{number}: cannot read {line!r}")
        if section == "[rooms]":
            rooms[name.strip()] = set(rest.split())
        else:
            only.append((re.compile(name.strip(), re.MULTILINE), rest.strip()))
    return rooms, only, apart


def room_of(header):
    """Room of a header given relative to include/cambium; empty for an umbrella header."""
    return header.split("/")[0] if "/" in header else ""


def find_cycle(graph):
    """A list of nodes that leads from a node back to itself, or an empty one."""
    state, path = {}, []

    def visit(node):
        state[node] = "open"
        path.append(node)
        for target in sorted(graph.get(node, ())):
            if state.get(target) == "open":
                return path[path.index(target) :] + [target]
            if target not in state and (cycle := visit(target)):
                return cycle
        state[node] = "done"
        path.pop()
        return []

    for node in sorted(graph):
        if node not in state and (cycle := visit(node)):
            return cycle
    return []


def reachable(graph, start):
    """All nodes that can be reached from `start`."""
    seen, todo = set(), [start]
    while todo:
        node = todo.pop()
        if node not in seen:
            seen.add(node)
            todo.extend(graph.get(node, ()))
    return seen


def read_includes(headers):
    """Include graph among `headers` (name: text), and complaints about lines that cannot be part of it."""
    graph, complaints = {}, []
    for header, text in headers.items():
        graph[header] = set()
        for included in INCLUDE.findall(text):
            name = included[1:-1]
            if included.startswith('"'):
                complaints.append(f"{header} includes {included}: write #include <{PREFIX}...>")
            elif name.startswith(PREFIX):
                target = name[len(PREFIX) :]
                graph[header].add(target)
                if target not in headers:
                    complaints.append(f"{header} includes {included}, which does not exist")
    return graph, complaints


def check_arrows(graph, rooms):
    """Complaints about arrows between rooms that the table does not allow."""
    complaints = []
    for header, targets in graph.items():
        room = room_of(header)
        if not room:
            continue
        if room not in rooms:
            complaints.append(f"{header}: room {room} is not in tests/layering.txt")
            continue
        for target in sorted(targets):
            below = room_of(target)
            if not below:
                complaints.append(f"{header} includes umbrella header {target}: include the headers it needs")
            elif below != room and below not in rooms[room]:
                complaints.append(f"{header} includes {target}: {room} may not include {below}")
    return complaints


def check_umbrellas(graph, rooms, apart):
    """Complaints about headers that cambium.hpp or the umbrella header of their room does not bring along, or brings
    along although they are to stay apart."""
    absent = sorted(apart - graph.keys())
    complaints = [f"tests/layering.txt: {header} is to stay apart and does not exist" for header in absent]
    brought = reachable(graph, "cambium.hpp").union(*(reachable(graph, f"{room}.hpp") for room in rooms))
    complaints += [f"an umbrella header brings {header}, which is to stay apart" for header in sorted(apart & brought)]
    for room in rooms:
        members = {header for header in graph if room_of(header) == room} - apart
        missing = members - reachable(graph, f"{room}.hpp")
        complaints += [f"{room}.hpp does not bring {header}" for header in sorted(missing)]
    missing = graph.keys() - reachable(graph, "cambium.hpp") - apart
    return complaints + [f"cambium.hpp does not bring {header}" for header in sorted(missing)]


def check_names(headers, only):
    """Complaints about names that belong to one place and are used in another."""
    complaints = []
    for header, text in headers.items():
        code = COMMENT_OR_STRING.sub(lambda match: "\n" * match.group().count("\n"), text)
        for pattern, place in only:
            if any(header == one or (one.endswith("/") and header.startswith(one)) for one in place.split()):
                continue
            for match in pattern.finditer(code):
                line = code.count("\n", 0, match.end()) + 1
                complaints.append(f"{header}:{line}: {match.group().strip()!r} belongs into {place} alone")
    return complaints


def check(headers, table):
    """All complaints about `headers` ({name relative to include/cambium: text}) under the text of the table."""
    rooms, only, apart = read_table(table)
    complaints = [
        f"tests/layering.txt: {room} may include {name}, which is no room"
        for room, names in rooms.items()
        for name in sorted(names - rooms.keys())
    ]
    if cycle := find_cycle(rooms):
        complaints.append("tests/layering.txt: rooms may include each other: " + " -> ".join(cycle))
    graph, unreadable = read_includes(headers)
    complaints += unreadable + check_arrows(graph, rooms)
    if cycle := find_cycle(graph):
        complaints.append("headers include each other: " + " -> ".join(cycle))
    return complaints + check_umbrellas(graph, rooms, apart) + check_names(headers, only)


def main(project):
    include = Path(project) / "include" / "cambium"
    headers = {path.relative_to(include).as_posix(): path.read_text() for path in sorted(include.rglob("*.hpp"))}
    complaints = check(headers, (Path(project) / "tests" / "layering.txt").read_text())
    for complaint in complaints:
        print(complaint)
    print(f"{len(headers)} headers, {len(complaints)} complaints about layering")
    return 1 if complaints or not headers else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent))
