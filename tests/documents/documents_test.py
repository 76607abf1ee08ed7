# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""What README, docs and CONTRIBUTING say of the repository holds: paths, commands, options, programs."""

import json
import re
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
sys.path.insert(0, str(HERE))

from snippets import PAGES, blocks, programs  # noqa: E402

FOLDERS = r"(?:scripts|docs|bench|examples|tests|include|cmake|\.ci)"


def text(page):
    return page.read_text()


def commands():
    """(page, line) of all shell commands: ```sh blocks, and words in backticks that begin as commands do."""
    found = []
    for page in PAGES:
        for block in blocks(page, "sh"):
            found += [(page, line) for part in block.splitlines() for line in re.split(r"\s&&\s", part.split("  #")[0])]
        found += [(page, c) for c in re.findall(r"`((?:cmake --|scripts/|build/|tumour --)[^`\n]*)`", text(page))]
    return found


def source_of(program):
    """All that the sources of a program say: its options are strings there."""
    folders = {"bench": ["bench", "bench/support"], "examples": ["examples", "bench/support"]}
    kind = "examples" if program == "tumour" or (PROJECT / "examples" / f"{program}.cpp").exists() else "bench"
    files = [PROJECT / kind / f"{program}.cpp", *(PROJECT / kind / program).glob("*")]
    for folder in folders[kind]:
        files += (PROJECT / folder).glob("*.hpp")
    return "".join(file.read_text() for file in files if file.is_file())


class Paths(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in PAGES:
            prose = re.sub(r"```.*?```|<!--.*?-->|`[^`]*`", "", text(page), flags=re.DOTALL)
            for target in re.findall(r"\]\(([^)#]+)[^)]*\)", prose):
                if not target.startswith("http"):
                    self.assertTrue((page.parent / target).exists(), f"{page.name} links to {target}")

    def test_files_that_are_named_exist(self):
        for page in PAGES:
            for name in re.findall(rf"`({FOLDERS}/[\w./*-]+)[`\s]", text(page)):
                there = any(list(PROJECT.glob(n)) for n in (name.rstrip("/"), f"{name}.cpp", f"{name}_test.cpp"))
                self.assertTrue(there, f"{page.name} names {name}")

    def test_tests_that_are_named_exist(self):
        rooms = "|".join(p.name for p in (PROJECT / "tests").iterdir() if p.is_dir())
        for page in PAGES:
            for name in re.findall(rf"`((?:{rooms})/\w+)`", text(page)):
                there = list((PROJECT / "tests").glob(f"{name}*")) or list((PROJECT / "include/cambium").glob(f"{name}*"))
                self.assertTrue(there or (PROJECT / name).is_dir(), f"{page.name} names the test {name}")

    def test_every_picture_is_shown(self):
        pages = "".join(text(page) for page in PAGES)
        for picture in (PROJECT / "docs" / "charts").glob("*.png"):
            self.assertIn(picture.stem + ".", pages, f"no page shows {picture.name}")

    def test_pictures_name_their_programs(self):
        for page in PAGES:
            for section in re.split(r"^##+ ", text(page), flags=re.MULTILINE):
                if picture := re.search(r"!\[[^]]*\]\(([^)]+)\)", section):
                    program = re.search(r"`(?:bench|examples)/\w+[`\s]|scripts/\w+", section)
                    self.assertTrue(program, f"{page.name}: no program is named beside {picture.group(1)}")

    def test_pages_of_concepts_are_reached(self):
        pages = "".join(text(page) for page in PAGES if page.parent.name != "concepts")
        for page in (PROJECT / "docs" / "concepts").glob("*.md"):
            self.assertTrue(f"concepts/{page.name})" in pages, f"no page leads to {page.name}")


class Commands(unittest.TestCase):
    def test_presets(self):
        presets = {p["name"] for p in json.loads((PROJECT / "CMakePresets.json").read_text())["configurePresets"]}
        for page, line in commands():
            for preset in re.findall(r"--preset (\w[\w-]*)", line):
                self.assertIn(preset, presets, f"{page.name}: {line}")

    def test_targets(self):
        for page, line in commands():
            if not (named := re.search(r"--target ([\w ]+)", line)):
                continue
            for target in named.group(1).split():
                kind, _, name = target.partition("_")
                there = target == "docs" or (PROJECT / {"bench": "bench", "example": "examples"}[kind] / f"{name}.cpp").exists()
                self.assertTrue(there, f"{page.name}: {target}")

    def test_programs_have_the_options(self):
        checked = 0
        for page, line in commands():
            run = re.match(r"(?:build/(?:bench|examples)/)?([a-z_]+)((?:\s.*)?\s--.*)", line)
            if not run or not (line.startswith("build/") or line.startswith("tumour")):
                continue
            source = source_of(run.group(1))
            for option in re.findall(r"(--[a-zA-Z][\w-]*)", run.group(2)):
                known = f'{option}"' in source or f"{option}," in source or f",{option}" in source
                self.assertTrue(known or option.startswith("--benchmark_"), f"{page.name}: {line}: {option}")
                checked += 1
        self.assertGreater(checked, 10)

    def test_scripts_are_there(self):
        for page, line in commands():
            for script in re.findall(r"(scripts/\w+(?:\.py)?)(?![\w*])", line):
                self.assertTrue((PROJECT / script).is_file(), f"{page.name}: {line}")

    def test_checks(self):
        script = (PROJECT / "scripts" / "check").read_text()
        for page, line in commands():
            run = re.match(r"scripts/check ([\w ]+)", line)
            for name in run.group(1).split() if run else []:
                self.assertIn(f"\n{name}() {{", script, f"{page.name}: {line}")


class Programs(unittest.TestCase):
    def test_whole_programs_are_examples(self):
        sources = [p.read_text() for p in PROJECT.glob("examples/*.cpp")]
        shown = [block for page in PAGES for block in programs(page)]
        self.assertGreaterEqual(len(shown), 2)
        for block in shown:
            self.assertTrue(any(s.split("\n", 2)[2] == block for s in sources), f"no example is this program:\n{block}")


if __name__ == "__main__":
    unittest.main()
