# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""The version of the library, from the one place that has it."""

import re
from pathlib import Path

HEADER = Path(__file__).resolve().parent.parent / "include" / "cambium" / "core" / "version.hpp"


def project_version():
    """Such as `0.1.0`."""
    numbers = re.findall(r"^#define CAMBIUM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", HEADER.read_text(), re.MULTILINE)
    return ".".join(numbers)
