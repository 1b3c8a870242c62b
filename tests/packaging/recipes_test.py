#!/usr/bin/env python3
"""The recipes of packaging/ configure this tree as they say, and name its version and its files."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "packaging"

# Ninja that builds nothing: it says whether it could, and makes a program and a seed as the script expects them.
NINJA = """#!/bin/sh
[ "$1" = -C ] || exec "{ninja}" "$@"
"{ninja}" -n "$@" || exit 1
mkdir -p "$2/tests/fuzz/seeds/map" && touch "$2/tests/fuzz/fuzz_map" "$2/tests/fuzz/seeds/map/seed"
"""


def program(path, text):
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


class Recipes(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="a recipe ")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

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
