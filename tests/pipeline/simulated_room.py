"""A simulated room, through the command line alone: its recordings, its maps, and what is localized in them."""
import collections
import concurrent.futures
import json
import os
import statistics
import sys

import confidence
import room_options
from nasty import errors, is_close, is_wrong
from private_key import key_of
from recordings import run

ETA, FAKES = 0.33, "patchwork"


class SimulatedRoom:
    """In a folder; what is there already is not made again.  `world`: what `simulate` is told of the room."""

    def __init__(self, tool, folder, seed, key, world=()):
        self.tool, self.folder, self.seed, self.world = tool, folder, seed, world
        self.key = key_of(key, folder / "key")

    def record(self, name, *arguments, seed=None):
        out, seed = self.folder / name, self.seed if seed is None else seed
        if not (out / "groundtruth.txt").exists():
            run([self.tool, "simulate", "--out", out, "--seed", seed, "--walk-seed", seed, *self.world, *arguments, "--threads", 1,
                 "--json"])
        return out

    def build(self, name, walk, *arguments):
        file = self.folder / (name + ".sphc")
        if not file.exists():
            run([self.tool, "build", "--recording", walk, "--map", file, "--eta", ETA, "--fakes", FAKES, "--key", self.key, "--ledger",
                 self.folder / (name + ".ledger"), *arguments, "--json"])
        return file

    def localize(self, file, recording, name, *arguments):
        """What `localize` says of each frame; `name`: of these arguments."""
        answers = self.folder / ("%s_%s_%s.frames" % (file.stem, recording.name, name))
        run([self.tool, "localize", "--recording", recording, "--map", file, "--owner-note", str(file) + ".owner.json",
             *arguments, "--frames-json", answers, "--force", "--json"])
        return map(json.loads, answers.read_text().splitlines())


def frames_of_rooms(arguments, measure):
    """What measure(tool, folder, number) gives of each room, in order; as many rooms at once as there are cores."""
    def of_room(number):
        with room_options.folder_of(arguments.keep and arguments.keep / ("room_%d" % number)) as folder:
            return list(measure(arguments.spherecloud, folder, number))

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, frames in enumerate(pool.map(of_room, range(arguments.rooms))):
            yield from frames
            if sys.stderr.isatty():
                print("\r%d of %d rooms" % (number + 1, arguments.rooms), end="", file=sys.stderr)


def median_and_p90(values):
    values = sorted(values)
    return ["%.2f" % values[int(share * (len(values) - 1))] for share in (0.5, 0.9)] if values else ["", ""]


def figures_of(frames):
    """What a ledger says of frames of several rooms, some of them of another room; a frame has `seed`, `here` and `answer`."""
    here, elsewhere = ([frame for frame in frames if frame.here == side] for side in (True, False))
    accepted = [frame.answer for frame in here if frame.answer["localized"]]
    wrong = [frame.answer for frame in here if is_wrong(frame)]
    rooms = collections.defaultdict(list)
    for frame in here:
        rooms[frame.seed].append(100 * is_close(frame))
    close = [statistics.mean(room) for room in rooms.values()]
    poses = [confidence.pose_of(answer) for answer in accepted]
    figures = {
        "rooms": len(rooms), "frames": len(here), "accepted_percent": "%.1f" % (100 * len(accepted) / len(here)),
        "within_5cm_5deg_percent_mean": "%.1f" % statistics.mean(close), "within_5cm_5deg_percent_worst": "%.1f" % min(close),
        "translation_over_sigma_median": median_and_p90(pose.translation_over_sigma for pose in poses)[0],
        "rotation_over_sigma_median": median_and_p90(pose.rotation_over_sigma for pose in poses)[0],
        "tracking": sum(answer["state"] == "tracking" for answer in accepted), "wrong_accepted": len(wrong),
        "wrong_tracking": sum(answer["state"] == "tracking" for answer in wrong),
        "worst_cm": "%.1f" % max(errors(answer)[0] for answer in wrong) if wrong else "",
        "worst_deg": "%.1f" % max(errors(answer)[1] for answer in wrong) if wrong else "",
        "worst_confidence": "%.3f" % max(answer["confidence"] for answer in wrong) if wrong else "",
        "ece": "%.3f" % confidence.calibration_error(poses) if poses else "",
        "elsewhere_frames": len(elsewhere), "elsewhere_accepted": sum(map(is_wrong, elsewhere))}
    for part, unit in enumerate(("cm", "deg")):
        figures["median_" + unit], figures["p90_" + unit] = median_and_p90(errors(answer)[part] for answer in accepted)
    return figures


def words_of(answer):
    """Of one that is wrong."""
    return "frame %d: %.1f cm, %.1f deg, confidence %.3f, %d of %d matches, %s" % (
        answer["sequence"], *errors(answer), answer["confidence"], answer["inliers"], answer["matches"], answer["state"])
