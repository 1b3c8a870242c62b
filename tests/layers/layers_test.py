#!/usr/bin/env python3
"""The checker must be able to fail: small trees with one fault each."""
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True
import layers  # noqa: E402

TABLE = os.path.join(HERE, "layers.txt")
HEADERS = ("sdk/include/spherecloud/spherecloud.h", "sdk/runtime/base/span.h", "sdk/runtime/geometry/rigid.h",
           "sdk/runtime/map/map_view.h", "sdk/runtime/stages/pose/p3p.h", "sdk/runtime/stages/match/matcher.h",
           "sdk/runtime/localizer/localizer.h", "sdk/host/import/point_model.h", "sdk/host/publish/map_writer.h",
           "drivers/replay/replay.h", "drivers/sample/sample.h")


class LayersTest(unittest.TestCase):
    def faults(self, path, *includes):
        with tempfile.TemporaryDirectory() as root:
            for name in HEADERS:
                self.write(root, name, "")
            self.write(root, path, "".join(f"#include {i}\n" for i in includes))
            return layers.check_tree(root, TABLE)[1]

    @staticmethod
    def write(root, path, text):
        full = os.path.join(root, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as stream:
            stream.write(text)

    def assertFault(self, path, include, word):
        faults = self.faults(path, include)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(word, faults[0])
        self.assertTrue(faults[0].startswith(path + ":1:"), faults[0])

    def test_good(self):
        self.assertEqual(self.faults("sdk/runtime/stages/pose/x.cpp", '"runtime/base/span.h"', "<Eigen/Core>",
                                     '"runtime/stages/pose/p3p.h"', "<cmath>", '"p3p.h"'), [])
        self.assertEqual(self.faults("sdk/runtime/stages/match/x.cpp", '"runtime/map/map_view.h"'), [])
        self.assertEqual(self.faults("sdk/host/publish/x.cpp", '"host/import/point_model.h"', "<sodium.h>"), [])
        self.assertEqual(self.faults("sdk/host/recording/x.cpp", "<spherecloud/spherecloud.h>", "<opencv2/core.hpp>"), [])

    def test_upwards(self):
        self.assertFault("sdk/runtime/base/x.h", '"runtime/geometry/rigid.h"', "may not include")
        self.assertFault("sdk/runtime/map/x.h", '"runtime/localizer/localizer.h"', "may not include")

    def test_stage_to_stage(self):
        self.assertFault("sdk/runtime/stages/align/x.cpp", '"runtime/stages/pose/p3p.h"', "may not include")
        self.assertFault("sdk/runtime/stages/pose/x.cpp", '"runtime/map/map_view.h"', "may not include")

    def test_device_to_host(self):
        self.assertFault("sdk/runtime/localizer/x.cpp", '"host/import/point_model.h"', "may not include")

    def test_attack_sees_the_map_alone(self):
        self.assertFault("sdk/host/audit/attack/x.cpp", '"host/import/point_model.h"', "may not include")
        self.assertFault("sdk/host/audit/attack/x.cpp", '"host/publish/map_writer.h"', "may not include")

    def test_interface_users(self):
        self.assertFault("drivers/sample/x.cpp", '"runtime/base/span.h"', "may not include")
        self.assertFault("drivers/sample/x.cpp", '"drivers/replay/replay.h"', "may not include")
        self.assertFault("examples/x.c", '"runtime/base/span.h"', "may not include")
        self.assertFault("sdk/lab/pose/x.cpp", '"runtime/localizer/localizer.h"', "may not include")

    def test_relative_path_is_no_way_round(self):
        self.assertFault("sdk/runtime/base/x.h", '"../geometry/rigid.h"', "may not include")

    def test_outside_libraries(self):
        self.assertFault("sdk/runtime/base/x.h", "<Eigen/Core>", "eigen")
        self.assertFault("sdk/runtime/geometry/x.h", "<hwy/highway.h>", "highway")
        self.assertFault("sdk/runtime/capi/x.h", "<opencv2/core.hpp>", "opencv")
        self.assertFault("sdk/runtime/base/x.h", "<boost/any.hpp>", "no library")
        self.assertFault("sdk/runtime/base/x.h", "<unistd.h>", "posix")
        self.assertFault("drivers/sample/x.cpp", "<opencv2/core.hpp>", "opencv")

    def test_device_bans(self):
        for header in ("<vector>", "<thread>", "<iostream>", "<cstdio>", "<stdexcept>", "<memory>"):
            self.assertFault("sdk/runtime/base/x.h", header, "no place on the device")

    def test_interface(self):
        self.assertFault("sdk/include/spherecloud/x.h", "<stdio.h>", "C interface")
        self.assertFault("sdk/include/spherecloud/x.h", '"runtime/base/span.h"', "may not include")

    def test_unknown_folder(self):
        self.assertFault("sdk/runtime/tracker/x.h", "<cmath>", "no row")
        self.assertFault("sdk/x.h", "<cmath>", "no row")

    def test_missing_and_computed(self):
        self.assertFault("sdk/runtime/base/x.h", '"runtime/base/gone.h"', "not there")
        self.assertFault("sdk/runtime/base/x.h", "HEADER_NAME", "cannot be checked")


if __name__ == "__main__":
    unittest.main()
