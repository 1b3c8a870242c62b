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
ABI = {"aarch64": "arm64-v8a", "armv7l": "armeabi-v7a", "i686": "x86"}.get(platform.machine(), platform.machine())
OTHER_ABI = "x86_64" if ABI == "arm64-v8a" else "arm64-v8a"

QUICK = ("-J-XX:TieredStopAtLevel=1",)
# Calls that a program may begin with, each twice.
USES = """
import org.spherecloud.*;

class Uses {
  interface Use {
    void use() throws Exception;
  }

  static void say(Use use) {
    try {
      use.use();
      System.out.println("done");
    } catch (Throwable failed) {
      System.out.println(failed.getClass().getSimpleName() + ": " + failed.getMessage());
    }
  }

  public static void main(String[] words) {
    Use[] uses = {LocalizerConfig::new, AlignerConfig::new, Frame::new, Result::new, Rigid::new, Image::new, Prediction::new,
      Hypotheses::new, () -> new FeatureArrays(4), () -> new Aligned(320, 240), () -> SphereMap.of(new byte[8]),
      () -> Conventions.makeWorld(Convention.TUM, 0, 0, 1), () -> Localizer.parameterRange(Parameter.PROBES),
      () -> Image.rowBytes(Format.GRAY8, 4), Spherecloud::version, Spherecloud::extractorId};
    for (Use each : uses) say(each);
    for (Use each : uses) say(each);
  }
}
"""


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

    def test_libraries_of_another_abi_are_refused(self):
        libraries = self.folder / "libraries"
        libraries.mkdir()
        static, shared = libraries / "libspherecloud.a", libraries / "libspherecloud_jni.so"
        words = ("aar", self.folder / "no.aar", self.folder, f"{ABI}={libraries}")
        (self.folder / "Any.class").write_bytes(b"")
        self.refused("there is no", *words)
        shared.write_bytes(Path(JNI_LIBRARY).read_bytes())
        static.write_bytes(b"no archive")
        self.refused("libspherecloud.a is no library of Android", *words)
        static.write_bytes(Path(STATIC_LIBRARY).read_bytes())
        self.refused(f"libspherecloud_jni.so is of {ABI}, not of {OTHER_ABI}; build it with", *words[:3],
                     f"{OTHER_ABI}={libraries}")
        shared.write_bytes(b"\x7fELF" + bytes(14) + bytes({"x86_64": [62, 0]}.get(OTHER_ABI, [183, 0])))
        self.refused(f"libspherecloud.a is of {ABI}, not of {OTHER_ABI}", *words[:3], f"{OTHER_ABI}={libraries}")
        self.refused("Android has no ABI arm64;", *words[:3], f"arm64={libraries}")
        self.assertFalse((self.folder / "no.aar").exists())

    def refused(self, cause, *words):
        run = subprocess.run([sys.executable, "-B", FOLDER / "package.py", *words], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn(cause, run.stderr)
        self.assertNotIn("Traceback", run.stderr)

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

    def uses(self, library):
        """What each use of the binding says that comes first, or later, without a JNI library."""
        (self.folder / "Uses.java").write_text(USES)
        subprocess.run([JAVAC, *QUICK, "-cp", BUILT_JAR, "-d", self.folder, self.folder / "Uses.java"], check=True)
        run = subprocess.run([JAVA, f"-Dspherecloud.jni={library}", "-cp", f"{BUILT_JAR}:{self.folder}", "Uses"],
                             capture_output=True, text=True, check=True)
        return run.stdout.splitlines()

    def test_each_use_explains_a_missing_library(self):
        said = self.uses("/no/such.so")
        self.assertGreater(len(said), 20)
        for line in said:
            self.assertRegex(line, "^UnsatisfiedLinkError: .*/no/such.so.*SPHERECLOUD_JNI")

    def test_the_c_library_is_not_the_jni_library(self):
        for line in self.uses(os.environ["SPHERECLOUD_LIBRARY"]):
            self.assertRegex(line, "^UnsatisfiedLinkError: .*is not the JNI library.*SPHERECLOUD_JNI")


if __name__ == "__main__":
    JAVA, JAVAC, BUILT_JAR, JNI_LIBRARY, STATIC_LIBRARY = sys.argv[1:6]
    unittest.main(argv=sys.argv[:1])
