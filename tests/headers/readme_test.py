# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""The first program that README.md shows is the one that is compiled and run."""

import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent.parent


class Readme(unittest.TestCase):
    def test_first_program(self):
        shown = re.search(r"```cpp\n(.*?)```", (PROJECT / "README.md").read_text(), re.DOTALL).group(1)
        program = (PROJECT / "examples" / "first_program.cpp").read_text()
        self.assertEqual(shown, program.split("\n", 2)[2])


if __name__ == "__main__":
    unittest.main()
