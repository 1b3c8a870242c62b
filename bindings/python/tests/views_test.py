"""Pictures of a frame: with matplotlib and rerun where they are there, and with stand-ins of what is called where not."""
import contextlib
import importlib
import importlib.util
import sys
import unittest
from unittest import mock

import numpy as np

import session
import spherecloud as sphc
from spherecloud import _overlays

POSES = [sphc.Rigid(t_m=(0, 0, 0)), sphc.Rigid(t_m=(-1, 0, 0)), None, sphc.Rigid(t_m=(-2, 0, -1)), sphc.Rigid(t_m=(-3, 0, -1))]


def observations():
    made = np.zeros(4, sphc.OBSERVATION)
    made["x_px"], made["y_px"], made["scale_px"], made["camera"] = (10, 20, 30, 40), (5, 6, 7, 8), 3, (0, 0, 0, 1)
    made["flags"] = (0, sphc.ObservationFlag.LIFTED, sphc.ObservationFlag.LIFTED | sphc.ObservationFlag.MATCHED | sphc.ObservationFlag.INLIER, 0)
    return made


@contextlib.contextmanager
def without(*modules):
    """As if these were not installed; what was imported of the package is imported anew."""
    with mock.patch.dict(sys.modules, {name: None for name in modules}):
        for name in ("spherecloud.views", "spherecloud.rerun_views"):
            sys.modules.pop(name, None)
        yield


@contextlib.contextmanager
def stand_in(*modules):
    with mock.patch.dict(sys.modules, {name: mock.MagicMock() for name in modules}):
        for name in ("spherecloud.views", "spherecloud.rerun_views"):
            sys.modules.pop(name, None)
        yield


class Overlays(unittest.TestCase):
    def test_the_best_of_a_keypoint_is_shown(self):
        self.assertEqual(_overlays.best_kinds(observations()).tolist(), [0, 1, 3, 0])
        self.assertEqual(_overlays.best_kinds(observations()[:0]).tolist(), [])

    def test_red_comes_first(self):
        pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
        self.assertIs(_overlays.as_rgb(pixels), pixels)
        self.assertEqual(_overlays.as_rgb(sphc.Image(pixels, sphc.Format.RGB8))[0, 0].tolist(), [0, 1, 2])
        self.assertEqual(_overlays.as_rgb(sphc.Image(pixels, sphc.Format.BGR8))[0, 0].tolist(), [2, 1, 0])
        with self.assertRaises(sphc.Error) as caught:
            _overlays.as_rgb(sphc.Image(pixels, sphc.Format.YUYV))
        self.assertEqual(caught.exception.status, sphc.Status.E_UNSUPPORTED)


class Missing(unittest.TestCase):
    def test_says_what_to_install(self):
        for module, package, extra in (("views", "matplotlib", "views"), ("rerun_views", "rerun", "rerun")):
            with without(package, "matplotlib.axes"), self.assertRaisesRegex(ImportError, rf"pip install spherecloud\[{extra}\]"):
                importlib.import_module(f"spherecloud.{module}")


class Matplotlib(unittest.TestCase):
    def drawn(self):
        """(what holds the keypoints, what holds the walk, as they were drawn)"""
        views = importlib.import_module("spherecloud.views")
        frame = session.frame(session.ROWS[0])
        seen, walk = mock.MagicMock(), mock.MagicMock()
        seen.figure.dpi = 72
        views.draw_observations(seen, frame.color, observations())
        views.draw_trajectory(walk, POSES)
        return seen, walk

    def test_keypoints_and_walk(self):
        with stand_in("matplotlib", "matplotlib.axes", "matplotlib.collections"):
            seen, walk = self.drawn()
        self.assertEqual([call.args[0].tolist() for call in seen.scatter.call_args_list], [[10], [20], [], [30]])
        names = [call.kwargs["label"] for call in seen.plot.call_args_list]
        self.assertEqual(names, ["1 keypoint", "1 with depth", "0 matched", "1 inlier"])
        right, forward = walk.plot.call_args.args[:2]
        np.testing.assert_allclose(right, [0, 1, np.nan, 2, 3])
        np.testing.assert_allclose(forward, [0, 0, np.nan, 1, 1])
        self.assertEqual(walk.plot.call_args.kwargs["label"], "4 of 5 frames")

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_a_picture(self):
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        views = importlib.import_module("spherecloud.views")
        figure = Figure()
        views.draw_observations(figure.add_subplot(1, 2, 1), session.frame(session.ROWS[0]).color, observations())
        views.draw_trajectory(figure.add_subplot(1, 2, 2), POSES)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        self.assertGreater(len(np.unique(np.asarray(canvas.buffer_rgba()).reshape(-1, 4), axis=0)), 100)


class Rerun(unittest.TestCase):
    def test_what_is_logged(self):
        with stand_in("rerun"):
            views, rerun = importlib.import_module("spherecloud.rerun_views"), sys.modules["rerun"]
            views.log_rig(session.RIG)
            frame, result = session.frame(session.ROWS[0]), mock.Mock(pose=sphc.Rigid(t_m=(1, 2, 3)))
            views.log_frame(frame, session.RIG, result, observations())
            views.log_frame(frame, session.RIG, mock.Mock(pose=None))
            views.log_walk(POSES)
        paths = [call.args[0] for call in rerun.log.call_args_list]
        images = ["headset/color/image", "headset/depth/image"]
        self.assertEqual(paths, ["headset/color", "headset/depth", *images, "headset", "headset/color/image/keypoints", *images, "walk"])
        self.assertEqual(rerun.Transform3D.call_args_list[1].kwargs["translation"], (-1, -2, -3))
        self.assertEqual(rerun.DepthImage.call_args.kwargs["meter"], 1000)
        self.assertEqual(rerun.Points2D.call_args.args[0].tolist(), [[10, 5], [20, 6], [30, 7]])
        self.assertEqual(rerun.LineStrips3D.call_args.args[0], [[(0, 0, 0), (1, 0, 0)], [(2, 0, 1), (3, 0, 1)]])
        self.assertEqual(rerun.set_time.call_args.kwargs["duration"], frame.color_time_ns / 1e9)

    def test_nothing_of_a_frame_that_cannot_be_shown(self):
        with stand_in("rerun"):
            views, rerun = importlib.import_module("spherecloud.rerun_views"), sys.modules["rerun"]
            frame = session.frame(session.ROWS[0])
            frame.depth = sphc.Image(frame.depth.astype(np.float32), sphc.Format.DEPTH_F32)
            with self.assertRaises(sphc.Error) as caught:
                views.log_frame(frame, session.RIG)
            self.assertEqual(caught.exception.status, sphc.Status.E_UNSUPPORTED)
            rerun.log.assert_not_called()


if __name__ == "__main__":
    unittest.main()
