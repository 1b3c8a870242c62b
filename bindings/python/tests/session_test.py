"""What C found in the golden session is found in every way that Python can ask."""
import math
import signal
import threading
import time
import unittest

import numpy as np

import session
import spherecloud as sphc


class Session(unittest.TestCase):
    def setUp(self):
        self.map = sphc.Map.open(session.MAP)
        self.localizer = session.localizer({session.MAP_ID: self.map})
        self.addCleanup(self.localizer.close)
        self.addCleanup(self.map.close)

    def first(self, **more):
        return session.frame(session.ROWS[0], **more)

    def test_it_is_that_of_c(self):
        for row in session.ROWS:
            with self.subTest(frame=row["sequence"]):
                result = self.localizer.process(session.frame(row))
                self.assertTrue(session.same(result, row), result)
                later = self.localizer.predict(int(row["color_time_ns"]) + 20_000_000)
                self.assertEqual(session.numbers(later.camera_from_map), session.wanted(row, "predicted_"))
                self.assertEqual(later.known, row["predicted_status"] == "0")
                self.assertEqual(result.pose is None, row["status"] == "2")

    def test_two_halves_are_the_whole(self):
        with self.localizer.make_features() as features:
            for row in session.ROWS:
                frame = session.frame(row)
                self.localizer.extract(frame, features)
                frame.color = None
                self.assertTrue(session.same(self.localizer.locate(frame, features), row))

    def test_features_can_be_set(self):
        other, taken = self.localizer.make_features(), self.localizer.make_features()
        for row in session.ROWS:
            frame = session.frame(row)
            self.localizer.extract(frame, taken)
            arrays = taken.arrays()
            self.assertEqual(arrays.extractor, sphc.extractor_id())
            self.assertEqual(arrays.descriptors.shape, (len(arrays.keypoints), 128))
            other.set(frame, arrays)
            self.assertTrue(session.same(self.localizer.locate(frame, other), row))
            self.assertTrue((other.arrays().keypoints == arrays.keypoints).all())

    def test_images_of_any_rows(self):
        frame = self.first()
        wide = np.zeros((240, 500), np.uint8)
        wide[:, 30:350] = frame.color
        tall = np.zeros((400, 200), np.uint16)
        tall[40:360:2] = frame.depth
        frame.color, frame.depth = wide[:, 30:350], tall[40:360:2]
        self.assertTrue(session.same(self.localizer.process(frame), session.ROWS[0]))
        frame = self.first()
        frame.color = np.asfortranarray(frame.color)
        with self.assertRaises(sphc.Error):
            self.localizer.process(frame)

    def test_other_formats(self):
        frame = self.first()
        frame.color = np.repeat(frame.color[:, :, None], 3, 2)
        bare = self.localizer.process(frame)
        self.assertTrue(bare.localized)
        frame.color = sphc.Image(frame.color, sphc.Format.BGR8)
        other = session.localizer({session.MAP_ID: self.map})
        np.testing.assert_allclose(other.process(frame).camera_from_map.matrix(), bare.camera_from_map.matrix(), atol=1e-3)
        meters = session.localizer({session.MAP_ID: self.map}, depth_format=sphc.Format.DEPTH_F32)
        frame = self.first()
        frame.depth = frame.depth.astype(np.float32) * np.float32(0.001)
        self.assertTrue(meters.process(frame).localized)
        packed = session.localizer({session.MAP_ID: self.map}, depth_format=sphc.Format.DEPTH12P)
        z = self.first().depth
        rows = np.empty((160, 300), np.uint8)  # two pixels in three bytes
        rows[:, 0::3], rows[:, 1::3] = z[:, 0::2] >> 4, z[:, 1::2] >> 4
        rows[:, 2::3] = (z[:, 0::2] & 15) | ((z[:, 1::2] & 15) << 4)
        frame.depth = sphc.Image(rows, sphc.Format.DEPTH12P, width=200)
        self.assertTrue(session.same(packed.process(frame), session.ROWS[0]))

    def test_what_became_of_keypoints(self):
        self.assertEqual(len(self.localizer.observations()), 0)
        self.assertEqual(self.localizer.hypotheses(), [])
        result = self.localizer.process(self.first())
        seen = self.localizer.observations()
        self.assertEqual(len(seen), result.keypoints)
        self.assertEqual(np.count_nonzero(seen["flags"] & sphc.ObservationFlag.INLIER), result.inliers)
        best = self.localizer.hypotheses()[0]
        self.assertTrue(best.is_result)
        self.assertEqual(best.camera_from_map, result.camera_from_map)

    def test_confidence_of_other_bounds(self):
        result = self.localizer.process(self.first())
        self.assertAlmostEqual(result.confidence_within(0.05, math.radians(5)), result.confidence, 12)
        self.assertLess(result.confidence_within(0.001, math.radians(5)), result.confidence)

    def test_what_is_learnt_can_be_told_again(self):
        learnt = [self.localizer.process(session.frame(row)) for row in session.ROWS][-1].depth
        other = session.localizer({session.MAP_ID: self.map})
        other.set_depth_bias(learnt)
        self.assertEqual(other.process(self.first()).depth, learnt)

    def test_parameters(self):
        limits = sphc.parameter_range(sphc.Parameter.MIN_INLIERS)
        self.assertTrue(limits.whole)
        self.assertEqual(self.localizer.get_parameter(sphc.Parameter.MIN_INLIERS), limits.initial)
        self.localizer.set_parameter(sphc.Parameter.MIN_INLIERS, limits.highest)
        self.assertEqual(self.localizer.get_parameter(sphc.Parameter.MIN_INLIERS), limits.highest)
        with self.assertRaises(sphc.Error) as refused:
            self.localizer.set_parameter(sphc.Parameter.MIN_INLIERS, limits.highest + 1)
        self.assertEqual(refused.exception.status, sphc.Status.E_ARGUMENT)

    def test_maps_come_and_go(self):
        self.assertEqual(self.localizer.map_count, 1)
        self.localizer.set_map(session.MAP_ID, sphc.Map(session.MAP.read_bytes()))
        self.localizer.set_map_transform(session.MAP_ID, sphc.Rigid(), 0.01, 0.1)
        self.localizer.set_map_transform(session.MAP_ID, None)
        self.assertTrue(session.same(self.localizer.process(self.first()), session.ROWS[0]))
        self.localizer.remove_map(session.MAP_ID)
        self.assertEqual(self.localizer.map_count, 0)
        self.localizer.reset()
        self.assertFalse(self.localizer.process(self.first()).localized)

    def test_prior_of_the_pose(self):
        known = self.localizer.process(self.first()).camera_from_map
        alone = session.localizer({session.MAP_ID: self.map})
        result = alone.process(self.first(prior=sphc.Prior(session.MAP_ID, known, 0.02, 0.02)))
        self.assertTrue(result.localized and result.guided)

    def test_what_one_frame_was_told_is_not_told_of_the_next(self):
        beside = sphc.RigCamera(session.COLOR, sphc.Rigid())
        second = sphc.RigDepthCamera(session.DEPTH, sphc.Rigid())
        told = dict(prior=session.prior(session.ROWS[-1]), color_camera=session.COLOR, color_from_depth=sphc.Rigid(),
                    depth_camera=session.DEPTH, views=[sphc.View(None, 0)], depth_views=[sphc.DepthView(None, 0)])
        with session.localizer({session.MAP_ID: self.map}, cameras=[beside], depth_cameras=[second]) as rig:
            frame = self.first(deadline_us=10**6, amplitude=self.first().color, **told)
            rig.process(frame)
            with self.assertRaises(sphc.Error):
                rig.process(self.first())
            raw = rig._locate_frame.raw
            left = (raw.prior, raw.color_camera, raw.color_from_depth, raw.depth_camera, raw.views, raw.depth_views,
                    raw.amplitude.data, raw.deadline_us)
            self.assertEqual(left, (None,) * 7 + (0,))

    def test_clock_log_and_deadline(self):
        lines = []
        with session.localizer({session.MAP_ID: self.map}, log=lambda level, text: lines.append((level, text)),
                               log_level=sphc.LogLevel.DEBUG) as told:
            self.assertGreater(told.process(self.first()).features_us, 0)
            self.assertTrue(lines and lines[0][0] in sphc.LogLevel)
            late = told.process(self.first(deadline_us=1))
            self.assertEqual(late.outcome, sphc.Outcome.DEADLINE)
            self.assertTrue(late.cuts & sphc.Cut.FEATURES or late.cuts)
        with session.localizer({session.MAP_ID: self.map}, clock=None, log=None) as silent:
            self.assertEqual(silent.process(self.first()).features_us, 0)

    def test_what_a_callback_raises_comes_up(self):
        def interrupted():
            raise KeyboardInterrupt
        with session.localizer({session.MAP_ID: self.map}, clock=interrupted) as made:
            with self.assertRaises(KeyboardInterrupt):
                made.process(self.first())

    def test_an_interrupt_comes_up_wherever_it_comes(self):
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        frame = self.first()
        with session.localizer({session.MAP_ID: self.map}, log=None) as made:
            for index in range(20):  # a frame takes some milliseconds
                with self.assertRaises(KeyboardInterrupt):
                    signal.setitimer(signal.ITIMER_REAL, 2e-4 * (1 + index))
                    made.process(frame)
                    time.sleep(1)
            self.assertTrue(made.process(frame).localized)

    def test_further_cameras(self):
        frame = self.first()
        beside = sphc.RigCamera(session.COLOR, sphc.Rigid(), row_time_ns=-30_000)
        with session.localizer({session.MAP_ID: self.map}, cameras=[beside]) as rig:
            frame.views = [sphc.View(frame.color, frame.color_time_ns, session.COLOR, sphc.Rigid())]
            self.assertTrue(rig.process(frame).localized)
            self.assertEqual(set(rig.observations()["camera"]), {0, 1})
            frame.views = [sphc.View(None, frame.color_time_ns)]
            self.assertTrue(rig.process(frame).localized)
            frame.views = ()
            with self.assertRaisesRegex(sphc.Error, "view"):
                rig.process(frame)

    def test_a_second_depth_camera(self):
        frame = self.first()
        second = sphc.RigDepthCamera(session.DEPTH, session.RIG.color_from_depth, sigma_m=0.02, amplitude_min=10)
        with session.localizer({session.MAP_ID: self.map}, depth_cameras=[second]) as rig:
            bright = np.full(frame.depth.shape, 100, np.uint8)
            known = dict(amplitude=bright, camera=session.DEPTH, color_from_depth=session.RIG.color_from_depth)
            blind = np.zeros_like(frame.depth)
            frame.depth, frame.depth_views = blind, [sphc.DepthView(frame.depth, frame.depth_time_ns, **known)]
            self.assertTrue(rig.process(frame).localized)
            frame.depth_views = [sphc.DepthView(None, frame.depth_time_ns)]
            self.assertFalse(rig.process(frame).localized)
            for views, words in (([sphc.DepthView(blind[1:], 0, bright[1:])], "depth.*159"), ((), "depth_view_count is 0"),
                                 ([sphc.DepthView(blind, 0)], "amplitude"), ([sphc.DepthView(blind, 0, bright)] * 2, "is 2")):
                frame.depth_views = views
                with self.assertRaisesRegex(sphc.Error, words):
                    rig.process(frame)

    def test_of_a_depth_camera_the_library_has_defaults(self):
        raw = sphc.RigDepthCamera(session.DEPTH, sphc.Rigid(), min_m=0.75, format=sphc.Format.RANGE16).raw()
        config = self.localizer._config
        self.assertEqual((raw.format, raw.min_m, raw.max_m), (sphc.Format.RANGE16, 0.75, config.depth_max_m))
        self.assertEqual((raw.unit_m, raw.sigma_per_m2), (0.001, config.depth_sigma_per_m2))

    def test_cameras_of_a_frame(self):
        known = dict(color_camera=session.COLOR, color_from_depth=session.RIG.color_from_depth, depth_camera=session.DEPTH)
        self.assertTrue(session.same(self.localizer.process(self.first(**known)), session.ROWS[0]))
        known["depth_camera"] = session.COLOR
        with self.assertRaisesRegex(sphc.Error, "depth_camera"):
            self.localizer.process(self.first(**known))

    def test_answers_can_be_read(self):
        info = self.map.info()
        self.assertEqual((info.file_bytes, info.band), (session.MAP.stat().st_size, sphc.Band.VISIBLE))
        self.assertAlmostEqual(np.linalg.norm(self.map.direction(info.point_count - 1)), 1, 6)
        self.assertEqual(info, self.map.info())
        self.assertIn("point_count=", repr(info))
        pieces = self.localizer.memory_pieces()
        self.assertGreater(sum(piece.bytes for piece in pieces), 100_000)
        self.assertEqual(sphc.Outcome(77).name, "UNKNOWN_77")  # of a newer library

    def test_localizers_in_threads(self):
        good = []

        def walk():
            with session.localizer({session.MAP_ID: self.map}) as own:
                good.append(session.play(own))
        threads = [threading.Thread(target=walk) for _ in range(4)]
        [thread.start() for thread in threads]
        [thread.join() for thread in threads]
        self.assertEqual(good, [True] * 4)

    def test_extract_runs_beside_locate(self):
        frames = [session.frame(row) for row in session.ROWS]
        pair = [self.localizer.make_features(), self.localizer.make_features()]
        self.localizer.extract(frames[0], pair[0])
        for i, row in enumerate(session.ROWS):
            following = threading.Thread(target=lambda: i + 1 < len(frames) and self.localizer.extract(frames[i + 1], pair[(i + 1) % 2]))
            following.start()
            self.assertTrue(session.same(self.localizer.locate(frames[i], pair[i % 2]), row))
            following.join()

    def test_python_runs_during_a_call(self):
        ticks, end = [0], threading.Event()

        def count():
            while not end.is_set():
                ticks[0] += 1
                time.sleep(0)
        other = threading.Thread(target=count)
        other.start()
        before = ticks[0]
        frame = self.first()
        for _ in range(20):
            self.localizer.process(frame)
        end.set()
        other.join()
        self.assertGreater(ticks[0], before)


class Alignment(unittest.TestCase):
    def test_depth_lies_on_colour(self):
        depth = session.frame(session.ROWS[0]).depth
        with sphc.Aligner(session.RIG) as aligner:
            made = aligner.process(depth)
            self.assertEqual(made.depth.shape, (240, 320))
            self.assertGreater(np.count_nonzero(made.depth), 30_000)
            self.assertEqual(set(np.unique(made.mask)) - set(sphc.AlignedPixel), set())
            self.assertTrue(((made.mask == sphc.AlignedPixel.MEASURED) <= (made.depth > 0)).all())
            wide = np.zeros((240, 400), np.uint16)
            part = sphc.Aligned(depth=wide[:, 7:327])
            self.assertIs(aligner.process(depth, part), part)
            self.assertTrue((part.depth == made.depth).all() and not wide[:, :7].any() and not wide[:, 327:].any())
        with self.assertRaisesRegex(sphc.Error, "closed"):
            aligner.process(depth)


if __name__ == "__main__":
    unittest.main()
