#!/usr/bin/env python3
"""The checks of accuracy.py see what they are there for."""
import copy
import tempfile
import unittest

import accuracy
import confidence
import private_key


def row(**changes):
    first = dict(zip(accuracy.KEYED, accuracy.wanted_rows()[0]))
    figures = dict.fromkeys(accuracy.COLUMNS[len(accuracy.KEYED):], "1.000")
    return first | figures | {"eta": "0.33", "within_5cm_5deg_percent": "100.0", "median_deg": "0.100",
                              "wrong_accepted": "0", "frames": "100"} | changes


class Accuracy(unittest.TestCase):
    def test_a_row_as_committed_has_no_fault(self):
        self.assertEqual([], [*accuracy.differences(row(), row()), *accuracy.faults(row())])

    def test_one_digit_is_a_difference(self):
        self.assertEqual(["p90_cm: 1.001, in accuracy_keys.csv 1.000"], list(accuracy.differences(row(p90_cm="1.001"), row())))

    def test_a_row_that_is_not_committed_is_a_fault(self):
        self.assertTrue(list(accuracy.differences(row(), None)))

    def test_floors_ceilings_and_wrong_poses(self):
        for change in ({"within_5cm_5deg_percent": "98.9"}, {"median_cm": "1.001"}, {"median_cm": ""}, {"median_deg": "0.301"},
                       {"wrong_accepted": "1"}):
            self.assertEqual(1, len(list(accuracy.faults(row(**change)))), change)

    def test_over_keys_the_median_and_the_worst_have_floors_of_their_own(self):
        def found(*shares, wrong="0"):
            rows = [row(key=str(key), within_5cm_5deg_percent=share, wrong_accepted=wrong) for key, share in enumerate(shares, 1)]
            return list(accuracy.faults_over_keys(accuracy.spread(rows)[0]))

        self.assertEqual([], found("99.0", "100.0", "89.0"))
        self.assertEqual(["within_5cm_5deg_percent_worst: 88.9, limit 89.0"], found("99.0", "100.0", "88.9"))
        self.assertEqual(["within_5cm_5deg_percent_median: 93.9, limit 94.0"], found("93.9", "93.9", "100.0"))
        self.assertEqual(["3 wrong poses accepted of 300 frames"], found("99.0", "100.0", "99.0", wrong="1"))

    def test_wrong_is_beyond_25_cm_or_10_deg(self):
        for centimetres, degrees, wrong in ((24.9, 9.9, False), (25.1, 0, True), (0, 10.1, True)):
            frame = {"error": {"translation_m": centimetres / 100, "rotation_deg": degrees}}
            self.assertEqual(wrong, accuracy.is_wrong(frame))

    def test_the_spread_has_the_median_and_the_worst_key(self):
        rows = [row(key=str(key), median_cm="%.3f" % key, localized_percent="%.1f" % (100 - key), wrong_accepted=str(int(key == 6)))
                for key in (1, 2, 6)]
        rows += [copy.copy(row(key="3", recording="other"))]
        (first, other) = accuracy.spread(rows)
        self.assertEqual(("3", "2.000", "6.000"), (first["keys"], first["median_cm_median"], first["median_cm_worst"]))
        self.assertEqual(("98.0", "94.0"), (first["localized_percent_median"], first["localized_percent_worst"]))
        self.assertEqual("1", other["keys"])

    def test_every_recording_has_rows_of_twelve_keys(self):
        keys = {recording: {row[-1] for row in accuracy.wanted_rows() if row[0] == recording}
                for recording in [*accuracy.recordings(), *accuracy.REFUSED]}
        self.assertEqual({12}, {len(numbers) for numbers in keys.values()})
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(12, len({private_key.numbered_key(number, folder).read_text() for number in private_key.NUMBERS}))


class Confidence(unittest.TestCase):
    @staticmethod
    def poses(count, said, right):
        return [confidence.Pose(said, number < right, number / 100, number / 50) for number in range(count)]

    def row(self, *poses):
        return confidence.row_of(("room", "patchwork", "single", "0.33"), sum(poses, []))

    def test_what_is_said_and_what_is(self):
        row = self.row(self.poses(100, 0.75, 75), self.poses(100, 0.995, 100))
        self.assertEqual(("200", "87.50", "100", "100.00"), (row["poses"], row["right_percent"], row["sure_poses"],
                                                             row["sure_right_percent"]))
        self.assertEqual("0.0025", row["ece"])
        self.assertEqual(("0.49", "0.89"), (row["translation_over_sigma_median"], row["translation_over_sigma_p90"]))
        self.assertEqual([], list(confidence.faults(row)))

    def test_too_sure_is_a_fault(self):
        self.assertEqual(1, len(list(confidence.faults(self.row(self.poses(300, 0.99, 296))))))
        self.assertEqual(1, len(list(confidence.faults(self.row(self.poses(300, 0.9, 200))))))
        self.assertEqual([], list(confidence.faults(self.row(self.poses(100, 0.9, 50)))))  # too few to tell

    def test_a_frame_of_the_command(self):
        frame = {"confidence": 0.5, "error": {"translation_m": 0.02, "rotation_deg": 6},
                 "sigma": {"translation_m": 0.01, "rotation_deg": 3}}
        self.assertEqual(confidence.Pose(0.5, False, 2, 2), confidence.pose_of(frame))


if __name__ == "__main__":
    unittest.main()
