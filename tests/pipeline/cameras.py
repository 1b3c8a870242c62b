#!/usr/bin/env python3
"""Maps of one device, localized in by another: headset, phone, wide and glasses, as `simulate --cameras` has them.

    cameras.py --spherecloud BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites cameras.csv, for review

Every room is mapped by each device on lap one, with a key of its own, and each device localizes in each map on lap two: frames
that are far apart, each alone, and two seconds at 30 Hz in tracking.  So do frames of another room, of which no pose is right:
"elsewhere".  Half of the rooms are as they are; in the other half are the holder's hands and feet, carpet, and bare walls.  A row
is of one device that maps, one that localizes, and one mode.  Every accepted pose that is wrong is printed.
"""
import collections
import csv
import itertools
import statistics
import sys

sys.dont_write_bytecode = True
import confidence
import room_options
from nasty import errors, is_close, is_wrong
from recordings import HERE
from simulated_room import SimulatedRoom, frames_of_rooms

RESULTS = HERE / "cameras.csv"
DEVICES = "headset", "phone", "wide", "glasses"
ROOMS, FIRST_SEED, ELSEWHERE = 12, 7001, 50  # seeds that nothing else uses; from a room to the one that is elsewhere
LAP_S, MAP_FRAMES = 16, 10
HARD = ["--with", "hands,feet,carpet,bare"]
# What is asked: frames, how many a second, and how `localize` looks at them.
Query = collections.namedtuple("Query", "frames hz mode")
QUERIES = {"single": Query(20, 1.25, "single"), "tracking": Query(60, 30, "tracking"), "elsewhere": Query(15, 1, "single")}
COLUMNS = ["map", "query", "mode", "rooms", "frames", "accepted_percent", "within_5cm_5deg_percent_mean",
           "within_5cm_5deg_percent_worst", "median_cm", "p90_cm", "tracking", "wrong_accepted", "wrong_tracking", "worst_cm",
           "worst_deg", "worst_confidence", "ece", "elsewhere_frames", "elsewhere_accepted"]
Frame = collections.namedtuple("Frame", "seed map query mode here answer")


class Room(SimulatedRoom):
    def __init__(self, tool, folder, number):
        super().__init__(tool, folder, FIRST_SEED + number, "cameras key %d" % number, HARD if number % 2 else [])
        self.number = number

    def record_by(self, device, name, *arguments, seed=None):
        return self.record("%s_%s" % (name, device), "--cameras", device, *arguments, seed=seed)

    def ask(self, name, device):
        query = QUERIES[name]
        seed = self.seed + (ELSEWHERE if name == "elsewhere" else 0)
        spare = max(LAP_S - query.frames / query.hz, 0)  # each room is entered elsewhere on lap two, and left before it ends
        start = LAP_S + spare * self.number / ROOMS
        return self.record_by(device, name, "--from", "%.2f" % start, "--frames", query.frames, "--rate", query.hz, seed=seed)

    def frames(self):
        maps = {device: self.build(device, self.record_by(device, "map", "--frames", MAP_FRAMES, "--rate", MAP_FRAMES / LAP_S))
                for device in DEVICES}
        for query, name in itertools.product(DEVICES, QUERIES):
            recording = self.ask(name, query)
            mode = QUERIES[name].mode
            for device, file in maps.items():
                for answer in self.localize(file, recording, mode, "--mode", mode):
                    yield Frame(self.seed, device, query, mode, name != "elsewhere", answer)


def row_of(key, frames):
    here, elsewhere = ([frame for frame in frames if frame.here == side] for side in (True, False))
    accepted = [frame for frame in here if frame.answer["localized"]]
    wrong = [frame.answer for frame in accepted if is_wrong(frame)]
    rooms = collections.defaultdict(list)
    for frame in here:
        rooms[frame.seed].append(100 * is_close(frame))
    close = [statistics.mean(room) for room in rooms.values()]
    centimetres = sorted(errors(frame.answer)[0] for frame in accepted)
    poses = [confidence.pose_of(frame.answer) for frame in accepted]
    tracking = [frame.answer["state"] == "tracking" for frame in accepted]
    worst = ["%.1f" % max(errors(answer)[0] for answer in wrong), "%.1f" % max(errors(answer)[1] for answer in wrong),
             "%.3f" % max(answer["confidence"] for answer in wrong)] if wrong else ["", "", ""]
    return dict(zip(COLUMNS, [
        *key, len(rooms), len(here), "%.1f" % (100 * len(accepted) / len(here)), "%.1f" % statistics.mean(close), "%.1f" % min(close),
        *(("%.2f" % centimetres[int(share * (len(centimetres) - 1))] for share in (0.5, 0.9)) if accepted else ("", "")),
        sum(tracking), len(wrong), sum(answer["state"] == "tracking" for answer in wrong), *worst,
        "%.3f" % confidence.calibration_error(poses) if poses else "", len(elsewhere), sum(map(is_wrong, elsewhere))]))


def tell(frame):
    answer = frame.answer
    print("WRONG room %d, map of %s, %s, %s, frame %d: %.1f cm, %.1f deg, confidence %.3f, %d of %d matches, %s" % (
        frame.seed, frame.map, "query of " + frame.query if frame.here else "elsewhere, by " + frame.query, frame.mode,
        answer["sequence"], *errors(answer), answer["confidence"], answer["inliers"], answer["matches"], answer["state"]), flush=True)


def main():
    arguments = room_options.parser_of(__doc__, RESULTS, ROOMS).parse_args()
    found = collections.defaultdict(list)
    for frame in frames_of_rooms(arguments, lambda *room: Room(*room).frames()):
        found[frame.map, frame.query, frame.mode].append(frame)
        if is_wrong(frame):
            tell(frame)
    order = list(itertools.product(DEVICES, DEVICES, ("single", "tracking")))
    with arguments.results.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(row_of(key, found[key]) for key in order)


if __name__ == "__main__":
    main()
