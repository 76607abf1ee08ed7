# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether two runs of the tumour program left the same."""

import json


def report_of(out):
    """The report without what the clock says, and where."""
    report = json.loads((out / "report.json").read_text())
    return {name: value for name, value in report.items() if name not in ("seconds", "parts", "options")}


def check_same(out, other):
    """Two runs left the same, to the last bit."""
    assert report_of(out) == report_of(other)
    names = [f"{kind}_t{frame['name']}.{ending}" for frame in report_of(out)["frames"]
             for kind, ending in (("interface", "csv"), ("fields", "vti"))]
    for name in ["series.csv", *names]:
        assert (out / name).read_bytes() == (other / name).read_bytes(), name
