"""How often poses are right against the confidence that was stated, and their errors over the stated sigmas.

accuracy.py hands over the poses that it has localized; rows are pooled over the keys.
"""
import collections
import statistics

GOOD_M, GOOD_DEG = 0.05, 5.0  # within which a pose is right
BINS = 10
SURE = 0.99
KEYED = ["recording", "fakes", "mode", "eta"]
COLUMNS = KEYED + ["poses", "right_percent", "confidence_percent", "ece", "sure_poses", "sure_right_percent",
                   "translation_over_sigma_median", "translation_over_sigma_p90", "rotation_over_sigma_median",
                   "rotation_over_sigma_p90"]
# Of the poses that are sure so many are right at least; the expected calibration error of so many poses at most.
LEAST_SURE_RIGHT, MOST_ECE, FEWEST_POSES = 99.0, 0.18, 200

Pose = collections.namedtuple("Pose", "confidence right translation_over_sigma rotation_over_sigma")


def pose_of(frame):
    """Of an accepted frame of `localize --frames-json` with truth."""
    error, sigma = frame["error"], frame["sigma"]
    right = error["translation_m"] <= GOOD_M and error["rotation_deg"] <= GOOD_DEG
    return Pose(frame["confidence"], right, error["translation_m"] / sigma["translation_m"],
                error["rotation_deg"] / sigma["rotation_deg"])


def calibration_error(poses):
    """Expected calibration error: |share right - mean confidence| of bins of equal width, averaged over the poses."""
    bins = collections.defaultdict(list)
    for pose in poses:
        bins[min(int(BINS * pose.confidence), BINS - 1)].append(pose)
    return sum(abs(sum(pose.right - pose.confidence for pose in members)) for members in bins.values()) / len(poses)


def percent(values):
    values = list(values)
    return "%.2f" % (100 * sum(values) / len(values)) if values else ""


def row_of(key, poses):
    def quantiles(values):
        return ["%.2f" % statistics.median(values), "%.2f" % sorted(values)[int(0.9 * (len(values) - 1) + 0.5)]]

    sure = [pose for pose in poses if pose.confidence >= SURE]
    return dict(zip(COLUMNS, [
        *key, str(len(poses)), percent(pose.right for pose in poses), percent(pose.confidence for pose in poses),
        "%.4f" % calibration_error(poses), str(len(sure)), percent(pose.right for pose in sure),
        *quantiles([pose.translation_over_sigma for pose in poses]), *quantiles([pose.rotation_over_sigma for pose in poses])]))


def faults(row):
    if int(row["poses"]) < FEWEST_POSES:
        return
    if float(row["ece"]) > MOST_ECE:
        yield "calibration error %s, limit %s" % (row["ece"], MOST_ECE)
    if int(row["sure_poses"]) >= FEWEST_POSES and float(row["sure_right_percent"]) < LEAST_SURE_RIGHT:
        yield "of the sure poses %s %% are right, limit %s" % (row["sure_right_percent"], LEAST_SURE_RIGHT)
