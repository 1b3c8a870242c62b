#!/usr/bin/env python3
"""Maps of one device, localized in by another: headset, phone, wide and glasses, as `simulate --cameras` has them.

    cameras.py --spherecloud BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites cameras.csv, for review

Every room is mapped by each device on lap one, with a key of its own, and each device localizes in each map on lap two: frames
that are far apart, each alone, and two seconds at 30 Hz in tracking.  So do frames of another room, of which no pose is right:
"elsewhere".  Half of the rooms are as they are; in the other half are the holder's hands and feet, carpet, and bare walls.  A row
is of one device that maps, one that localizes, and one mode.  Every accepted pose that is wrong is printed.
"""
import collections
import concurrent.futures
import csv
import itertools
import json
import os
import statistics
import sys

sys.dont_write_bytecode = True
import confidence
import room_options
from nasty import errors, is_close, is_wrong
from private_key import key_of
from recordings import HERE, run

RESULTS = HERE / "cameras.csv"
DEVICES = "headset", "phone", "wide", "glasses"
ROOMS, FIRST_SEED, ELSEWHERE = 12, 7001, 50  # seeds that nothing else uses; from a room to the one that is elsewhere
LAP_S, MAP_FRAMES, ETA, FAKES = 16, 10, 0.33, "patchwork"
HARD = ["--with", "hands,feet,carpet,bare"]
# What is asked: frames, how many a second, and how `localize` looks at them.
Query = collections.namedtuple("Query", "frames hz mode")
QUERIES = {"single": Query(20, 1.25, "single"), "tracking": Query(60, 30, "tracking"), "elsewhere": Query(15, 1, "single")}
COLUMNS = ["map", "query", "mode", "rooms", "frames", "accepted_percent", "within_5cm_5deg_percent_mean",
           "within_5cm_5deg_percent_worst", "median_cm", "p90_cm", "tracking", "wrong_accepted", "wrong_tracking", "worst_cm",
           "worst_deg", "worst_confidence", "ece", "elsewhere_frames", "elsewhere_accepted"]
Frame = collections.namedtuple("Frame", "seed map query mode here answer")


class Room:
    def __init__(self, tool, folder, number):
        self.tool, self.folder, self.number, self.seed = tool, folder, number, FIRST_SEED + number
        self.world = HARD if number % 2 else []

    def simulate(self, name, device, seed, *arguments):
        out = self.folder / ("%s_%s" % (name, device))
        if not (out / "groundtruth.txt").exists():
            run([self.tool, "simulate", "--out", out, "--cameras", device, "--seed", seed, "--walk-seed", seed, *self.world,
                 *arguments, "--threads", 1, "--json"])
        return out

    def build(self, device):
        file = self.folder / (device + ".sphc")
        walk = self.simulate("map", device, self.seed, "--frames", MAP_FRAMES, "--rate", MAP_FRAMES / LAP_S)
        key = key_of("cameras key %d" % self.number, self.folder / "key")
        if not file.exists():
            run([self.tool, "build", "--recording", walk, "--map", file, "--eta", ETA, "--fakes", FAKES, "--key", key, "--ledger",
                 self.folder / (device + ".ledger"), "--json"])
        return file

    def record(self, name, device):
        query = QUERIES[name]
        seed = self.seed + (ELSEWHERE if name == "elsewhere" else 0)
        spare = max(LAP_S - query.frames / query.hz, 0)  # each room is entered elsewhere on lap two, and left before it ends
        start = LAP_S + spare * self.number / ROOMS
        return self.simulate(name, device, seed, "--from", "%.2f" % start, "--frames", query.frames, "--rate", query.hz)

    def localize(self, file, recording, name):
        answers = self.folder / ("%s_%s.frames" % (file.stem, recording.name))
        run([self.tool, "localize", "--recording", recording, "--map", file, "--owner-note", str(file) + ".owner.json", "--mode",
             QUERIES[name].mode, "--frames-json", answers, "--json"])
        return map(json.loads, answers.read_text().splitlines())

    def frames(self):
        maps = {device: self.build(device) for device in DEVICES}
        for query, name in itertools.product(DEVICES, QUERIES):
            recording = self.record(name, query)
            for device, file in maps.items():
                for answer in self.localize(file, recording, name):
                    yield Frame(self.seed, device, query, QUERIES[name].mode, name != "elsewhere", answer)


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


def measure_room(tool, keep, number):
    with room_options.folder_of(keep and keep / ("room_%d" % number)) as folder:
        return list(Room(tool, folder, number).frames())


def main():
    arguments = room_options.parser_of(__doc__, RESULTS, ROOMS).parse_args()
    found = collections.defaultdict(list)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, frames in enumerate(pool.map(lambda number: measure_room(arguments.spherecloud, arguments.keep, number),
                                                 range(arguments.rooms))):
            for frame in frames:
                found[frame.map, frame.query, frame.mode].append(frame)
                if is_wrong(frame):
                    tell(frame)
            if sys.stderr.isatty():
                print("\r%d of %d rooms" % (number + 1, arguments.rooms), end="", file=sys.stderr)
    order = list(itertools.product(DEVICES, DEVICES, ("single", "tracking")))
    with arguments.results.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(row_of(key, found[key]) for key in order)


if __name__ == "__main__":
    main()
