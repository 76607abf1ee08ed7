# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that draw benchmarks have in common: where charts go, how they look, tables in docs/choosing.md."""

import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHARTS = ROOT / "docs" / "charts"
CHOOSING = ROOT / "docs" / "choosing.md"

# Okabe and Ito's colours, told apart also by the colour-blind.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31", "#999999", "#7B3294"]

KERNEL_LABELS = {
    "M4Prime": "M4' (Λ2,1)", "M6": "M6 (Λ4,2)", "M6TriplePrime": "M6'''", "Lambda22": "Λ2,2", "Lambda44": "Λ4,4",
    "Lambda64": "Λ6,4", "Lambda84": "Λ8,4"
}


def label(kernel):
    return KERNEL_LABELS.get(kernel, kernel)


def table(head, rows):
    """Lines of a Markdown table."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def replace_between(name, lines, path=CHOOSING):
    """Puts lines between `<!-- begin NAME -->` and `<!-- end NAME -->` of a page."""
    text = path.read_text(encoding="utf-8")
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    if text.count(begin) != 1 or text.count(end) != 1:
        raise SystemExit(f"{path} must have one {begin} and one {end}")
    before, rest = text.split(begin)
    after = rest.split(end)[1]
    path.write_text(before + begin + "\n\n" + "\n".join(lines) + "\n\n" + end + after, encoding="utf-8")


def keep(name, raw=None):
    """The numbers of docs/charts/NAME.json, into which those of another file go first if one is named."""
    kept = CHARTS / f"{name}.json"
    data = json.loads(pathlib.Path(raw or kept).read_text(encoding="utf-8"))
    CHARTS.mkdir(parents=True, exist_ok=True)
    kept.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    return data


def dress_panel(panel, title):
    """A panel of error against time of one thread."""
    panel.set_title(title, fontsize=10)
    panel.set_xlabel("time of one thread, s")
    panel.grid(True, which="major", color="#e0e0e0", linewidth=0.6)
    panel.spines[["top", "right"]].set_visible(False)


def save(figure, name):
    """Writes a figure as SVG and PNG; the same data give the same SVG."""
    import matplotlib  # here, as scripts that draw nothing do without

    matplotlib.rcParams["svg.hashsalt"] = name  # names of parts are random without
    CHARTS.mkdir(parents=True, exist_ok=True)
    figure.savefig(CHARTS / f"{name}.svg", bbox_inches="tight", metadata={"Date": None})
    figure.savefig(CHARTS / f"{name}.png", bbox_inches="tight", dpi=140)
    print(f"wrote docs/charts/{name}.svg and .png")
