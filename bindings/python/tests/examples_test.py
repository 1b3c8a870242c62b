"""What the pages show works."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

import session
import spherecloud as sphc

PACKAGE = pathlib.Path(__file__).parents[1]


def block(page, begins):
    """The first block of Python that begins so."""
    return re.search(rf"```python\n({begins}.*?)```", page.read_text(encoding="utf-8"), re.DOTALL).group(1)


class Examples(unittest.TestCase):
    def test_first_pose(self):
        example = PACKAGE / "examples" / "first_pose.py"
        said = subprocess.run([sys.executable, "-B", example, session.MAP, session.FOLDER], capture_output=True, text=True, check=True)
        self.assertEqual(len(re.findall(r"^\d+ \(.*\)$", said.stdout, re.MULTILINE)), 9, said)
        self.assertIn("6 FEW_KEYPOINTS", said.stdout)
        told = subprocess.run([sys.executable, "-B", example], capture_output=True, text=True)
        self.assertEqual(told.returncode, 1)
        self.assertIn("first_pose.py MAP.sphc FOLDER", told.stderr)

    def test_pages(self):
        frame, here = session.frame(session.ROWS[0]), os.getcwd()
        names = {"color": frame.color, "depth": frame.depth, "color_time_ns": 1, "depth_time_ns": 1}
        self.addCleanup(os.chdir, here)
        os.chdir(session.FOLDER)
        pages = [PACKAGE / "README.md", PACKAGE.parents[1] / "docs" / "python.md"]
        self.assertEqual(*(block(page, "from spherecloud") for page in pages))
        exec(block(pages[0], "from spherecloud").replace("print(", "("), names)
        self.assertTrue(names["result"].localized)
        exec(block(pages[1], "world_from_map"), {**vars(sphc), **names})


if __name__ == "__main__":
    unittest.main()
