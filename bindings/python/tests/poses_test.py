"""Rigid transforms, cameras, and poses as other systems state them."""
import csv
import os
import unittest

import numpy as np

import session
import spherecloud as sphc

TURNED = sphc.Rigid((0.5, 0.5, -0.5, 0.5), (1, 2, 3))


class Conventions(unittest.TestCase):
    def assert_numbers(self, found, wanted):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12)

    def test_golden_poses(self):
        with open(os.environ["SPHERECLOUD_CONVENTIONS"], encoding="utf-8", newline="") as stream:
            vectors = list(csv.DictReader(stream))
        self.assertGreater(len(vectors), 60)
        for vector in vectors:
            with self.subTest(scene=vector["scene"], convention=vector["convention"]):
                self.compare(vector)

    def compare(self, vector):
        def values(name):
            return [float(value) for key, value in vector.items() if key.startswith(name + "_") and value]

        convention = sphc.Convention[vector["convention"]]
        told = values("world_from_map") or [1] + [0] * 6
        world, camera = (sphc.Rigid(v[:4], v[4:]) for v in (told, values("camera_from_map")))
        given = world if values("world_from_map") else None
        if values("up_map"):
            self.assert_numbers(session.numbers(sphc.make_world(convention, values("up_map"))), told)
        self.assert_numbers(sphc.write_camera(convention, camera, given), values("camera_pose"))
        self.assert_numbers(session.numbers(sphc.read_camera(convention, values("camera_pose"), given)), values("camera_from_map"))
        self.assert_numbers(sphc.write_map(convention, world), values("map_pose"))
        self.assert_numbers(session.numbers(sphc.read_map(convention, values("map_pose"))), told)

    def test_refusals_name_the_cause(self):
        with self.assertRaisesRegex(sphc.Error, "up_map"):
            sphc.make_world(sphc.Convention.ROS_FLU, (0, 0, 0))
        with self.assertRaises(sphc.Error):
            sphc.write_camera(sphc.Convention.OPENXR, TURNED)
        with self.assertRaises(sphc.Error) as refused:
            sphc.write_camera(99, TURNED)
        self.assertEqual(refused.exception.status, sphc.Status.E_UNSUPPORTED)
        with self.assertRaises(ValueError):
            sphc.read_camera(sphc.Convention.TUM, (1, 2, 3))


class Rigids(unittest.TestCase):
    def test_matrices_agree_with_the_library(self):
        other = sphc.Rigid((0.8, 0, 0.6, 0), (-1, 0, 0.5))
        np.testing.assert_allclose((TURNED @ other).matrix(), TURNED.matrix() @ other.matrix(), atol=1e-15)
        np.testing.assert_allclose(TURNED.inverse().matrix(), np.linalg.inv(TURNED.matrix()), atol=1e-15)
        points = np.arange(12.0).reshape(2, 2, 3)
        np.testing.assert_allclose(TURNED @ points, (TURNED.matrix() @ np.append(points, np.ones((2, 2, 1)), 2)[..., None])[..., :3, 0])
        for q_wxyz in ((1, 1, 0, 0), (0.999, 0, 0, 0.1), (0, 0, 0, 0)):  # normalised by the library too
            pose, point = sphc.Rigid(q_wxyz, (1, 2, 3)), (4, 5, 6)
            np.testing.assert_allclose(pose @ point, (pose @ sphc.Rigid(t_m=point)).t_m, atol=1e-14)

    def test_matrices_come_back(self):
        for q in np.random.default_rng(1).normal(size=(50, 4)).tolist() + [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]:
            pose = sphc.Rigid(np.array(q) / np.linalg.norm(q), (1, 2, 3))
            np.testing.assert_allclose(sphc.Rigid.from_matrix(pose.matrix()).matrix(), pose.matrix(), atol=1e-14)
        for wrong in (np.eye(3), 2 * np.eye(4), np.diag([1, 1, -1, 1])):
            with self.assertRaises(ValueError):
                sphc.Rigid.from_matrix(wrong)

    def test_equal_by_value(self):
        self.assertEqual(TURNED, sphc.Rigid([0.5, 0.5, -0.5, 0.5], np.array([1, 2, 3])))
        with self.assertRaises(ValueError):
            sphc.Rigid((1, 0, 0), (0, 0, 0))


class Cameras(unittest.TestCase):
    CAMERA = sphc.Camera(sphc.CameraModel.BROWN5, 640, 480, (500, 500, 320, 240, 0.05, -0.01, 0.001, 0, 0))

    def test_project_and_back(self):
        pixels = np.array([[320, 240], [10.5, 20.5], [600, 400]])
        bearings = self.CAMERA.unproject(pixels)
        np.testing.assert_allclose(np.linalg.norm(bearings, axis=1), 1)
        np.testing.assert_allclose(self.CAMERA.project(2.5 * bearings), pixels, atol=1e-6)
        np.testing.assert_allclose(self.CAMERA.project((0, 0, 3)), (320, 240))

    def test_behind_the_camera(self):
        self.assertTrue(np.isnan(self.CAMERA.project([[0, 0, -1], [0, 0, 1]])).tolist(), [[True] * 2, [False] * 2])
        with self.assertRaises(sphc.Error):
            self.CAMERA.project((0, 0, -1))
        with self.assertRaises(ValueError):
            self.CAMERA.project((1, 2))
        with self.assertRaisesRegex(sphc.Error, "SPHC_E_ARGUMENT"):
            sphc.Camera.pinhole(640, 480, 0, 500, 320, 240).project([[0, 0, 1], [0, 0, 2]])

    def test_checks(self):
        self.CAMERA.check()
        session.RIG.check()
        with self.assertRaisesRegex(sphc.Error, "SPHC_E_ARGUMENT"):
            sphc.Camera.pinhole(640, 480, 0, 500, 320, 240).check()
        with self.assertRaisesRegex(sphc.Error, "depth_unit_m"):
            sphc.Rig(session.COLOR, session.DEPTH, depth_unit_m=5).check()

    def test_defaults_of_a_rig_are_those_of_the_library(self):
        told = sphc._interface.sphc_rig()
        sphc._library.interface().sphc_rig_init(told)
        made = sphc.Rig(session.COLOR, session.DEPTH)
        self.assertEqual((made.depth_unit_m, made.color_from_depth), (told.depth_unit_m, sphc.Rigid.of(told.color_from_depth)))


if __name__ == "__main__":
    unittest.main()
