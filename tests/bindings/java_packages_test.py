#!/usr/bin/env python3
"""The jar and the AAR of Java: the same bytes each time, and in them what they should have.

    java_packages_test.py JAVA JAVAC BUILT_JAR JNI_LIBRARY STATIC_LIBRARY
"""
import io
import json
import os
import platform
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent.parent / "bindings" / "java"
ABI = {"x86_64": "x86_64", "aarch64": "arm64-v8a"}.get(platform.machine(), platform.machine())

QUICK = ("-J-XX:TieredStopAtLevel=1",)


def package(*words):
    subprocess.run([sys.executable, "-B", FOLDER / "package.py", *words], check=True)


class Packages(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def classes(self):
        """Compiled anew."""
        classes = self.folder / "classes"
        sources = sorted(path for part in ("main", "generated") for path in (FOLDER / "src" / part / "java").rglob("*.java"))
        subprocess.run([JAVAC, *QUICK, "--release", "11", "-d", classes, *sources], check=True)
        return classes

    def aar(self, name):
        libraries = self.folder / "libraries"
        libraries.mkdir(exist_ok=True)
        for library in (JNI_LIBRARY, STATIC_LIBRARY):
            (libraries / Path(library).name).write_bytes(Path(library).read_bytes())
        classes = self.folder / "built"
        zipfile.ZipFile(BUILT_JAR).extractall(classes)
        package("aar", self.folder / name, classes, f"{ABI}={libraries}")
        return (self.folder / name).read_bytes()

    def test_a_jar_built_twice_is_the_same(self):
        package("jar", self.folder / "again.jar", self.classes())
        self.assertEqual((self.folder / "again.jar").read_bytes(), Path(BUILT_JAR).read_bytes())

    def test_a_jar_has_its_licence_and_its_version(self):
        jar = zipfile.ZipFile(BUILT_JAR)
        self.assertIn("Bundle-License: Apache-2.0", jar.read("META-INF/MANIFEST.MF").decode())
        version = json.loads((FOLDER.parent.parent / "sdk/include/spherecloud/spherecloud.json").read_text())["version"]
        self.assertIn(f"Implementation-Version: {version}\r\n", jar.read("META-INF/MANIFEST.MF").decode())
        self.assertIn(f"<version>{version}</version>", (FOLDER / "pom.xml").read_text())

    def test_an_aar_has_what_gradle_looks_for(self):
        made = self.aar("one.aar")
        self.assertEqual(made, self.aar("two.aar"))
        aar = zipfile.ZipFile(io.BytesIO(made))
        self.assertIsNone(aar.testzip())
        self.assertEqual(aar.read("classes.jar"), Path(BUILT_JAR).read_bytes())
        self.assertEqual(aar.read(f"jni/{ABI}/libspherecloud_jni.so")[:4], b"\x7fELF")
        module = "prefab/modules/spherecloud"
        self.assertEqual(json.loads(aar.read(f"{module}/libs/android.{ABI}/abi.json"))["abi"], ABI)
        self.assertEqual(aar.read(f"{module}/libs/android.{ABI}/libspherecloud.a")[:7], b"!<arch>")
        self.assertIn(f"{module}/include/spherecloud/spherecloud.h", aar.namelist())
        self.assertEqual(json.loads(aar.read("prefab/prefab.json"))["name"], "spherecloud")
        self.assertIn(b'android:minSdkVersion="28"', aar.read("AndroidManifest.xml"))

    def test_nothing_but_java_can_see_into_the_library(self):
        listed = subprocess.run(["nm", "-D", "--defined-only", JNI_LIBRARY], capture_output=True, text=True, check=True).stdout
        names = [line.split()[-1].split("@")[0] for line in listed.splitlines()]
        self.assertEqual([n for n in names if not n.startswith("Java_org_spherecloud_") and n != "JNI_OnLoad"], [])

    def test_a_missing_library_is_explained(self):
        environment = {name: value for name, value in os.environ.items() if name != "SPHERECLOUD_JNI"}
        (self.folder / "Version.java").write_text(
            "class Version { public static void main(String[] w) { System.out.println(org.spherecloud.Spherecloud.version()); } }")
        subprocess.run([JAVAC, *QUICK, "-cp", BUILT_JAR, "-d", self.folder, self.folder / "Version.java"], check=True)
        for option, words in ((f"-Dspherecloud.jni={JNI_LIBRARY}", None), ("-Dspherecloud.jni=/no/such.so", "/no/such.so"),
                              (f"-Djava.library.path={Path(JNI_LIBRARY).parent}", None),
                              ("-Djava.library.path=/nowhere", "/nowhere")):
            run = subprocess.run([JAVA, option, "-cp", f"{BUILT_JAR}:{self.folder}", "Version"], env=environment,
                                 capture_output=True, text=True)
            self.assertEqual(run.returncode == 0, words is None, run.stderr)
            self.assertIn(words or "", run.stderr)
            if words:
                self.assertIn("SPHERECLOUD_JNI", run.stderr)


if __name__ == "__main__":
    JAVA, JAVAC, BUILT_JAR, JNI_LIBRARY, STATIC_LIBRARY = sys.argv[1:6]
    unittest.main(argv=sys.argv[:1])
