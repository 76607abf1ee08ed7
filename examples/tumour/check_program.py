# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tumour program as a user would: check_program.py PROGRAM FOLDER

Scenes can be read, the configuration makes the round trip, mistakes are named, and every way in which a run ends leaves
all of its files.
"""

import csv
import gzip
import json
import random
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

from same_run import check_same, report_of

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
    assert abs(float(rows(folder / "end")[-1]["imbalance"])) < 4e-3  # 1.0e-3 here
    for outside, area in ("free-space", 35.1560), ("zero", 36.1939):  # of the true interfaces
        report = grow(outside, "--n", 64, "--no-page", "--outside", outside, "--at", 1)
        assert abs(report["frames"][-1]["volume"] / area - 1) < 1e-3, report  # 3.0e-4 and -5.7e-4 here
    report = grow("box", *small, "--box", 6, "--shape", "ellipsoid:0,1.9", "--at", 5)
    assert "reached the box" in report["ended"] and report["frames"][-1]["t"] == report["t"] > 0, report
    report = grow("extinct", *small, "--box", 6, "--shape", "ellipsoid:0,1", "--A", 3, "--gamma", 0.1, "--at", 5)
    assert "died out" in report["ended"] and len(report["frames"]) == 1, report
    for name, times in ("box", 9), ("extinct", 9), ("extinct", 1e-3):  # what is over stays so, and says so again
        before, series = report_of(folder / name), (folder / name / "series.csv").read_bytes()
        said = run("--resume", folder / name, "--at", times, "--no-page")
        assert before["ended"] in said and report_of(folder / name) == before, (name, said)
        assert (folder / name / "series.csv").read_bytes() == series, name


def check_image():
    """The ball of an image of anisotropic, turned voxels has the volume of the ball that it shows."""
    image = folder / "ball.nrrd"
    run("--dim", 3, "--shape", "ellipsoid:0,1.5", "--box", 4, "--make-image", image)
    whole = image.read_bytes()
    for name, content, word in [("cut", whole[:5000], "bytes"), ("moon", whole.replace(b"uint8", b"block"), "type"),
                                ("huge", whole.replace(b"sizes: ", b"sizes: 9"), "bytes")]:
        (folder / f"{name}.nrrd").write_bytes(content)
        assert word in run("--dim", 3, "--shape", folder / f"{name}.nrrd", "--dry-run", good=False)
    head, voxels = whole.replace(b"raw", b"gzip").split(b"\n\n", 1)
    packed = folder / "packed.nrrd"
    packed.write_bytes(head + b"\n\n" + gzip.compress(voxels)[:-20])
    assert "gzip" in run("--dim", 3, "--shape", packed, "--dry-run", good=False)
    packed.write_bytes(head + b"\n\n" + gzip.compress(voxels))
    assert "it has: 0 1" in run("--dim", 3, "--shape", f"{image},2,1", "--dry-run", good=False)
    out = folder / "image"
    run("--dim", 3, "--n", 24, "--box", 6, "--shape", f"{packed},1,1", "--at", 1e-4, "--no-page", "--out", out)
    volume = float(rows(out)[0]["volume"])
    assert abs(volume / (4 / 3 * 3.14159265 * 1.5**3) - 1) < 0.01, volume
    run("--dim", 3, "--shape", "ellipsoid:0,1.5", "--box", 4, "--make-image", folder / "ball.vti")
    run("--dim", 3, "--n", 24, "--box", 6, "--shape", folder / "ball.vti", "--at", 1e-4, "--no-page", "--out", folder / "vti")
    assert abs(float(rows(folder / "vti")[0]["volume"]) / volume - 1) < 1e-12  # axes are written as numbers times a norm
    (folder / "cut.vti").write_bytes((folder / "ball.vti").read_bytes()[:900])
    assert "VTK library" in run("--dim", 3, "--shape", folder / "cut.vti", "--dry-run", good=False)


def volume_of(obj):
    """Inside the triangles of an OBJ file."""
    lines = [line.split() for line in obj.read_text().splitlines()]
    points = [[float(x) for x in line[1:]] for line in lines if line[0] == "v"]
    total = 0
    for line in lines:
        if line[0] == "f":
            (a, b, c), (d, e, f), (g, h, i) = (points[int(k) - 1] for k in line[1:])
            total += (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)) / 6
    return total


def check_mesh():
    """A mesh of a ball, scaled, has the volume of its facets; what is no closed mesh is named."""
    ball = ["--dim", 3, "--n", 24, "--box", 6]
    for ending in "stl", "ply", "obj":
        run(*ball, "--shape", "ellipsoid:0,1.5", "--make-image", folder / f"ball.{ending}")
    out = folder / "mesh"
    run(*ball, "--shape", f"{folder / 'ball.ply'},0.9", "--at", 1e-4, "--no-page", "--out", out)
    volume = float(rows(out)[0]["volume"])
    assert abs(volume / (4 / 3 * 3.14159265 * 1.35**3) - 1) < 0.02, volume  # 1.1% here, of the facets
    text = (folder / "ball.obj").read_text().splitlines()
    faces = [line.split()[1:] for line in text if line.startswith("f")]
    points = [line.split()[1:] for line in text if line.startswith("v")]
    fine = folder / "fine.obj"
    run("--dim", 3, "--n", 48, "--box", 6, "--shape", "ellipsoid:0,1.5", "--make-image", fine)
    errors = [volume_of(file) / (4 / 3 * 3.14159265 * 1.5**3) - 1 for file in (folder / "ball.obj", fine)]
    assert abs(errors[1]) < 0.3 * abs(errors[0]) < 0.3 * 0.02, errors  # of second order: a quarter
    solid = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {' '.join(points[int(k) - 1])}\n" for k in f) +
                    "endloop\nendfacet\n" for f in faces)
    turned = text[:-1] + ["f " + " ".join(reversed(faces[-1]))]
    inside_out = [line if line.startswith("v") else "f " + " ".join(reversed(line.split()[1:])) for line in text]
    good = f"solid ball\n{solid}endsolid ball\n"
    ply = (folder / "ball.ply").read_bytes()
    for name, content, word in [
            ("good.stl", good, ""), ("cut.stl", f"solid ball\n{solid}", "endsolid"),
            ("four.stl", good.replace("endloop", "vertex 0 0 0\nendloop", 1), "loop of 4 vertices"),
            ("two.stl", good.replace("vertex", "vertex x", 1), "without three numbers"),
            ("loop.stl", "endfacet".join(good.rsplit("endloop\nendfacet", 1)), "without endloop"),
            ("turned.obj", "\n".join(turned), "same way round"), ("inside.obj", "\n".join(inside_out), "inside out"),
            ("big.ply", ply.replace(b"little", b"big", 1), "binary_big_endian"),
            ("open.obj", "\n".join(text[:-1]), "not closed"), ("far.obj", "v 0 0 0\nf 1 2 3\n", "vertex 1 of 1"),
            ("moon.ply", "ply\nformat cheese 1.0\nend_header\n", "cheese"), ("none.obj", "v 0 0 0\n", "no triangle"),
            ("cut.ply", ply[:-7], "cut off"), ("short.stl", b"x" * 134, "no STL")]:
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        said = run("--dim", 3, "--shape", folder / name, "--dry-run", good=not word)
        assert word in said, (name, said)
    for name in "ball.stl", "ball.ply", "ball.obj":
        run("--dim", 3, "--shape", folder / name, "--dry-run")


def check_signal():
    out = folder / "signal"
    child = subprocess.Popen([program, *small, "--G", "0", "--at", "5000", "--out", str(out)], stdout=subprocess.DEVNULL)
    for _ in range(200):
        time.sleep(0.05)
        if (out / "report.json").exists():
            break
    time.sleep(0.2)
    child.send_signal(signal.SIGTERM)
    assert child.wait(timeout=20) == 0
    report = json.loads((out / "report.json").read_text())
    assert "signal" in report["ended"] and report["frames"][-1]["t"] == report["t"], report


def check_resume():
    """Runs that are killed at any moment go on as if nothing had been; damaged checkpoints are refused."""
    for outside in "free-space", "zero":
        options = [*small, "--shape", "ellipsoid:0.1,1.9", "--outside", outside, "--N", "0.3", "--at", "0.1,0.2,0.3"]
        whole, out = folder / f"whole-{outside}", folder / f"killed-{outside}"
        run(*options, "--out", whole)
        command = [program, *options, "--checkpoint", "0", "--out", str(out)]
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        while not (out / "checkpoint.h5").exists():
            time.sleep(0.01)
        for wait in 0.0, random.uniform(0.0, 0.2), random.uniform(0.0, 0.2):
            time.sleep(wait)
            child.kill()
            child.wait()
            command = [program, "--resume", str(out), "--no-page"]
            child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        assert child.wait(timeout=60) == 0
        check_same(out, whole)
    before = report_of(whole)
    run("--resume", whole, "--at", "0.3,0.32", "--no-page")
    assert [frame["t"] for frame in report_of(whole)["frames"]] == [0, 0.1, 0.2, 0.3, 0.32]
    assert report_of(whole)["frames"][:-1] == before["frames"]


def check_checkpoint():
    out = folder / "killed-zero"
    file, good = out / "checkpoint.h5", (out / "checkpoint.h5").read_bytes()
    for content in good[:-5000], b"", b"x" * 9999:
        (folder / "bad.h5").write_bytes(content)
        assert "cut off" in run("--resume", folder / "bad.h5", good=False), len(content)
    at = good.index(b"version")
    at = good.rindex(struct.pack("<q", 1), at, at + 120)
    newer = good[:at] + struct.pack("<q", 2) + good[at + 8:-10]
    (folder / "newer.h5").write_bytes(newer + b"crc32:" + struct.pack("<I", zlib.crc32(newer)))
    assert "is of version 2" in run("--resume", folder / "newer.h5", good=False)
    for place in random.sample(range(len(good)), 20):
        flipped = bytearray(good)
        flipped[place] ^= 1 << random.randrange(8)
        (folder / "flipped.h5").write_bytes(flipped)
        done = subprocess.run([program, "--resume", str(folder / "flipped.h5"), "--dry-run"], capture_output=True)
        assert done.returncode == 1 and b"damaged" in done.stderr, done
    assert "other options" in run("--resume", out, "--gamma", 2, good=False)
    assert "no checkpoint" in run("--resume", folder / "nowhere", good=False)
    full = f"ulimit -f 8; exec {program} --resume {out} --at 0.3,0.35 --no-page"
    done = subprocess.run(["bash", "-c", full], capture_output=True, text=True)
    assert done.returncode == 1 and "File too large" in done.stderr, done
    assert file.read_bytes() == good
    assert "cannot" in run(*small, "--out", "/proc/nothing", good=False)


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
check_options()
check_ends()
check_image()
check_mesh()
check_resume()
check_checkpoint()
check_signal()
