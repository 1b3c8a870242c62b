#!/usr/bin/env python3
"""Maps of one device, localized in by another: headset, phone, wide and glasses, as `simulate --cameras` has them.

    cameras.py --spherecloud BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites cameras.csv, for review

Every room is mapped by each device on lap one, with a key of its own, and each device localizes in each map on lap two: frames
that are far apart, each alone, and two seconds at 30 Hz in tracking.  So do frames of another room, of which no pose is right:
"elsewhere".  Half of the rooms are as they are; in the other half are the holder's hands and feet, carpet, and bare walls.  A row
is of one device that maps, one that localizes, and one mode.  Every accepted pose that is wrong is printed.
"""
import collections
import itertools
import sys

sys.dont_write_bytecode = True
import room_options
from nasty import is_wrong
from recordings import HERE, write_rows
from simulated_room import SimulatedRoom, figures_of, frames_of_rooms, words_of

RESULTS = HERE / "cameras.csv"
DEVICES = "headset", "phone", "wide", "glasses"
ROOMS, FIRST_SEED, ELSEWHERE = 12, 7001, 50  # late_depth.py has the same seeds; from a room to the one that is elsewhere
LAP_S, MAP_FRAMES = 16, 10
HARD = ["--with", "hands,feet,carpet,bare"]
# What is asked: frames, how many a second, and how `localize` looks at them.
Query = collections.namedtuple("Query", "frames hz mode")
QUERIES = {"single": Query(20, 1.25, "single"), "tracking": Query(60, 30, "tracking"), "elsewhere": Query(15, 1, "single")}
KEY = ["map", "query", "mode"]
COLUMNS = KEY + [
    "rooms", "frames", "accepted_percent", "within_5cm_5deg_percent_mean", "within_5cm_5deg_percent_worst", "median_cm", "p90_cm",
    "tracking", "wrong_accepted", "wrong_tracking", "worst_cm", "worst_deg", "worst_confidence", "ece", "elsewhere_frames",
    "elsewhere_accepted"]
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


def wanted_rows():
    """What the rows are of, as KEY says."""
    return itertools.product(DEVICES, DEVICES, ("single", "tracking"))


def tell(frame):
    print("WRONG room %d, map of %s, %s, %s, %s" % (
        frame.seed, frame.map, "query of " + frame.query if frame.here else "elsewhere, by " + frame.query, frame.mode,
        words_of(frame.answer)), flush=True)


def main():
    arguments = room_options.parser_of(__doc__, RESULTS, ROOMS).parse_args()
    found = collections.defaultdict(list)
    for frame in frames_of_rooms(arguments, lambda *room: Room(*room).frames()):
        found[frame.map, frame.query, frame.mode].append(frame)
        if is_wrong(frame):
            tell(frame)
    write_rows(arguments.results, COLUMNS, [{**dict(zip(KEY, key)), **figures_of(found[key])} for key in wanted_rows()])


if __name__ == "__main__":
    main()
