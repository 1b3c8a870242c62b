"""The runtime as a Conan 2 package, of this tree.

    conan create packaging/conan -o "&:system=True"     Eigen and Highway from the system
    conan create packaging/conan                        from Conan's own packages
"""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

ROOT = os.path.join("..", "..")


class SphereCloud(ConanFile):
    name = "spherecloud"
    description = "Where is the device in a prebuilt map? Relocalization from colour and time-of-flight images"
    license = "Apache-2.0"
    topics = ("localization", "tof", "embedded")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"simd": ["dispatch", "static", "scalar"], "system": [True, False]}
    default_options = {"simd": "static", "system": False}

    def set_version(self):
        told = load(self, os.path.join(self.recipe_folder, ROOT, "CMakeLists.txt"))
        release = re.search(r"VERSION ([\d.]+) LANGUAGES", told).group(1)
        candidate = re.search(r"set\(SPHC_CANDIDATE (\w+)\)", told)
        self.version = self.version or release + (f"-{candidate.group(1)}" if candidate else "")

    def export_sources(self):
        root = os.path.join(self.recipe_folder, ROOT)
        for pattern in ("CMakeLists.txt", "LICENSE", "NOTICE", "sdk/include/*", "sdk/runtime/*", "sdk/signature/*", "sdk/encryption/*", "drivers/raw/*", "examples/*", "CHANGELOG.md",
                        "third_party/*", "toolchains/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def config_options(self):
        if re.match(r"armv([4-7]|8_32)", str(self.settings.arch)):  # which knows single lanes alone
            self.options.simd = "scalar"

    def requirements(self):
        if not self.options.system:
            self.requires("eigen/3.4.0")
            self.requires("highway/1.0.7")

    def validate(self):
        check_min_cppstd(self, 17)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for side in ("HOST", "DRIVERS", "EXAMPLES", "TESTS"):
            toolchain.cache_variables["SPHC_" + side] = False
        toolchain.cache_variables["SPHC_SIMD"] = str(self.options.simd)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The package's own SphereCloudConfig.cmake says what its targets need.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "SphereCloud")]
