#!/usr/bin/env python3
"""The localizer in a simulated world that is as nasty as the real one, through the command line alone.

    nasty.py --spherecloud BIN [--results FILE] [--rooms N] [--worlds NAME...] [--keep FOLDER]

For each world and each room, lap one is mapped and a part of lap two is localized in it, with both kinds of fakes, by keys
that differ from room to room.  A world is an option of `simulate`, or several at once.  nasty.csv has a row for each world,
number of frames in the map, kind of fakes and mode.  Every accepted pose that is wrong is printed with the commands that give
it again.  --keep keeps recordings, maps and answers, and takes those that are there: answers only of the same command.
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
import tempfile

sys.dont_write_bytecode = True
from accuracy import WORST_CM, WORST_DEG
from recordings import HERE, run

RESULTS = HERE / "nasty.csv"
ROOMS = list(range(3001, 3013))  # seeds of room and walk that nothing else uses
KEYS_A_ROOM = 2
ETA = 0.33
FAKES, MODES = ("patchwork", "gaussian"), ("single", "tracking")
LAP_S = 16
QUERY_FRAMES, QUERY_HZ = 10, 2.5

# How lap one and lap two are simulated, frames of lap one, and of how many of them maps are made.
World = collections.namedtuple("World", "lap_one lap_two recorded mapped")


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
}
ROW = ["world", "map_frames", "fakes", "mode"]
COLUMNS = ROW + ["rooms", "frames", "accepted_percent", "within_5cm_5deg_percent_median", "within_5cm_5deg_percent_worst",
                 "wrong_accepted", "worst_cm", "worst_deg", "worst_confidence"]


def key_of(room, number):
    return hashlib.sha256(b"spherecloud nasty key %d %d" % (room, number)).hexdigest() + "\n"


def words(command):
    return " ".join(map(str, command))


class Room:
    """One room in one world: its recordings, its maps, and every frame that was localized in them."""

    def __init__(self, tool, folder, world, seed):
        self.tool, self.folder, self.world, self.seed = tool, folder, world, seed
        self.version = hashlib.sha256(pathlib.Path(tool).read_bytes()).hexdigest()[:8]

    def simulate(self, arguments, *more):
        """A recording; those of equal arguments are made once."""
        arguments = [*map(str, arguments), *map(str, more), "--seed", str(self.seed), "--walk-seed", str(self.seed)]
        out = self.folder / ("walk_" + hashlib.sha256(words(arguments).encode()).hexdigest()[:12])
        command = [self.tool, "simulate", "--out", out, *arguments, "--threads", 1, "--json"]
        if not (out / "groundtruth.txt").exists():
            run(command)
        return out, words(command)

    def record(self):
        world = WORLDS[self.world]
        start = LAP_S + LAP_S * (self.seed - ROOMS[0]) / len(ROOMS)  # each room is entered elsewhere
        self.walk, made_map = self.simulate(["--frames", world.recorded, *world.lap_one], "--rate", world.recorded / LAP_S)
        self.query, made_query = self.simulate(world.lap_two, "--from", "%.2f" % start, "--frames", QUERY_FRAMES, "--rate", QUERY_HZ)
        self.commands = [made_map, made_query]
        return self

    def localize(self):
        """(map_frames, fakes, mode), a frame, and the commands that lead to it, of every frame."""
        recorded, mapped = WORLDS[self.world].recorded, WORLDS[self.world].mapped
        for map_frames, fakes, number in itertools.product(mapped, FAKES, range(KEYS_A_ROOM)):
            name = "%s_%d_%d_%s_%d" % (self.world, self.seed, map_frames, fakes, number)
            file, key = self.folder / (name + ".sphc"), self.folder / (name + ".key")
            if not key.exists():
                key.write_text(key_of(self.seed, number))
                key.chmod(0o600)
            step = recorded // map_frames
            build = [self.tool, "build", "--recording", self.walk, "--last", step * map_frames - 1, "--step", step, "--map", file,
                     "--eta", ETA, "--fakes", fakes, "--key", key, "--ledger", self.folder / (name + ".ledger"), "--json"]
            if not file.exists():
                run(build)
            for mode in MODES:
                answers = self.folder / ("%s_%s_%s.frames" % (name, mode, self.version))
                query = [self.tool, "localize", "--recording", self.query, "--map", file, "--mode", mode, "--owner-note",
                         str(file) + ".owner.json", "--frames-json", answers, "--json"]
                if not answers.exists():
                    run(query)
                for line in answers.read_text().splitlines():
                    yield (str(map_frames), fakes, mode), json.loads(line), [*self.commands, words(build), words(query)]


def errors(frame):
    return 100 * frame["error"]["translation_m"], frame["error"]["rotation_deg"]


def is_wrong(frame):
    if not frame["localized"]:
        return False
    centimetres, degrees = errors(frame)
    return centimetres > WORST_CM or degrees > WORST_DEG


def is_close(frame):
    return frame["localized"] and errors(frame)[0] <= 5 and errors(frame)[1] <= 5


def row_of(world, variant, rooms):
    """rooms: of each the frames."""
    frames = [frame for room in rooms for frame in room]
    wrong = sorted((frame for frame in frames if is_wrong(frame)), key=errors)
    close = [100 * statistics.mean(map(is_close, room)) for room in rooms]
    return dict(zip(COLUMNS, [
        world, *variant, str(len(rooms)), str(len(frames)),
        "%.1f" % (100 * statistics.mean(frame["localized"] for frame in frames)),
        "%.1f" % statistics.median(close), "%.1f" % min(close), str(len(wrong)),
        *(["%.1f" % errors(wrong[-1])[0], "%.1f" % max(errors(f)[1] for f in wrong),
           "%.3f" % max(f["confidence"] for f in wrong)] if wrong else ["", "", ""])]))


def tell(world, seed, variant, frame, commands):
    print("WRONG %s room %d, map of %s frames, %s, %s, frame %d: %.1f cm, %.1f deg, confidence %.3f, sigma %.1f cm, "
          "%d of %d matches, %s" % (
        world, seed, *variant, frame["sequence"], *errors(frame), frame["confidence"],
        100 * frame["sigma"]["translation_m"], frame["inliers"], frame["matches"], frame["state"]))
    print("".join("    %s\n" % command for command in commands), flush=True)


def measure(tool, folder, worlds, seeds):
    """All rows, anew after each room.  Worlds are measured on every processor; the walks that several share are made first."""
    frames = collections.defaultdict(lambda: collections.defaultdict(list))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for seed in seeds:
            Room(tool, folder, "plain", seed).record()
            found = pool.map(lambda world: list(Room(tool, folder, world, seed).record().localize()), worlds)
            for world, localized in zip(worlds, found):
                for variant, frame, commands in localized:
                    frames[world, variant][seed].append(frame)
                    if is_wrong(frame):
                        tell(world, seed, variant, frame, commands)
            yield [row_of(world, variant, list(rooms.values())) for (world, variant), rooms in frames.items()]


def write(path, rows):
    with path.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [nasty.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), choices=range(1, len(ROOMS) + 1), metavar="N", help="how many [12]")
    parser.add_argument("--worlds", nargs="+", default=list(WORLDS), choices=list(WORLDS), metavar="NAME", help="some alone [all]")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="where recordings and maps are kept")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for rows in measure(arguments.spherecloud, folder, arguments.worlds, ROOMS[:arguments.rooms]):
            write(arguments.results, rows)


if __name__ == "__main__":
    main()
