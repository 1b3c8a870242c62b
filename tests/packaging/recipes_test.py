#!/usr/bin/env python3
"""The recipes of packaging/ configure this tree as they say, and name its version and its files."""
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "packaging"

# Ninja that builds nothing: it says whether it could, and makes a program and a seed as the script expects them.
NINJA = """#!/bin/sh
[ "$1" = -C ] || exec "{ninja}" "$@"
"{ninja}" -n "$@" || exit 1
mkdir -p "$2/tests/fuzz/seeds/map" && touch "$2/tests/fuzz/fuzz_map" "$2/tests/fuzz/seeds/map/seed"
"""


# What the recipe of Conan takes from it.
OF_CONAN = {"conan": ("ConanFile",), "conan.tools": (), "conan.tools.build": ("check_min_cppstd",),
            "conan.tools.cmake": ("CMake", "CMakeDeps", "CMakeToolchain", "cmake_layout"), "conan.tools.files": ("copy", "load")}


def conan_recipe(cmake_lists):
    """An instance of the recipe, without Conan, which reads that text."""
    stand_ins = {name: types.SimpleNamespace(**dict.fromkeys(has)) for name, has in OF_CONAN.items()}
    stand_ins["conan"].ConanFile = type("ConanFile", (), {"version": None, "recipe_folder": str(PACKAGING / "conan")})
    stand_ins["conan.tools.files"].load = lambda recipe, path: cmake_lists
    spec = importlib.util.spec_from_file_location("conanfile", PACKAGING / "conan" / "conanfile.py")
    module = importlib.util.module_from_spec(spec)
    with unittest.mock.patch.dict(sys.modules, stand_ins):
        spec.loader.exec_module(module)
    return module.SphereCloud()


def program(path, text):
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


class Recipes(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="a recipe ")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def test_a_candidate_is_not_named_as_the_release(self):
        told = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        release = re.search(r"VERSION ([\d.]+) LANGUAGES", told).group(1)
        candidate = re.search(r"set\(SPHC_CANDIDATE ?(\w*)\)", told).group(1)
        recipe, = (PACKAGING / "yocto").rglob("*.bb")
        self.assertEqual(recipe.stem, f"spherecloud_{release}")
        self.assertEqual(re.findall(r'^PV = "(.*)"$', recipe.read_text(encoding="utf-8"), re.MULTILINE),
                         [f"{release}~{candidate}"] if candidate else [])
        port = json.loads((PACKAGING / "vcpkg/spherecloud/vcpkg.json").read_text(encoding="utf-8"))
        self.assertEqual(port["version-semver"], f"{release}-{candidate}" if candidate else release)
        for line, version in (("set(SPHC_CANDIDATE rc3)", "2.0.1-rc3"), ("set(SPHC_CANDIDATE)", "2.0.1"), ('set(SPHC_CANDIDATE "")', "2.0.1")):
            of_conan = conan_recipe(f"project(spherecloud VERSION 2.0.1 LANGUAGES C CXX)\n{line} # of the header\n")
            of_conan.set_version()
            self.assertEqual(of_conan.version, version)

    def test_oss_fuzz_configures_without_google_test(self):
        for name in ("src", "work", "out", "bin"):
            (self.folder / name).mkdir()
        (self.folder / "src" / "spherecloud").symlink_to(ROOT)
        program(self.folder / "bin" / "ninja", NINJA.format(ninja=shutil.which("ninja")))
        program(self.folder / "bin" / "zip", "#!/bin/sh\ntouch \"$2\"\n")
        environment = dict(os.environ, PATH=f"{self.folder / 'bin'}:{os.environ['PATH']}", LIB_FUZZING_ENGINE="-fsanitize=fuzzer",
                           **{name.upper(): str(self.folder / name) for name in ("src", "work", "out")})
        done = subprocess.run([PACKAGING / "oss-fuzz" / "build.sh"], env=environment, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, {"fuzz_map", "fuzz_map_seed_corpus.zip"})


if __name__ == "__main__":
    unittest.main()
