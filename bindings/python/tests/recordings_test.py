"""Raw recordings, written here by the page of their format: what is read, and what is refused."""
import dataclasses
import pathlib
import struct
import tempfile
import unittest
import zlib

import numpy as np

import session
import spherecloud as sphc

POSE = sphc.Rigid((0.6, 0.8, 0, 0), (1, -2, 3.5))


def camera(of):
    return struct.pack("<4I12d", of.model, of.width, of.height, len(of.params), *of.params, *[0.0] * (12 - len(of.params)))


def header(rig, count, format, version=1):
    made = struct.pack("<8s4I", b"SPHC-RAW", version, count, format, 0) + camera(rig.color_camera) + camera(rig.depth_camera)
    made += struct.pack("<7d", *session.numbers(rig.color_from_depth)) + struct.pack("<dI", rig.depth_unit_m, 0)
    return made + struct.pack("<I", zlib.crc32(made))


def frame(of, pose):
    images = of.depth.tobytes() + of.color.tobytes()
    head = struct.pack("<2I2q", of.sequence, pose is not None, of.color_time_ns, of.depth_time_ns)
    head += struct.pack("<7d", *(session.numbers(pose) if pose else [0.0] * 7)) + struct.pack("<I", zlib.crc32(images))
    return head + struct.pack("<I", zlib.crc32(head)) + images


class Recordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "walk.raw"
        self.frames = [session.frame(row) for row in session.ROWS]
        self.poses = [POSE, *[None] * (len(self.frames) - 1)]
        self.parts = [header(session.RIG, len(self.frames), 1), *map(frame, self.frames, self.poses)]

    def recording(self, *parts):
        self.path.write_bytes(b"".join(parts or self.parts))
        return sphc.Recording(self.path)

    def refused(self, status, why, call):
        with self.assertRaises(sphc.Error) as caught:
            call()
        self.assertEqual(caught.exception.status, status)
        self.assertIn(str(self.path), caught.exception.message)
        self.assertIn(why, caught.exception.message)

    def test_gives_what_was_written(self):
        recording = self.recording()
        self.assertEqual((recording.rig, recording.color_format), (session.RIG, sphc.Format.GRAY8))
        rig = dataclasses.replace(session.RIG, depth_unit_m=0.00025)
        self.assertEqual(self.recording(header(rig, 0, 1)).rig, rig)
        recording = self.recording()
        self.assertEqual([recorded.world_from_camera for recorded in recording], self.poses)
        for recorded, written in zip(recording, self.frames):
            np.testing.assert_array_equal(recorded.frame.color, written.color)
            np.testing.assert_array_equal(recorded.frame.depth, written.depth)
            self.assertEqual((recorded.frame.color_time_ns, recorded.frame.depth_time_ns, recorded.frame.sequence),
                             (written.color_time_ns, written.depth_time_ns, written.sequence))

    def test_is_a_sequence(self):
        recording = self.recording()
        self.assertEqual(len(recording), len(self.frames))
        self.assertEqual([each.frame.sequence for each in recording[-2:]], [each.sequence for each in self.frames[-2:]])
        self.assertEqual(recording[-1].frame.sequence, self.frames[-1].sequence)
        for index in (len(self.frames), -len(self.frames) - 1):
            with self.assertRaises(IndexError):
                recording[index]
        self.assertEqual(list(self.recording(header(session.RIG, 0, 1))), [])

    def test_plays_the_session(self):
        with sphc.Map.open(session.MAP) as room, session.localizer({session.MAP_ID: room}) as localizer:
            for recorded, row in zip(self.recording(), session.ROWS):
                recorded.frame.prior = session.prior(row) if row["has_up"] == "1" else None
                self.assertTrue(session.same(localizer.process(recorded.frame), row), row["color_file"])
                localizer.predict(int(row["color_time_ns"]) + 20_000_000)

    def test_colours(self):
        written = self.frames[0]
        written.color = np.arange(written.color.size * 3, dtype=np.uint32).astype(np.uint8).reshape(*written.color.shape, 3)
        for format in (sphc.Format.RGB8, sphc.Format.BGR8):
            color = self.recording(header(session.RIG, 1, format), frame(written, None))[0].frame.color
            if format == sphc.Format.BGR8:
                self.assertEqual(color.format, format)
                color = color.data
            np.testing.assert_array_equal(color, written.color)
        self.refused(sphc.Status.E_ARGUMENT, "DEPTH16", lambda: self.recording(header(session.RIG, 0, sphc.Format.DEPTH16)))

    def test_refuses_what_is_no_whole_recording(self):
        head, *frames = self.parts
        changed = bytearray(head)
        changed[30] ^= 1
        for why, parts in (("no raw recording", [b""]), ("no raw recording", [b"SPHC-RAW"]), ("no raw recording", [b"x", head]),
                           ("version 1", [header(session.RIG, 0, 1, version=2)]), ("header was changed", [bytes(changed), *frames]),
                           ("copy it again", [head, *frames[:-1]]), ("copy it again", [head, *frames, b"x"])):
            self.refused(sphc.Status.E_ARGUMENT, why, lambda parts=parts: self.recording(*parts))
        with self.assertRaises(FileNotFoundError):
            sphc.Recording(self.path.with_name("gone.raw"))

    def test_a_changed_frame_spoils_no_other(self):
        for place in (5, 20, 100, -1):
            parts = list(map(bytearray, self.parts))
            parts[2][place] ^= 4
            recording = self.recording(*parts)
            self.refused(sphc.Status.E_DEVICE, "frame 1 was changed", lambda recording=recording: recording[1])
            self.assertEqual(recording[2].frame.sequence, self.frames[2].sequence)
        recording = self.recording()
        self.path.write_bytes(b"".join(self.parts[:-1]))
        self.refused(sphc.Status.E_DEVICE, "is cut", lambda: recording[-1])


if __name__ == "__main__":
    unittest.main()
