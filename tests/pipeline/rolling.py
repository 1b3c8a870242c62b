#!/usr/bin/env python3
"""What a rolling shutter costs, and what `--row-time-ns` of build and localize takes back.

    rolling.py --spherecloud BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites rolling.csv, for review

Every room is mapped by a headset and by a telephone, on a lap of ten seconds (brisk: a quarter of a turn in two seconds), and each
localizes in its own maps on lap two, two seconds at 30 Hz: frame by frame, in tracking, and with odometry.  Both have cameras that
expose at once, or in 20 ms from the first row to the last ("rolling"); where the row time is told they are "straightened".  So do frames of
another room, of which no pose is right: "elsewhere".  Half of the rooms are as they are; in the other half are the holder's hands
and feet, carpet, and bare walls.  Every accepted pose that is wrong is printed.
"""
import collections
import itertools
import sys

sys.dont_write_bytecode = True
import room_options
from nasty import is_wrong
from recordings import HERE, write_rows
from simulated_room import SimulatedRoom, figures_of, frames_of_rooms, words_of

RESULTS = HERE / "rolling.csv"
ROOMS, FIRST_SEED, ELSEWHERE = 12, 8001, 50  # mapping_flats.py has the same seeds; from a room to the one that is elsewhere
LAP_S, MAP_FRAMES, FRAMES, RATE_HZ, ELSEWHERE_FRAMES = 10, 10, 60, 30, 15
HARD = ["--with", "hands,feet,carpet,bare"]
ROW_TIME_NS = {"headset": 41667, "phone": 18519}  # 20 ms for 480 and 1080 rows
SHUTTER_NAMES = AT_ONCE, ROLLING, TOLD = "at once", "rolling", "straightened"
SHUTTERS = (AT_ONCE, AT_ONCE), (AT_ONCE, ROLLING), (AT_ONCE, TOLD), (ROLLING, ROLLING), (ROLLING, TOLD), (TOLD, TOLD)  # map, query
MODES = {"single": ["--mode", "single"], "tracking": [], "odometry": ["--odometry"]}
POSES_HZ = 60  # that a map is made with
KEY = ["device", "map_shutter", "query_shutter", "mode"]
COLUMNS = KEY + [
    "rooms", "frames", "accepted_percent", "within_5cm_5deg_percent_mean", "within_5cm_5deg_percent_worst", "median_cm", "p90_cm",
    "median_deg", "p90_deg", "translation_over_sigma_median", "rotation_over_sigma_median", "tracking", "wrong_accepted",
    "wrong_tracking", "worst_cm", "worst_deg", "worst_confidence", "elsewhere_frames", "elsewhere_accepted"]
Frame = collections.namedtuple("Frame", "seed device map query mode here answer")


def told(device, shutter):
    return ["--row-time-ns", ROW_TIME_NS[device]] if shutter == TOLD else []


class Room(SimulatedRoom):
    def __init__(self, tool, folder, number):
        super().__init__(tool, folder, FIRST_SEED + number, "rolling key %d" % number, HARD if number % 2 else [])
        self.number = number

    def record_by(self, device, shutter, name, *arguments, seed=None):
        kind, rows = ("at_once", []) if shutter == AT_ONCE else ("rolling", ["--row-time-ns", ROW_TIME_NS[device]])
        return self.record("_".join((name, device, kind)), "--cameras", device, "--lap", LAP_S, *rows, *arguments, seed=seed)

    def map_by(self, device, shutter):
        walk = self.record_by(device, shutter, "map", "--frames", MAP_FRAMES, "--rate", MAP_FRAMES / LAP_S, "--poses", POSES_HZ)
        return self.build("%s_%d" % (device, SHUTTER_NAMES.index(shutter)), walk, *told(device, shutter))

    def query(self, device, shutter):
        start = LAP_S + (LAP_S - FRAMES / RATE_HZ) * self.number / ROOMS  # each room is entered elsewhere
        return self.record_by(device, shutter, "here", "--from", "%.2f" % start, "--frames", FRAMES, "--rate", RATE_HZ)

    def elsewhere(self, device, shutter):
        return self.record_by(device, shutter, "elsewhere", "--from", LAP_S, "--frames", ELSEWHERE_FRAMES, "--rate", 1,
                              seed=self.seed + ELSEWHERE)

    def frames(self):
        for device, (of_map, of_query) in itertools.product(ROW_TIME_NS, SHUTTERS):
            file = self.map_by(device, of_map)
            for here, recording in ((True, self.query(device, of_query)), (False, self.elsewhere(device, of_query))):
                for mode, arguments in MODES.items():
                    name = "%s_%d" % (mode, SHUTTER_NAMES.index(of_query))
                    for answer in self.localize(file, recording, name, *arguments, *told(device, of_query)):
                        yield Frame(self.seed, device, of_map, of_query, mode, here, answer)


def wanted_rows():
    """What the rows are of, as KEY says."""
    return sorted((device, *shutters, mode) for device, shutters, mode in itertools.product(ROW_TIME_NS, SHUTTERS, MODES))


def tell(frame):
    print("WRONG room %d, %s, map %s, query %s, %s, %s, %s" % (
        frame.seed, frame.device, frame.map, frame.query, frame.mode, "here" if frame.here else "elsewhere", words_of(frame.answer)),
        flush=True)


def main():
    arguments = room_options.parser_of(__doc__, RESULTS, ROOMS).parse_args()
    found = collections.defaultdict(list)
    for frame in frames_of_rooms(arguments, lambda *room: Room(*room).frames()):
        found[frame[1:5]].append(frame)
        if is_wrong(frame):
            tell(frame)
    write_rows(arguments.results, COLUMNS, [{**dict(zip(KEY, key)), **figures_of(frames)} for key, frames in ((key, found[key]) for key in wanted_rows())])


if __name__ == "__main__":
    main()
