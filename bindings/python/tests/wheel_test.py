"""The wheel: the same bytes each time; it installs without a network, and carries all that it needs."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

HERE = pathlib.Path(__file__).parent
BUILD = HERE.parent / "build_wheel.py"


def run(*command, **variables):
    kept = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "SPHERECLOUD_LIBRARY")}
    done = subprocess.run([str(word) for word in command], env={**kept, **variables}, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def build(out, **variables):
    library = os.environ["SPHERECLOUD_LIBRARY"]
    return pathlib.Path(run(sys.executable, "-B", BUILD, "--out", out, "--library", library, **variables).strip())


def elf(bits, processor):
    return b"\x7fELF" + bytes([bits]) + bytes(13) + processor.to_bytes(2, "little")


def builder():
    spec = importlib.util.spec_from_file_location("build_wheel", BUILD)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_same_bytes(self):
        first, second, later = (build(self.folder / name, SOURCE_DATE_EPOCH=epoch)
                                for name, epoch in (("1", "1700000000"), ("2", "1700000000"), ("3", "1700009999")))
        self.assertEqual(first.read_bytes(), second.read_bytes())
        self.assertNotEqual(first.read_bytes(), later.read_bytes())

    def test_what_no_wheel_can_carry_is_named(self):
        for wrong in (self.folder / "libspherecloud.so", HERE / "session.py"):
            with self.assertRaisesRegex(SystemExit, f"{wrong} cannot go into a wheel .* build it"):
                builder().needed_by(wrong)

    def test_it_plays_the_session(self):
        wheel, environment = build(self.folder), self.folder / "environment"
        self.assertRegex(wheel.name, r"-py3-none-manylinux_2_\d+_")
        run(sys.executable, "-m", "venv", "--without-pip", environment)
        python = environment / "bin" / "python"
        run(sys.executable, "-m", "pip", "--python", python, "install", "--no-index", "--no-deps", wheel)
        golden = os.environ["SPHERECLOUD_GOLDEN"]
        numpy = sysconfig.get_paths()["platlib"]
        said = run(python, "-B", HERE / "session.py", PYTHONPATH=numpy, SPHERECLOUD_GOLDEN=golden).split()
        self.assertEqual([path.startswith(str(environment)) for path in said], [True, True], said)

    def platform(self, *symbols):
        path = self.folder / "library.so"
        path.write_bytes(b"\x7fELF\0" + b"".join(symbol.encode() + b"\0" for symbol in symbols))
        return builder().platform_of([path])

    def test_the_tag_is_of_the_machines_that_have_all_of_it(self):
        self.assertEqual(self.platform("GLIBC_2.2.5", "GLIBC_2.14", "memcpy"), "manylinux_2_17")
        self.assertEqual(self.platform("GLIBC_2.14", "GLIBCXX_3.4.21", "CXXABI_1.3.9"), "manylinux_2_24")
        self.assertEqual(self.platform("GLIBC_2.33", "GLIBCXX_3.4.21"), "manylinux_2_33")
        self.assertEqual(self.platform("GLIBC_2.33", "GLIBCXX_3.4.30", "GCC_3.0"), "manylinux_2_35")
        self.assertEqual(self.platform("CXXABI_1.3.15"), "manylinux_2_39")
        self.assertEqual(self.platform("GLIBC_2.14", "GLIBC_ABI_DT_RELR", "GLIBC_2."), "manylinux_2_36")
        self.assertEqual(self.platform("GLIBC_2.14", "GLIBCXX_3.4.999"), "linux")

    def test_a_command_that_needs_this_machine_is_for_this_machine(self):
        command = self.folder / "spherecloud"
        command.write_bytes(elf(2, 62))
        module = builder()
        module.needed_by = lambda path: [("libspherecloud.so.1", "/lib/libspherecloud.so.1"), ("libavcodec.so.59", "/lib/a")]
        self.assertRegex(module.tag_of([], command), "^py3-none-linux_")
        module.needed_by = lambda path: [("libspherecloud.so.1", "/lib/libspherecloud.so.1")]
        self.assertRegex(module.tag_of([], command), "^py3-none-linux_")
        self.assertRegex(module.tag_of([("libspherecloud.so", command)], command), "^py3-none-manylinux_2_17_")
        self.assertIn("LICENSE.lzfse", module.licenses([], command))
        self.assertNotIn("LICENSE.lzfse", module.licenses([], None))

    def test_the_tag_names_the_machine_of_the_library(self):
        library, module = self.folder / "libspherecloud.so", builder()
        for header, machine in ((elf(1, 3), "i686"), (elf(1, 40), "armv7l"), (elf(2, 62), "x86_64"), (elf(2, 183), "aarch64"),
                                (elf(2, 243), "riscv64")):
            library.write_bytes(header)
            self.assertEqual(module.tag_of([("libspherecloud.so", library)], None), f"py3-none-manylinux_2_17_{machine}")
        for other in elf(1, 62), elf(2, 8), b"", b"\x7fELF":
            library.write_bytes(other)
            with self.assertRaisesRegex(SystemExit, f"{library} is for none of i686, .*; build it"):
                module.tag_of([("libspherecloud.so", library)], None)

    def test_without_a_library_it_is_for_any_machine(self):
        wheel = pathlib.Path(run(sys.executable, "-B", BUILD, "--out", self.folder).strip())
        self.assertTrue(wheel.name.endswith("-py3-none-any.whl"))
        self.assertFalse([name for name in zipfile.ZipFile(wheel).namelist() if ".so" in name])


if __name__ == "__main__":
    unittest.main()
