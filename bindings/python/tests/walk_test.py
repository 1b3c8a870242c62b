"""The notebook, cell by cell, where the command `spherecloud` is in PATH: it simulates a walk, maps it and finds itself."""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import tempfile
import unittest

from examples_test import block

PAGE = pathlib.Path(__file__).parents[3] / "docs" / "python.md"
NOTEBOOK = pathlib.Path(__file__).parents[1] / "examples" / "first_pose.ipynb"
FRAMES = 6


def cells():
    """(source, names of the libraries that it needs) of each cell of code."""
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    return [("".join(cell["source"]), cell["metadata"].get("tags", [])) for cell in notebook["cells"] if cell["cell_type"] == "code"]


class Walk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        cls.names, cls.left_out = {}, []
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            for source, needs in cells():
                if all(map(importlib.util.find_spec, needs)):
                    exec(compile(source, NOTEBOOK.name, "exec"), cls.names)
                else:
                    cls.left_out += needs
        cls.said = said.getvalue()

    def test_every_frame_has_a_pose(self):
        self.assertEqual([pose is not None for pose in self.names["poses"]], [True] * FRAMES)
        self.assertEqual(len(self.said.splitlines()), FRAMES, self.said)

    def test_the_page(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            exec(block(PAGE, "from spherecloud import Localizer, Map, Recording"), {})
        self.assertEqual(said.getvalue().count("Rigid"), 2 * FRAMES)

    def test_the_recording_is_the_walk(self):
        lines = [line.split() for line in pathlib.Path("walk/groundtruth.txt").read_text(encoding="utf-8").splitlines() if line[0] != "#"]
        truth = {round(float(words[0]) * 1e9): [float(number) for number in words[1:]] for words in lines}
        self.assertEqual(len(self.names["recording"]), FRAMES)
        for recorded in self.names["recording"]:
            self.assertIn(recorded.frame.color_time_ns, truth)
            for found, true in zip(recorded.world_from_camera.t_m, truth[recorded.frame.color_time_ns]):
                self.assertAlmostEqual(found, true, places=6)

    def test_only_pictures_are_left_out(self):
        self.assertLessEqual(set(self.left_out), {"matplotlib"})
        sources = [source for source, needs in cells() if not needs]
        self.assertFalse([source for source in sources if "matplotlib" in source or "views" in source])

    def test_nothing_that_it_prints_is_kept(self):
        notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
        self.assertFalse([cell for cell in notebook["cells"] if cell.get("outputs") or cell.get("execution_count")])


if __name__ == "__main__":
    unittest.main()
