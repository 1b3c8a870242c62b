#!/usr/bin/env python3
"""write_exports.py puts each function into the node of the release that brought it, and loses none."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "toolchains"))
import write_exports  # noqa: E402 (its folder is named above)


def header(version, abi, functions):
    """Comments and line ends as clang-format makes them."""
    numbers = zip(("MAJOR", "MINOR", "PATCH"), version.split("."))
    return ("".join(f"#define SPHC_VERSION_{part} {number}\n" for part, number in numbers) + f"#define SPHC_ABI \\\n  {abi}u /* . */\n"
            + "/* SPHC_API void sphc_in_a_comment(void); */\n"
            + "".join(f"SPHC_API const char *{name}(int32_t a,\n                     int32_t b);\n" for name in functions))


class Exports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "sdk" / "runtime").mkdir(parents=True)

    def write(self, path, text):
        (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / path).write_text(text, encoding="utf-8")

    def today(self, version, abi, functions):
        self.write("sdk/include/spherecloud/spherecloud.h", header(version, abi, functions))
        self.write("sdk/include/spherecloud/spherecloud_capture.h", "SPHC_API void sphc_pairer_x(void);\n")

    def kept(self, version, abi, functions):
        self.write(f"kept/{version}/spherecloud/spherecloud.h", header(version, abi, functions))

    def nodes(self):
        return {name: sorted(names) for name, names in write_exports.nodes_of(self.folder / "sdk", self.folder / "kept")}

    def run_it(self, *arguments):
        return subprocess.run([sys.executable, ROOT / "toolchains" / "write_exports.py", "--sdk", self.folder / "sdk", "--kept",
                               self.folder / "kept", *arguments], capture_output=True, text=True)

    def test_before_abi_1_there_is_one_node(self):
        self.kept("0.2.0", 0, ["sphc_a"])
        self.today("0.3.0", 0, ["sphc_a", "sphc_b"])
        self.assertEqual(self.nodes(), {"SPHERECLOUD_0": ["sphc_a", "sphc_b"], "SPHERECLOUD_UNSTABLE_0.3": ["sphc_pairer_x"]})

    def test_from_abi_1_on_a_release_has_a_node(self):
        self.kept("0.2.0", 0, ["sphc_a", "sphc_old"])
        self.kept("1.0.0", 1, ["sphc_a"])
        self.kept("1.2.0", 1, ["sphc_a", "sphc_b"])
        self.kept("1.10.0", 1, ["sphc_a", "sphc_b", "sphc_c"])
        self.today("1.11.0", 1, ["sphc_a", "sphc_b", "sphc_c", "sphc_d"])
        self.assertEqual(self.nodes(), {"SPHERECLOUD_1.0": ["sphc_a"], "SPHERECLOUD_1.2": ["sphc_b"], "SPHERECLOUD_1.10": ["sphc_c"],
                                        "SPHERECLOUD_1.11": ["sphc_d"], "SPHERECLOUD_UNSTABLE_1.11": ["sphc_pairer_x"]})
        text = write_exports.script(write_exports.nodes_of(self.folder / "sdk", self.folder / "kept"))
        self.assertIn("SPHERECLOUD_1.10 {\n  global:\n    sphc_c;\n} SPHERECLOUD_1.2;\n", text)
        self.assertEqual(text.count("local:"), 1)

    def test_a_release_without_a_function_more_has_no_node(self):
        self.kept("1.0.0", 1, ["sphc_a"])
        self.today("1.1.0", 1, ["sphc_a"])
        self.assertEqual(list(self.nodes()), ["SPHERECLOUD_1.0", "SPHERECLOUD_UNSTABLE_1.1"])

    def test_no_function_is_removed(self):
        self.kept("1.0.0", 1, ["sphc_a", "sphc_b"])
        self.today("1.1.0", 1, ["sphc_a"])
        told = self.run_it()
        self.assertNotEqual(told.returncode, 0)
        self.assertIn("has sphc_b: an export is never removed", told.stderr)

    def test_the_abi_is_the_major_version(self):
        self.today("2.0.0", 1, ["sphc_a"])
        self.assertIn("must be the major version", self.run_it().stderr)

    def test_a_stale_script_is_seen(self):
        self.today("1.0.0", 1, ["sphc_a"])
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.run_it("--check").returncode, 0)
        self.today("1.0.0", 1, ["sphc_a", "sphc_b"])
        self.assertIn("is not that of the headers", self.run_it("--check").stderr)


if __name__ == "__main__":
    unittest.main()
