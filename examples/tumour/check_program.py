# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tumour program as a user would: check_program.py PROGRAM FOLDER

Scenes can be read, the configuration makes the round trip, mistakes are named, and every way in which a run ends leaves
all of its files.
"""

import csv
import json
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
small = ["--n", "32", "--no-page"]


def run(*options, good=True):
    done = subprocess.run([program, *map(str, options)], capture_output=True, text=True, timeout=100)
    assert (done.returncode == 0) == good, (options, done.returncode, done.stdout, done.stderr)
    return done.stdout if good else done.stderr


def rows(out):
    with open(out / "series.csv", newline="") as file:
        return list(csv.DictReader(file))


def grow(name, *options):
    """Report of a run, the files of which are all there."""
    out = folder / name
    run(*options, "--out", out, "--json", folder / f"{name}.json")
    report = json.loads((folder / f"{name}.json").read_text())
    assert report == json.loads((out / "report.json").read_text())
    assert len(rows(out)) == report["steps"] + (0 if "died" in report["ended"] else 1)
    for frame in report["frames"]:
        for file in f"interface_t{frame['name']}.csv", f"fields_t{frame['name']}.vti":
            assert (out / file).stat().st_size > 0, file
    assert not list(out.rglob("*.part"))
    return report


def check_options():
    scenes = [line.split()[0] for line in run("--list").splitlines()]
    wanted = "sphere-relaxation ellipsoid-relaxation macklin-2d no-necrosis domain-size resolution necrosis-0.25 " \
             "necrosis-0.5 necrosis-0.75 amorphous amorphous-necrosis surface-tension-0 surface-tension-2 " \
             "surface-tension-5 zero-outside"
    assert set(wanted.split()) <= set(scenes), scenes
    for scene in scenes:
        said = run("--scene", scene, "--N", 0.3, "--dry-run")
        assert f'scene="{scene}"' in said and "N=0.3" in said, said
        (folder / "options.ini").write_text(said)
        assert run("--config", folder / "options.ini", "--dry-run") == said
    for options, word in [(["--scene", "moon"], "macklin-2d"), (["--shape", "star:2,0.1"], "p_k"),
                          (["--shape", "ellipsoid:0.1,x"], "not a number"), (["--at", "2,1"], "rising"),
                          (["--outside", "vacuum"], "free-space"), (["--n", "-3"], "16"), (["--gamma", "-1"], "gamma"),
                          (["--shape", "cube:1"], "ellipsoid"), (["--dim", "3", "--shape", "star:2,0.1,0"], "plane")]:
        text = run(*options, "--dry-run", good=False)
        assert word in text, (options, text)


def check_ends():
    report = grow("end", *small, "--at", "0.02,0.04")
    assert [frame["t"] for frame in report["frames"]] == [0, 0.02, 0.04], report
    assert abs(float(rows(folder / "end")[-1]["imbalance"])) < 4e-3  # 2.4e-3 here, of the lattice's second order
    report = grow("box", *small, "--box", 6, "--shape", "ellipsoid:0,1.9", "--at", 5)
    assert "reached the box" in report["ended"] and report["frames"][-1]["t"] == report["t"] > 0, report
    report = grow("extinct", *small, "--box", 6, "--shape", "ellipsoid:0,1", "--A", 3, "--gamma", 0.1, "--at", 5)
    assert "died out" in report["ended"] and len(report["frames"]) == 1, report


def check_signal():
    out = folder / "signal"
    child = subprocess.Popen([program, *small, "--at", "50", "--out", str(out)], stdout=subprocess.DEVNULL)
    for _ in range(200):
        time.sleep(0.05)
        if (out / "report.json").exists():
            break
    time.sleep(0.2)
    child.send_signal(signal.SIGTERM)
    assert child.wait(timeout=20) == 0
    report = json.loads((out / "report.json").read_text())
    assert "signal" in report["ended"] and report["frames"][-1]["t"] == report["t"], report


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
check_options()
check_ends()
check_signal()
