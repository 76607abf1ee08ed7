#!/usr/bin/python3
# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints `N passed, N failed` for the results of ctest --output-junit: count_results.py FILE [MORE_FAILED]

MORE_FAILED (0 or 1) counts a step outside ctest, such as a build that failed. A run without any test has failed.
"""

import sys
import xml.etree.ElementTree as ElementTree


def count(text, more_failed=0):
    """(passed, failed) in the text of a JUnit file; tests that did not run have failed."""
    cases = list(ElementTree.fromstring(text).iter("testcase"))
    passed = sum(case.get("status") == "run" for case in cases)
    return passed, len(cases) - passed + more_failed + (1 if not cases else 0)


def main(path, more_failed="0"):
    try:
        with open(path, encoding="utf-8") as file:
            passed, failed = count(file.read(), int(more_failed))
    except (OSError, ElementTree.ParseError) as error:
        print(f"no results of tests: {error}")
        passed, failed = 0, 1
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
