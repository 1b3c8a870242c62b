#!/usr/bin/env python3
"""The localizer in a simulated world that is as nasty as the real one, through the command line alone.

    nasty.py --spherecloud BIN [--results FILE] [--rooms N] [--worlds NAME...] [--frames FILE] [--keep FOLDER]

For each world and each of its rooms, lap one is mapped and a part of lap two is localized in it, with both kinds of fakes, by
keys that differ from room to room: frame by frame at 5 Hz, and at the 30 Hz of a headset in tracking, without and with odometry.
A world is an option of `simulate`, or several at once; no two worlds share a room.
So are frames of another room of this world, of which no pose is right: "elsewhere".  nasty.csv has a row for each world, number of
frames in the map, kind of fakes and mode, and one for all of them.  Rows of worlds stay until all their rooms are measured.  Every accepted
pose that is wrong is printed with the commands that give it again.  --frames writes a line for every frame.  --keep keeps
recordings, maps and answers, and takes those that are there: answers only of the same command.
"""
import argparse
import collections
import concurrent.futures
import csv
import hashlib
import itertools
import json
import os
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True
import confidence
import room_options
from accuracy import WORST_CM, WORST_DEG
from private_key import key_of
from recordings import HERE, read_rows, run, write_csv

RESULTS = HERE / "nasty.csv"
# Seeds of rooms and walks, rooms of each world, and from one to another room.  Other scripts have some of the seeds too: moving.py
# the first, hints.py and maps.py those of the world of windows, rig.py and amplitude.py those of the flat.
FIRST_SEED, ROOMS, ELSEWHERE = 3001, 12, 50
KEYS_A_ROOM = 2
ETA = 0.33
FAKES = "patchwork", "gaussian"
LAP_S, FLAT_LAP_S = 16, 150
# At how many frames a second, for how long, in the maps of how many keys, and what else is said to `localize`.
Mode = collections.namedtuple("Mode", "hz seconds keys arguments")
MODES = {"single": Mode(5, 8, KEYS_A_ROOM, ["--mode", "single"]), "tracking": Mode(30, 4, 1, ["--mode", "tracking"]),
         "odometry": Mode(30, 4, 1, ["--mode", "tracking", "--odometry"])}
ELSEWHERE_FRAMES, ELSEWHERE_HZ = 15, 1

# How lap one and lap two are simulated, frames of lap one, of how many of them maps are made, and how long a lap takes.
World = collections.namedtuple("World", "lap_one lap_two recorded mapped lap_s", defaults=[LAP_S])


def same(names):
    """The map is of that world too."""
    return World(["--with", names], ["--with", names], 10, (10, 3))


def later(*arguments):
    """The map is of the room as it is; something has changed since."""
    return World([], list(arguments), 30, (10, 3))


WORLDS = {
    "plain": World([], [], 30, (30, 10, 3)),
    **{name: same(name) for name in ("hands", "feet", "people", "carpet", "parquet", "tiles", "bare", "doubles", "mirror", "window")},
    "moved": later("--arrangement", 2), "day": later("--with", "day"), "night": later("--with", "night"),
    "dark": later("--with", "dark"),
    # What a real room has at once: seen by a telephone, a hall of equal things, the next evening.
    "telephone": same("hands,feet,carpet,bare"), "hall": same("tiles,bare,doubles,mirror,window"),
    "evening": later("--arrangement", 2, "--with", "people,hands,night"),
    # A floor that repeats exactly, and a holder who looks down on it.
    "bathroom": same("tiles,feet"),
    # New worlds come last, since seeds follow the order.
    "menu": same("menu"),
    # Eight rooms with the same furniture in each.
    "flat": World(["--with", "flat,doubles"], ["--with", "flat,doubles"], 64, (64,), FLAT_LAP_S),
    # Walls and shelves that repeat exactly: with what a room has besides, and with little else.
    "wallpaper": same("wallpaper"), "binders": same("binders"), "papered": same("wallpaper,bare,tiles"),
    "office": same("binders,carpet,bare,doubles"),
}
ROW = ["world", "map_frames", "fakes", "mode"]
COLUMNS = ROW + ["rooms", "frames", "accepted", "within_5cm_5deg_percent_median", "within_5cm_5deg_percent_worst",
                 "wrong_accepted", "wrong_tracking", "worst_cm", "worst_deg", "worst_confidence", "ece", "sure_right_percent",
                 "elsewhere_frames", "elsewhere_accepted"]
ALL = "all"
SUMS = ["frames", "accepted", "wrong_accepted", "wrong_tracking", "elsewhere_frames", "elsewhere_accepted"]
WORST = ["worst_cm", "worst_deg", "worst_confidence"]
LINE = ["world", "room", "map_frames", "fakes", "mode", "key", "here", "frame", "localized", "cm", "deg", "confidence", "sigma_cm",
        "sigma_deg", "inliers", "matches", "state"]
Frame = collections.namedtuple("Frame", "world seed variant key here answer commands")


def words(command):
    return " ".join(map(str, command))


def seed_of(world, number):
    return FIRST_SEED + 100 * list(WORLDS).index(world) + number


class Room:
    """One room of one world: its recordings, its maps, and every frame that was localized in them."""

    def __init__(self, tool, folder, world, number):
        self.tool, self.folder, self.world, self.number, self.seed = tool, folder, world, number, seed_of(world, number)
        self.version = hashlib.sha256(pathlib.Path(tool).read_bytes()).hexdigest()[:8]

    def simulate(self, name, seed, arguments, *more):
        arguments = [*map(str, arguments), *map(str, more), "--seed", str(seed), "--walk-seed", str(seed)]
        out = self.folder / name
        command = [self.tool, "simulate", "--out", out, *arguments, "--threads", 1, "--json"]
        if not (out / "groundtruth.txt").exists():
            run(command)
        return out, words(command)

    def record(self):
        world = WORLDS[self.world]
        start = world.lap_s + world.lap_s * self.number / ROOMS  # each room is entered elsewhere
        self.walk, self.made_map = self.simulate("map", self.seed, ["--frames", world.recorded, *world.lap_one], "--rate",
                                                 world.recorded / world.lap_s)
        self.here = {hz: self.simulate("here_%d" % hz, self.seed, world.lap_two, "--from", "%.2f" % start, "--frames", hz * seconds,
                                       "--rate", hz) for hz, seconds in sorted({(mode.hz, mode.seconds) for mode in MODES.values()})}
        self.elsewhere = self.simulate("elsewhere", self.seed + ELSEWHERE, world.lap_two, "--frames", ELSEWHERE_FRAMES, "--rate",
                                       ELSEWHERE_HZ)
        return self

    def build(self, map_frames, fakes, number):
        """A map, and the command that makes it."""
        name = "%d_%s_%d" % (map_frames, fakes, number)
        file = self.folder / (name + ".sphc")
        key = key_of("nasty key %d %d" % (self.seed, number), self.folder / (name + ".key"))
        step = WORLDS[self.world].recorded // map_frames
        command = [self.tool, "build", "--recording", self.walk, "--last", step * map_frames - 1, "--step", step, "--map", file,
                   "--eta", ETA, "--fakes", fakes, "--key", key, "--ledger", self.folder / (name + ".ledger"), "--json"]
        if not file.exists():
            run(command)
        return file, words(command)

    def ask(self, file, mode, here):
        """What `localize` says of each frame, and the commands that lead to it."""
        recording, made_query = self.here[MODES[mode].hz] if here else self.elsewhere
        answers = file.with_suffix(".%s_%s_%s.frames" % (mode, "here" if here else "elsewhere", self.version))
        command = [self.tool, "localize", "--recording", recording, "--map", file, *MODES[mode].arguments, "--owner-note",
                   str(file) + ".owner.json", "--frames-json", answers, "--json"]
        if not answers.exists():
            run(command)
        return map(json.loads, answers.read_text().splitlines()), [made_query, words(command)]

    def localize(self):
        """Every frame of every map.  Elsewhere is asked of the first key's maps."""
        for map_frames, fakes, number in itertools.product(WORLDS[self.world].mapped, FAKES, range(KEYS_A_ROOM)):
            file, build = self.build(map_frames, fakes, number)
            asked = [mode for mode in MODES if number < MODES[mode].keys]
            for mode, here in itertools.product(asked, (True,) if number else (True, False)):
                answers, commands = self.ask(file, mode, here)
                for answer in answers:
                    yield Frame(self.world, self.seed, (str(map_frames), fakes, mode), number, here, answer,
                                [self.made_map, build, *commands])


def errors(answer):
    return 100 * answer["error"]["translation_m"], answer["error"]["rotation_deg"]


def is_wrong(frame):
    if not frame.answer["localized"]:
        return False
    centimetres, degrees = errors(frame.answer)
    return not frame.here or centimetres > WORST_CM or degrees > WORST_DEG


def is_close(frame):
    return frame.answer["localized"] and confidence.pose_of(frame.answer).right


def by_room(frames):
    rooms = collections.defaultdict(list)
    for frame in frames:
        rooms[frame.seed].append(frame)
    return list(rooms.values())


def row_of(world, variant, frames):
    here = [frame for frame in frames if frame.here]
    accepted = [frame for frame in here if frame.answer["localized"]]
    wrong = [frame.answer for frame in accepted if is_wrong(frame)]
    elsewhere = [frame for frame in frames if not frame.here]
    close = [100 * statistics.mean(map(is_close, room)) for room in by_room(here)]
    poses = [confidence.pose_of(frame.answer) for frame in accepted]
    return dict(zip(COLUMNS, [
        world, *variant, str(len(close)), str(len(here)), str(len(accepted)), "%.1f" % statistics.median(close),
        "%.1f" % min(close), str(len(wrong)), str(sum(answer["state"] == "tracking" for answer in wrong)),
        *(["%.1f" % max(errors(answer)[0] for answer in wrong), "%.1f" % max(errors(answer)[1] for answer in wrong),
           "%.3f" % max(answer["confidence"] for answer in wrong)] if wrong else ["", "", ""]),
        "%.3f" % confidence.calibration_error(poses) if poses else "",
        confidence.percent(pose.right for pose in poses if pose.confidence >= confidence.SURE),
        str(len(elsewhere)), str(sum(map(is_wrong, elsewhere)))]))


def sum_of(rows):
    """One row for all: sums, and the worst."""
    total = dict.fromkeys(COLUMNS, "")
    total["world"] = ALL
    total["rooms"] = str(sum(max(int(row["rooms"]) for row in rows if row["world"] == world)
                             for world in {row["world"] for row in rows}))
    for column in SUMS:
        total[column] = str(sum(int(row[column]) for row in rows))
    for column in WORST:
        total[column] = max((row[column] for row in rows if row[column]), key=float, default="")
    return total


def tell(frame):
    answer = frame.answer
    print("WRONG %s room %d, map of %s frames, %s, %s, %s, frame %d: %.1f cm, %.1f deg, confidence %.3f, sigma %.1f cm, "
          "%d of %d matches, %s" % (
        frame.world, frame.seed, *frame.variant, "here" if frame.here else "elsewhere", answer["sequence"], *errors(answer),
        answer["confidence"], 100 * answer["sigma"]["translation_m"], answer["inliers"], answer["matches"], answer["state"]))
    print("".join("    %s\n" % command for command in frame.commands), flush=True)


def line_of(frame):
    answer, given = frame.answer, frame.answer["localized"]
    return [frame.world, frame.seed, *frame.variant, frame.key, int(frame.here), answer["sequence"], int(given), *(
        ["%.2f" % errors(answer)[0], "%.3f" % errors(answer)[1], "%.4f" % answer["confidence"],
         "%.3f" % (100 * answer["sigma"]["translation_m"]), "%.4f" % answer["sigma"]["rotation_deg"], answer["inliers"],
         answer["matches"]] if given else [""] * 7), answer["state"]]


def localize_room(tool, keep, world, number):
    with room_options.folder_of(keep and keep / ("%s_%d" % (world, seed_of(world, number)))) as folder:
        return list(Room(tool, folder, world, number).record().localize())


def measure(tool, keep, worlds, count, lines):
    """A world and its rows, when all its rooms are in; a room on each processor."""
    found = collections.defaultdict(list)
    tasks = [(world, number) for world in worlds for number in range(count)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for at, frames in enumerate(pool.map(lambda task: localize_room(tool, keep, *task), tasks)):
            world, number = tasks[at]
            for frame in frames:
                found[frame.variant].append(frame)
                if lines:
                    lines.writerow(line_of(frame))
                if is_wrong(frame):
                    tell(frame)
            if sys.stderr.isatty():
                print("\r%d of %d rooms" % (at + 1, len(tasks)), end="", file=sys.stderr)
            if number + 1 == count:
                yield world, [row_of(world, variant, of_row) for variant, of_row in found.items()]
                found.clear()


def read(path):
    if not path.exists():
        return []
    return [row for row in read_rows(path) if list(row) == COLUMNS and row["world"] in WORLDS]


def write(path, rows):
    order = list(WORLDS)
    rows = sorted(rows, key=lambda row: order.index(row["world"]))  # stable
    write_csv(path, [COLUMNS, *(row.values() for row in [sum_of(rows), *rows])])


def main():
    parser = room_options.parser_of(__doc__, RESULTS, ROOMS)
    parser.add_argument("--worlds", nargs="+", default=list(WORLDS), choices=list(WORLDS), metavar="NAME", help="some alone [all]")
    parser.add_argument("--frames", type=argparse.FileType("w"), metavar="FILE", help="a line for every frame")
    arguments = parser.parse_args()
    lines = csv.writer(arguments.frames, lineterminator="\n") if arguments.frames else None
    if lines:
        lines.writerow(LINE)
    rows = read(arguments.results)
    for world, fresh in measure(arguments.spherecloud, arguments.keep, arguments.worlds, arguments.rooms, lines):
        rows = [row for row in rows if row["world"] != world] + fresh
        write(arguments.results, rows)


if __name__ == "__main__":
    main()
