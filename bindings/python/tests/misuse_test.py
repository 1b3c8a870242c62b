"""What is wrong is an error that says what to do, and never a crash."""
import dataclasses
import threading
import time
import unittest

import numpy as np

import session
import spherecloud as sphc


class Misuse(unittest.TestCase):
    def setUp(self):
        self.map = sphc.Map.open(session.MAP)
        self.localizer = session.localizer({session.MAP_ID: self.map})
        self.frame = session.frame(session.ROWS[0])

    def refused(self, status, words, call, *arguments, **more):
        with self.assertRaisesRegex(sphc.Error, words) as caught:
            call(*arguments, **more)
        self.assertEqual(caught.exception.status, status, caught.exception)
        self.assertGreater(len(caught.exception.message), 10)

    def goes_on(self):
        self.assertTrue(session.play(session.localizer({session.MAP_ID: self.map})))
        self.localizer.reset()
        self.assertTrue(self.localizer.process(session.frame(session.ROWS[0])).localized)

    def test_closed_objects(self):
        features = self.localizer.make_features()
        self.refused(sphc.Status.E_STATE, "no frame yet", features.arrays)
        for closing in (features, self.localizer, self.map):
            closing.close()
            closing.close()
        state = sphc.Status.E_STATE
        self.refused(state, "the features are closed", features.arrays)
        for call in (self.map.info, lambda: self.map.direction(0), self.map.__enter__, self.localizer.reset,
                     lambda: self.localizer.process(self.frame), lambda: self.localizer.extract(self.frame, features),
                     lambda: self.localizer.locate(self.frame, features), lambda: self.localizer.predict(0),
                     self.localizer.observations, self.localizer.hypotheses, lambda: self.localizer.set_map(1, self.map),
                     lambda: self.localizer.remove_map(7), lambda: self.localizer.map_count,
                     lambda: self.localizer.set_parameter(sphc.Parameter.PROBES, 1), self.localizer.make_features,
                     self.localizer.memory_pieces, self.localizer.__enter__):
            self.refused(state, "closed", call)

    def test_images_that_do_not_fit(self):
        color, depth, image = self.frame.color, self.frame.depth, sphc.Status.E_IMAGE
        for wrong, words in ((color[:-1], "239"), (color.astype(np.float64), "float64"), (color[:, ::-1], "side by side"),
                             (color[::-1], "downwards"), (np.broadcast_to(color[:1], color.shape), "downwards"),
                             (color[:, :, None].repeat(2, 2), "none of"), (color.ravel(), "none of"),
                             (np.zeros((240, 640), np.uint8)[:, ::2], "side by side"),
                             (sphc.Image(np.zeros((240, 640), np.uint8)[:, 340:], sphc.Format.GRAY8, 320), "300 pixels wide, not 320"),
                             (np.empty((0, 0), np.uint8), "no pixels"),
                             (sphc.Image(color, sphc.Format.RGB8), "RGB8"), (sphc.Image(color, sphc.Format.GRAY10P), "a width"),
                             (sphc.Image(color, sphc.Format.GRAY10P, 640), "a width that fits"), (None, "color")):
            self.frame.color = wrong
            self.refused(image, words, self.localizer.process, self.frame)
        self.frame.color = color.tolist()
        with self.assertRaisesRegex(TypeError, "numpy array"):
            self.localizer.process(self.frame)
        self.frame.color = color
        odd = np.frombuffer(bytes(2 * depth.size + 1), np.uint8)[1:].view(np.uint16).reshape(depth.shape)
        between = np.ndarray(depth.shape, np.uint16, bytearray(401 * 160), strides=(401, 2))
        for wrong, words in ((depth.astype(">u2"), ">u2"), (depth.astype(np.int16), "int16"), (depth[:, :-1], "199"), (odd, "aligned"), (between, "stride")):
            self.frame.depth = wrong
            self.refused(image, words, self.localizer.process, self.frame)
        self.goes_on()

    def test_maps_that_are_none(self):
        good = session.MAP.read_bytes()
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        self.refused(sphc.Status.E_MAP_CHECKSUM, ".", sphc.Map, flipped)
        for cut in (b"", good[:10], good[:-1], bytes(len(good))):
            self.refused(sphc.Status.E_MAP_FORMAT, ".", sphc.Map, cut)
        with self.assertRaises(FileNotFoundError):
            sphc.Map.open(session.FOLDER / "none.sphc")
        with self.assertRaises(IndexError):
            self.map.direction(self.map.info().point_count)

    def test_configs_that_cannot_be(self):
        bad = sphc.Rig(session.COLOR, session.DEPTH, sphc.Rigid(t_m=(float("nan"), 0, 0)))
        self.refused(sphc.Status.E_ARGUMENT, "color_from_depth", sphc.Localizer, bad)
        self.refused(sphc.Status.E_ARGUMENT, "color_from_depth", sphc.Aligner, bad)
        self.refused(sphc.Status.E_ARGUMENT, "max_keypoints", sphc.Localizer, session.RIG, max_keypoints=1)
        self.refused(sphc.Status.E_CAPACITY, "max_maps", session.localizer, {1: self.map, 2: self.map}, max_maps=1)
        self.refused(sphc.Status.E_ARGUMENT, "band", session.localizer, self.map, color_band=sphc.Band.INFRARED)
        with self.assertRaises(TypeError):
            sphc.Localizer(session.RIG, max_keypoint=100)

    def test_arguments_of_calls(self):
        self.refused(sphc.Status.E_ARGUMENT, "map", self.localizer.remove_map, 3)
        self.refused(sphc.Status.E_ARGUMENT, "rotation_sigma_rad", self.localizer.set_map_transform, 7, sphc.Rigid(), -1, 0)
        self.refused(sphc.Status.E_UNSUPPORTED, "99", self.localizer.set_parameter, 99, 1)
        self.refused(sphc.Status.E_UNSUPPORTED, "99", sphc.parameter_range, 99)
        self.frame.prior = sphc.Prior(session.MAP_ID, up_camera=(0, 0, 0), up_map=(0, 1, 0), up_sigma_rad=0.1)
        self.refused(sphc.Status.E_ARGUMENT, "up", self.localizer.process, self.frame)
        self.frame.prior = sphc.Prior(session.MAP_ID, up_camera=(0, 0), up_map=(0, 1, 0))
        with self.assertRaises(ValueError):
            self.localizer.process(self.frame)
        self.goes_on()

    def test_numbers_that_their_fields_cannot_hold(self):
        past, frame = 2**32, session.frame(session.ROWS[0])
        calls = [lambda: self.localizer.set_map(past, self.map), lambda: self.localizer.remove_map(past + session.MAP_ID),
                 lambda: self.localizer.remove_map(-1), lambda: self.localizer.set_map_transform(past, None),
                 lambda: self.localizer.predict(2**63), lambda: self.localizer.get_parameter(past),
                 lambda: sphc.Localizer(session.RIG, max_keypoints=past + 800),
                 lambda: sphc.Camera.pinhole(past + 640, 480, 500, 500, 320, 240).check(),
                 lambda: sphc.Camera(past + sphc.CameraModel.PINHOLE, 640, 480, (500, 500, 320, 240)).check(),
                 lambda: sphc.parameter_range(2**40 + sphc.Parameter.MAX_RATIO)]
        tum = past + sphc.Convention.TUM
        calls += [lambda: sphc.make_world(tum, (0, 0, 1)), lambda: sphc.write_camera(tum, sphc.Rigid()),
                  lambda: sphc.read_camera(tum, (0, 0, 0, 0, 0, 0, 1)), lambda: sphc.write_map(tum, sphc.Rigid()),
                  lambda: sphc.read_map(tum, (0, 0, 0, 0, 0, 0, 1))]
        for name, value in (("sequence", -1), ("deadline_us", past + 1), ("deadline_us", -5), ("color_time_ns", 2**64 + 7),
                            ("depth_time_ns", -2**63 - 1)):
            wrong = dataclasses.replace(frame, **{name: value})
            calls.append(lambda wrong=wrong: self.localizer.process(wrong))
        for call in calls:
            with self.assertRaisesRegex(ValueError, "must be|beyond"):
                call()
        for call in (lambda: self.localizer.predict(1e9), lambda: self.localizer.set_map("hall", self.map),
                     lambda: self.map.direction(1.0), lambda: self.localizer.set_parameter("PROBES", 3),
                     lambda: sphc.parameter_range(1.5), lambda: sphc.write_map("TUM", sphc.Rigid()),
                     lambda: sphc.Camera("PINHOLE", 640, 480, (500, 500, 320, 240)).check()):
            with self.assertRaisesRegex(TypeError, "whole number"):
                call()
        self.goes_on()

    def test_what_is_of_another_type(self):
        for call in (lambda: sphc.Localizer(session.RIG, "room.sphc"), lambda: sphc.Localizer(None, self.map),
                     lambda: self.localizer.process(None), lambda: self.localizer.set_map(0, None),
                     lambda: self.localizer.set_depth_bias(None),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, views=[self.frame.color])),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, color_camera="x")),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, prior=sphc.Prior(7, np.eye(4)))),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, prior=sphc.Prior(7, odometry_from_camera=np.eye(4)))),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, color=sphc.Image(self.frame.color, 99))),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, color=sphc.Image([1], sphc.Format.GRAY8))),
                     lambda: sphc.Aligner(session.RIG).process(self.frame.depth, sphc.Aligned(depth=[1])),
                     lambda: sphc.Map("room.sphc"), lambda: sphc.Map(3), lambda: sphc.Rig(1, 2).check(),
                     lambda: sphc.Localizer(session.RIG, log=3), lambda: sphc.Localizer(session.RIG, clock=3),
                     lambda: sphc.Localizer(session.RIG, cameras=[session.RIG]),
                     lambda: sphc.Localizer(session.RIG, depth_cameras=[session.RIG]),
                     lambda: sphc.Aligner(None), lambda: sphc.Aligner(session.RIG, depth_format=2**32 + sphc.Format.DEPTH16),
                     lambda: sphc.Localizer(session.RIG, depth_format=int(sphc.Format.DEPTH16)),
                     lambda: sphc.Localizer(session.RIG, depth_format=None),
                     lambda: sphc.RigCamera(None, sphc.Rigid()).raw(), lambda: sphc.RigCamera(session.COLOR, np.eye(4)).raw(),
                     lambda: sphc.RigDepthCamera(None, sphc.Rigid()).raw(),
                     lambda: sphc.RigDepthCamera(session.DEPTH, np.eye(4)).raw(),
                     lambda: sphc.RigDepthCamera(session.DEPTH, sphc.Rigid(), None).raw(),
                     lambda: sphc.write_camera(sphc.Convention.TUM, np.eye(4)),
                     lambda: sphc.write_camera(sphc.Convention.TUM, sphc.Rigid(), np.eye(4)),
                     lambda: sphc.write_map(sphc.Convention.TUM, np.eye(4)),
                     lambda: self.localizer.set_parameter(sphc.Parameter.PROBES, "3"),
                     lambda: self.localizer.set_map_transform(session.MAP_ID, sphc.Rigid(), None),
                     lambda: self.localizer.set_map_transform(session.MAP_ID, sphc.Rigid(), 0.01, "far"),
                     lambda: self.localizer.process(self.frame).confidence_within("near", 0.1),
                     lambda: sphc.Localizer(session.RIG, cameras=1), lambda: sphc.Localizer(session.RIG, depth_cameras=1),
                     lambda: self.localizer.process(dataclasses.replace(self.frame, deadline_us="soon"))):
            with self.assertRaisesRegex(TypeError, "not "):
                call()
        masked = dataclasses.replace(self.frame, depth=np.ma.masked_equal(self.frame.depth, 0))
        self.refused(sphc.Status.E_IMAGE, "filled", self.localizer.process, masked)
        metres = dataclasses.replace(self.frame, depth=self.frame.depth.astype(np.float32))
        self.refused(sphc.Status.E_IMAGE, "depth_format", self.localizer.process, metres)
        self.goes_on()

    def test_numbers_that_are_none_are_named(self):
        for given in "abc", (1, "b", 3), 5:
            with self.assertRaisesRegex(TypeError, "t_m has 3 numbers, and is"):
                sphc.Rigid(t_m=given)

    def test_a_clock_that_gives_no_whole_number(self):
        localizer = sphc.Localizer(session.RIG, self.map, clock=time.monotonic)
        with self.assertRaises(TypeError):
            localizer.process(self.frame)

    def test_a_failure_has_its_own_words(self):
        self.refused(sphc.Status.E_ARGUMENT, "PROBES", self.localizer.set_parameter, sphc.Parameter.PROBES, 3.5)
        self.refused(sphc.Status.E_UNSUPPORTED, "no parameter 99", self.localizer.get_parameter, 99)

    def test_a_map_that_another_thread_closes(self):
        shared, closing = [self.map], threading.Event()
        faults = []

        def read():
            while not closing.is_set():
                try:
                    shared[0].direction(5)
                except sphc.Error as error:
                    if error.status != sphc.Status.E_STATE:
                        faults.append(error)
                except Exception as error:
                    faults.append(error)

        threads = [threading.Thread(target=read) for _ in range(3)]
        for thread in threads:
            thread.start()
        content = session.MAP.read_bytes()
        for _ in range(100):
            before, shared[0] = shared[0], sphc.Map(content)
            before.close()
            del before
        closing.set()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])

    def test_features_that_do_not_fit(self):
        features, other = self.localizer.make_features(), sphc.Localizer(session.RIG, max_keypoints=300).make_features()
        self.refused(sphc.Status.E_STATE, "no frame", self.localizer.locate, self.frame, features)
        self.refused(sphc.Status.E_ARGUMENT, "config", self.localizer.extract, self.frame, other)
        self.localizer.extract(self.frame, features)
        self.frame.color_time_ns += 1
        self.refused(sphc.Status.E_ARGUMENT, "time", self.localizer.locate, self.frame, features)
        arrays = features.arrays()
        self.refused(sphc.Status.E_CAPACITY, ".", other.set, self.frame, arrays)
        arrays.descriptors = arrays.descriptors[:-1]
        self.refused(sphc.Status.E_ARGUMENT, "descriptor", features.set, self.frame, arrays)
        arrays.descriptors = arrays.descriptors[:, :64]
        self.refused(sphc.Status.E_ARGUMENT, "128", features.set, self.frame, arrays)
        arrays.descriptors = arrays.descriptors.astype(np.int64)
        self.refused(sphc.Status.E_ARGUMENT, "uint8 is needed, not .* of int64", features.set, self.frame, arrays)

    def test_aligned_images_that_are_too_small(self):
        aligner = sphc.Aligner(session.RIG)
        read_only = np.zeros((240, 320), np.uint16)
        read_only.flags.writeable = False
        for wrong in (np.zeros((240, 319), np.uint16), np.zeros((240, 320), np.int16), read_only,
                      np.zeros((480, 320), np.uint16)[::-2]):
            self.refused(sphc.Status.E_IMAGE, "out.depth", aligner.process, self.frame.depth, sphc.Aligned(depth=wrong))
        self.refused(sphc.Status.E_IMAGE, "size|200", aligner.process, np.zeros((10, 10), np.uint16))

    def test_calls_from_callbacks(self):
        caught = []

        def log(level, text):
            try:
                made.reset()
            except sphc.Error as error:
                caught.append(error)
        made = session.localizer({session.MAP_ID: self.map}, log=log, log_level=sphc.LogLevel.DEBUG)
        made.process(self.frame)
        self.assertEqual(caught[0].status, sphc.Status.E_STATE)

    def test_a_fault_comes_up_in_the_thread_of_its_call(self):
        calls, others = [], []

        def set_map():
            try:
                made.set_map(session.MAP_ID, self.map)
            except BaseException as fault:
                others.append(fault)

        def clock():
            calls.append(None)
            if len(calls) == 1:
                raise ArithmeticError("the clock fails")
            if len(calls) == 2:
                thread = threading.Thread(target=set_map)
                thread.start()
                thread.join()
            return len(calls)
        made = session.localizer({}, clock=clock)
        features = made.make_features()
        self.assertRaises(ArithmeticError, made.extract, self.frame, features)
        self.assertGreaterEqual(len(calls), 2)
        self.assertEqual(others, [])
        self.assertEqual(made.map_count, 1)


if __name__ == "__main__":
    unittest.main()
