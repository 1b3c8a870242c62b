#!/usr/bin/env python3
"""The scripts of the first pose refuse what they cannot do before they install or build anything, and name the cure."""
import pathlib
import re
import subprocess
import unittest

HERE = pathlib.Path(__file__).resolve().parent
FIRST_POSE = HERE.parents[1] / "bindings" / "first_pose.sh"
IN_BARE_ROOT = HERE / "first_pose_in_bare_root.sh"
LANGUAGES = ["c", "python", "rust", "java", "csharp"]


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60, stdin=subprocess.DEVNULL)


class FirstPose(unittest.TestCase):
    def refused(self, command, cause):
        done = run(*command)
        self.assertEqual((done.returncode, done.stdout), (2, ""), command)
        self.assertIn(cause, done.stderr)
        for language in LANGUAGES:
            self.assertRegex(done.stderr, rf"\b{language}\b")

    def test_wants_one_language(self):
        self.refused([FIRST_POSE], "there are 0 words")
        self.refused([FIRST_POSE, "c", "python"], "there are 2 words")

    def test_knows_its_languages(self):
        for word in ("perl", "", "C", "--fast"):
            self.refused([FIRST_POSE, word], f'there is no language "{word}"')
            self.refused([IN_BARE_ROOT, word], f'there is no language "{word}"')
        self.refused([IN_BARE_ROOT, "c", "perl"], 'there is no language "perl"')

    def test_helps(self):
        done = run(FIRST_POSE, "--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("first_pose.sh LANGUAGE"), done.stdout)

    def test_all_are_all(self):
        said = re.search(r'^all="(.*)"$', IN_BARE_ROOT.read_text(encoding="utf-8"), re.MULTILINE).group(1)
        self.assertEqual(said.split(), LANGUAGES)


if __name__ == "__main__":
    unittest.main()
