# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the checks themselves: each must accept a good tree and reject a fabricated bad one."""

import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent
sys.path += [str(PROJECT / "scripts"), str(PROJECT / "tests" / "compile_fail")]

from check_compile_fail import check_source  # noqa: E402
from check_headers_alone import compile_alone  # noqa: E402
from check_layering import check  # noqa: E402
from check_sources_compile import said_of  # noqa: E402
from count_results import count  # noqa: E402
from reference import escaped, insert, read_members, sentence_for  # noqa: E402

TABLE = r"""
# rooms from low to high
[rooms]
low:
left: low
right: low
[only]
\bxsimd\b: left/
\bEigen\b: right/solve.hpp
^\s*#\s*define\b: low/version.hpp
"""

GOOD = {
    "cambium.hpp": "#include <cambium/left.hpp>\n#include <cambium/low.hpp>\n#include <cambium/right.hpp>\n",
    "low.hpp": "#include <cambium/low/a.hpp>\n#include <cambium/low/version.hpp>\n",
    "left.hpp": "#include <cambium/left/b.hpp>\n",
    "right.hpp": "#include <cambium/right/solve.hpp>\n",
    "low/a.hpp": "#pragma once\n#include <vector>\nint a();\n",
    "low/version.hpp": "#define VERSION 1\n",
    "left/b.hpp": "#include <cambium/low/a.hpp>\n#include <xsimd/xsimd.hpp>\n",
    "right/solve.hpp": "#include <cambium/low/a.hpp>\n// as xsimd does\n#include <Eigen/Dense>\n",
}


class Layering(unittest.TestCase):
    def complaints(self, header, line, table=TABLE):
        return check({**GOOD, header: GOOD.get(header, "") + line + "\n"}, table)

    def assert_complains(self, expected, header, line, table=TABLE):
        found = self.complaints(header, line, table)
        self.assertTrue(any(expected in complaint for complaint in found), f"{expected!r} is not in {found}")

    def test_good_tree(self):
        self.assertEqual(check(GOOD, TABLE), [])

    def test_upward_arrow(self):
        self.assert_complains("low may not include left", "low/a.hpp", "#include <cambium/left/b.hpp>")

    def test_rooms_on_a_level(self):
        self.assert_complains("right may not include left", "right/solve.hpp", "#  include <cambium/left/b.hpp>")

    def test_umbrella_inside_a_room(self):
        self.assert_complains("umbrella header low.hpp", "left/b.hpp", "#include <cambium/low.hpp>")

    def test_cycle_of_headers_in_one_room(self):
        tree = {**GOOD, "low/c.hpp": "#include <cambium/low/a.hpp>\n"}
        tree["low/a.hpp"] += "#include <cambium/low/c.hpp>\n"
        self.assertIn("headers include each other: low/a.hpp -> low/c.hpp -> low/a.hpp", check(tree, TABLE))

    def test_cycle_of_rooms_in_the_table(self):
        table = TABLE.replace("low:\n", "low: right\n")
        self.assertIn("tests/layering.txt: rooms may include each other: low -> right -> low", check(GOOD, table))

    def test_unknown_room_in_the_table(self):
        table = TABLE.replace("left: low", "left: low attic")
        self.assertIn("tests/layering.txt: left may include attic, which is no room", check(GOOD, table))

    def test_room_without_a_line_in_the_table(self):
        self.assert_complains("room attic is not in", "attic/d.hpp", "int d();")

    def test_header_that_umbrellas_forget(self):
        self.assert_complains("low.hpp does not bring low/d.hpp", "low/d.hpp", "int d();")
        self.assert_complains("cambium.hpp does not bring low/d.hpp", "low/d.hpp", "int d();")

    def test_header_that_stays_apart(self):
        table = TABLE + "[apart]\nlow/d.hpp\n"
        self.assertEqual(self.complaints("low/d.hpp", "int d();", table), [])
        tree = {**GOOD, "low/d.hpp": "int d();\n", "low.hpp": GOOD["low.hpp"] + "#include <cambium/low/d.hpp>\n"}
        self.assertIn("an umbrella header brings low/d.hpp, which is to stay apart", check(tree, table))
        self.assertIn("tests/layering.txt: low/d.hpp is to stay apart and does not exist", check(GOOD, table))

    def test_missing_header(self):
        self.assert_complains("which does not exist", "left/b.hpp", "#include <cambium/low/z.hpp>")

    def test_quoted_include(self):
        self.assert_complains('includes "b.hpp"', "left/b.hpp", '#include "b.hpp"')

    def test_names_of_other_rooms(self):
        self.assert_complains("low/a.hpp:4: 'xsimd' belongs into left/ alone", "low/a.hpp", "xsimd::batch<double> v;")
        self.assert_complains("'Eigen' belongs into right/solve.hpp alone", "right/e.hpp", "Eigen::VectorXd v;")
        self.assertEqual(self.complaints("low/a.hpp", "/* xsimd */ int b();  // Eigen"), [])

    def test_macro(self):
        self.assert_complains("'#define' belongs into low/version.hpp", "low/a.hpp", "#define CLEVER 1")


class CompilerChecks(unittest.TestCase):
    flags = ["c++", "-std=c++20", "-Wall", "-fsyntax-only"]

    def test_header_alone(self):
        self.assertEqual(compile_alone(self.flags, "cstddef"), "")
        self.assertIn("no_such_header", compile_alone(self.flags, "no_such_header"))

    def test_expected_message(self):
        source = '// expect: kernel .* moments\nstatic_assert(false, "kernel lies about moments");\n'
        self.assertEqual(check_source(self.flags, source), "")

    def test_source_that_compiles(self):
        self.assertIn("compiles", check_source(self.flags, "// expect: anything\nint a;\n"))

    def test_other_message(self):
        source = '// expect: kernel .* moments\nstatic_assert(false, "support");\n'
        self.assertIn("does not say", check_source(self.flags, source))

    def test_first_line(self):
        self.assertIn("first line", check_source(self.flags, "static_assert(false);\n"))

    def test_control(self):
        source = '// expect: wrong\n#ifndef CAMBIUM_CONTROL\nstatic_assert(false, "wrong");\n#endif\n'
        self.assertEqual(check_source(self.flags, source), "")
        source = '// expect: wrong\n#ifdef CAMBIUM_CONTROL\n#endif\nstatic_assert(false, "wrong");\n'
        self.assertIn("control", check_source(self.flags, source))

    def test_source_of_a_build(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, line in (("good", ""), ("bad", "int unused;")):
                (Path(folder) / f"{name}.cpp").write_text(f"#include <omp.h>\nvoid f() {{ {line} }}\n")
            said = [said_of({"directory": folder, "command": f"ccache c++ -Wall -fopenmp -o x.o -c {name}.cpp"}, "g++")
                    for name in ("good", "bad")]
        self.assertEqual(said[0], "")
        self.assertIn("unused", said[1])


class Results(unittest.TestCase):
    def test_count(self):
        text = '<testsuite><testcase status="run"/><testcase status="fail"/><testcase status="notrun"/></testsuite>'
        self.assertEqual(count(text), (1, 2))
        self.assertEqual(count(text, more_failed=1), (1, 3))

    def test_no_tests_at_all(self):
        self.assertEqual(count("<testsuite/>"), (0, 1))


class Reference(unittest.TestCase):
    SAID = read_members("# x\nlo: anywhere\n[core]\nlo, hi: in the room\n[core/box.hpp]\nlo: in the file\noperator+: sums\n")

    def said(self, header, member):
        return sentence_for(self.SAID, header, member)

    def test_the_narrowest_place_counts(self):
        self.assertEqual(self.said("core/box.hpp", "lo (variable) of struct cambium::Box"), "in the file")
        self.assertEqual(self.said("core/vec.hpp", "lo (variable) of struct cambium::Vec"), "in the room")
        self.assertEqual(self.said("time/rk4.hpp", "lo (variable) of class cambium::RK4"), "anywhere")
        self.assertEqual(self.said("core/box.hpp", "operator+(Box a, const Box &b) (friend) of struct cambium::Box"), "sums")

    def test_what_nothing_is_said_of_is_left(self):
        self.assertIsNone(self.said("time/rk4.hpp", "hi (variable) of class cambium::RK4"))
        self.assertIsNone(self.said("core/box.hpp", "operator+=(const Box &b) (function) of struct cambium::Box"))

    def test_comments_stand_above_the_template(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.hpp"
            path.write_text("template <class T>\nrequires(true) struct A {\n  int a;\n  template <class U>\n  int b();\n};\n")
            insert(path, {3: "one", 5: "two"})
            lines = path.read_text().splitlines()
        self.assertEqual((lines[2], lines[3], lines[4], lines[5]), ("/// one", "  int a;", "/// two", "  template <class U>"))

    def test_template_parameters_are_no_tags(self):
        self.assertEqual(escaped("  /// Box<D>"), r"  /// Box\<D>")
        self.assertEqual(escaped("  ///     Box<D> box;"), "  ///     Box<D> box;")


if __name__ == "__main__":
    unittest.main()
