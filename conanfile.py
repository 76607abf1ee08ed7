# SPDX-FileCopyrightText: The Cambium authors
# SPDX-License-Identifier: BSD-3-Clause
"""Recipe for Conan 2: conan create ."""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy
from conan.tools.layout import basic_layout


class Cambium(ConanFile):
    name = "cambium"
    description = "Remeshed particle methods in C++20"
    license = "BSD-3-Clause"
    topics = ("particle-methods", "level-set", "header-only")
    package_type = "header-library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"openmp": [True, False]}
    default_options = {"openmp": True, "fftw/*:precision_double": True, "fftw/*:precision_single": True}
    exports_sources = "include/*", "LICENSE"
    no_copy_source = True

    def set_version(self):
        header = Path(self.recipe_folder) / "include" / "cambium" / "core" / "version.hpp"
        self.version = ".".join(re.findall(r"^#define CAMBIUM_VERSION_\w+ (\d+)$", header.read_text(), re.MULTILINE))

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("xsimd/9.0.1", transitive_headers=True)
        self.requires("fftw/3.3.10", transitive_headers=True, transitive_libs=True)

    def layout(self):
        basic_layout(self)

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder) / "licenses"))
        copy(self, "*.hpp", str(Path(self.source_folder) / "include"), str(Path(self.package_folder) / "include"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "cambium")
        self.cpp_info.set_property("cmake_target_name", "cambium::cambium")
        self.cpp_info.set_property("pkg_config_name", "cambium")
        if self.options.openmp:
            self.cpp_info.cxxflags = ["-fopenmp"]
            self.cpp_info.exelinkflags = self.cpp_info.sharedlinkflags = ["-fopenmp"]
