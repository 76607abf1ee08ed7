# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the Debian package, checks what it declares, unpacks it and compiles a program with pkg-config alone.

deb.py CPACK BUILD COMPILER FOLDER OPENMP
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
sys.path.insert(0, str(PROJECT / "scripts"))

from project_version import project_version  # noqa: E402


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout.strip()


def check_fields(package, openmp):
    """Every library whose headers are included is declared, and what is declared is what this machine builds with."""
    field = lambda name: output("dpkg-deb", "--field", str(package), name)  # noqa: E731
    assert field("Package") == "libcambium-dev", field("Package")
    assert field("Version") == project_version(), field("Version")
    assert field("Architecture") == "all", field("Architecture")
    depends = field("Depends")
    for library in ("libeigen3-dev", "libxsimd-dev", "libfftw3-dev"):
        assert library in depends, f"{library} is not among {depends}"
    assert ("g++" in depends) == openmp, depends
    # What apt would do, without doing it: fails where what is declared is not to be had.
    if shutil.which("apt-get"):
        output("apt-get", "install", "--simulate", "-qq", str(package.resolve()))


def compile_with_pkg_config(compiler, prefix, folder):
    search = {**os.environ, "PKG_CONFIG_PATH": str(prefix / "share" / "pkgconfig")}
    assert output("pkg-config", "--modversion", "cambium", env=search) == project_version()
    flags = output("pkg-config", "--cflags", "--libs", "cambium", env=search).split()
    assert any(Path(f[2:]).resolve() == prefix / "include" for f in flags if f.startswith("-I")), flags
    program = folder / "program"
    source = HERE / "plain" / "program.cpp"
    subprocess.run([compiler, "-std=c++20", str(source), *flags, "-o", str(program)], check=True)
    print(output(str(program)))


def main(cpack, build, compiler, folder, openmp):
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    output(cpack, "-G", "DEB", "--config", str(Path(build) / "CPackConfig.cmake"), "-B", str(folder))
    (package,) = folder.glob("*.deb")
    check_fields(package, openmp in ("ON", "1", "TRUE"))
    output("dpkg-deb", "--extract", str(package), str(folder / "root"))
    prefix = (folder / "root" / "usr").resolve()
    headers = {p.relative_to(prefix / "include") for p in (prefix / "include").rglob("*.*")}
    expected = {p.relative_to(PROJECT / "include") for p in (PROJECT / "include").rglob("*.hpp")}
    assert headers == expected, headers ^ expected
    compile_with_pkg_config(compiler, prefix, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
