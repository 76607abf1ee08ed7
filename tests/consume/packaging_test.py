# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""One version wherever one is named, and the recipe for Conan (with a stand-in for Conan: only what the recipe calls)."""

from fnmatch import fnmatch
import importlib.util
import re
import shutil
import sys
import tempfile
import types
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(PROJECT / "scripts"))

from project_version import project_version  # noqa: E402


def stand_in():
    """Modules named as Conan's, with the few functions that the recipe calls."""

    class ConanFile:
        pass

    def copy(_, pattern, source, target):
        # As Conan does: the pattern is that of the whole path from the source on.
        found = [p for p in Path(source).rglob("*") if p.is_file() and fnmatch(p.relative_to(source).as_posix(), pattern)]
        for path in found:
            place = Path(target) / path.relative_to(source)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, place)
        return found

    contents = {
        "conan": {"ConanFile": ConanFile},
        "conan.tools": {},
        "conan.tools.build": {"check_min_cppstd": lambda _, standard: standard},
        "conan.tools.files": {"copy": copy},
        "conan.tools.layout": {"basic_layout": lambda _: None},
    }
    modules = {}
    for name, members in contents.items():
        modules[name] = types.ModuleType(name)
        vars(modules[name]).update(members)
    return modules


def recipe():
    before = {name: sys.modules.get(name) for name in stand_in()}
    sys.modules.update(stand_in())
    try:
        spec = importlib.util.spec_from_file_location("recipe", PROJECT / "conanfile.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    finally:
        for name, old in before.items():
            if old is None:
                del sys.modules[name]
            else:
                sys.modules[name] = old
    made = module.Cambium()
    made.recipe_folder = made.source_folder = str(PROJECT)
    return made


class Version(unittest.TestCase):
    def test_semantic(self):
        self.assertRegex(project_version(), r"^\d+\.\d+\.\d+$")

    def test_changes(self):
        newest = re.search(r"^## (\S+)", (PROJECT / "CHANGELOG.md").read_text(), re.MULTILINE).group(1)
        self.assertEqual(newest, project_version())

    def test_pages_ask_for_this_version(self):
        minor = project_version().rpartition(".")[0]
        pages = [PROJECT / "README.md", *(PROJECT / "docs").rglob("*.md"), *PROJECT.glob("tests/consume/*/CMakeLists.txt")]
        asked = [a for page in pages for a in re.findall(r"find_package\(cambium ([\d.]+)", page.read_text())]
        self.assertTrue(asked)
        self.assertEqual(set(asked), {minor})

    def test_recipe(self):
        made = recipe()
        made.set_version()
        self.assertEqual(made.version, project_version())


class Recipe(unittest.TestCase):
    def test_package_holds_every_header_and_the_licence(self):
        made = recipe()
        with tempfile.TemporaryDirectory() as folder:
            made.package_folder = folder
            made.package()
            packed = {p.relative_to(folder).as_posix() for p in Path(folder).rglob("*") if p.is_file()}
        headers = {p.relative_to(PROJECT).as_posix() for p in (PROJECT / "include").rglob("*.hpp")}
        self.assertEqual(packed, headers | {"licenses/LICENSE"})

    def test_requirements_are_those_of_the_build(self):
        made, asked = recipe(), []
        made.requires = lambda reference, **_: asked.append(reference.split("/"))
        made.requirements()
        least = dict(re.findall(r"find_package\((\w+) ([\d.]+)", (PROJECT / "cmake" / "dependencies.cmake").read_text()))
        least = {"eigen": least["Eigen3"], "fftw": least["FFTW3"], "xsimd": "8.1"}
        number = lambda text: [int(n) for n in text.split(".")]  # noqa: E731
        self.assertEqual({name for name, _ in asked}, set(least))
        for name, taken in asked:
            self.assertGreaterEqual(number(taken), number(least[name]), name)

    def test_target(self):
        made, properties = recipe(), {}
        made.options = types.SimpleNamespace(openmp=True)
        made.cpp_info = types.SimpleNamespace(set_property=properties.__setitem__)
        made.package_info()
        self.assertEqual(properties["cmake_target_name"], "cambium::cambium")
        self.assertEqual(made.cpp_info.cxxflags, ["-fopenmp"])


if __name__ == "__main__":
    unittest.main()
