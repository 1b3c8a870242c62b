#!/usr/bin/env python3
"""Is a frame without a pose told why?  Frames under conditions, in maps of simulated rooms and of recordings, and how often
each hint is set where its condition holds and where it does not.

    hints.py --spherecloud BIN --lab BIN [--rooms N] [--keys N] [NAME...]      rewrites rows of hints.csv, for review

Conditions are made of healthy frames by spherecloud-lab hints; those of the simulated rooms alone by options of simulate.
"""
import concurrent.futures
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import room_options
from accuracy import Place
from negative import elsewhere_of, publish
from private_key import NUMBERS, key_of
from recordings import HERE, Ledger, run

RESULTS = HERE / "hints.csv"
ROOMS = list(range(4001, 4013))  # seeds of room and walk; maps.py and the world of windows of nasty.py have them too
RECORDINGS = ["redkitchen", "hololens", "hololens_blocks"]
SEQUENCES = 2  # of 30 frames
ETA = 0.33
LAP_S, RATE = 16, 5
MAP_FRAMES, QUERY_FRAMES = 30, 15

# Options of the query alone, in the map of the room as it is; and of map and query, where the map has few frames: equal things
# stand there twice, and little else is known.
LATER = {"lamps off, dusk": ["--with", "dark"]}
HALL, HALL_MAP_STEP = ["--with", "tiles,bare,doubles,mirror,window"], 10
# What such frames should be told; nothing where they are healthy.
TOLD = {"lamps off, dusk": "too dark", "hall, a map of 3 frames": "ambiguous",
        "another room": "not in the map", "another place": "not in the map"}
HINTS = ["too dark", "too fast", "too plain", "no depth in range", "not in the map", "ambiguous"]
COUNTS = ["frames", "without_pose", "told"] + HINTS
COLUMNS = ["place", "condition", "mode", "maps"] + [name.replace(" ", "_") for name in COUNTS]


class Room:
    """A simulated room: its map, and walks of lap two."""

    def __init__(self, tool, folder, seed):
        self.tool, self.folder, self.seed = tool, folder, seed

    def simulate(self, name, *arguments):
        out = self.folder / ("%d_%s" % (self.seed, name))
        if not out.exists():
            run([self.tool, "simulate", "--out", out, "--seed", self.seed, "--walk-seed", self.seed, "--threads", 1, *arguments, "--json"])
        return out

    def map(self, name="plain", step=1, arguments=()):
        walk = self.simulate("map_" + name, "--frames", MAP_FRAMES, "--rate", MAP_FRAMES / LAP_S, *arguments)
        file = self.folder / ("%d_%s.sphc" % (self.seed, name))
        if not file.exists():
            key = key_of("hints key %d" % self.seed, self.folder / ("%d.key" % self.seed))
            run([self.tool, "build", "--recording", walk, "--step", step, "--map", file, "--eta", ETA, "--key", key, "--ledger",
                 str(file) + ".ledger", "--json"])
        return file

    def query(self, name="plain", *arguments):
        start = LAP_S * (1 + (self.seed - ROOMS[0]) / len(ROOMS))  # each room is entered elsewhere
        return self.simulate("query_" + name, "--frames", QUERY_FRAMES, "--rate", RATE, "--from", "%.2f" % start, *arguments)


def rows_of(lab, source, file, place, condition=None):
    """Under all conditions, or as the frames are, which is the condition then."""
    only = ["--only", "healthy"] if condition else []
    for row in run([lab, "hints", *source, "--map", file, "--sequences", SEQUENCES, *only, "--json"]):
        told = {"told": row[TOLD[condition]]} if condition in TOLD else {}
        yield (place, condition or row["condition"], row["mode"]), row | told


def rows_of_room(tool, lab, folder, seed):
    room = Room(tool, folder, seed)
    other = Room(tool, folder, ROOMS[(ROOMS.index(seed) + 1) % len(ROOMS)])
    file = room.map()
    yield from rows_of(lab, ["--recording", room.query()], file, "rooms")
    yield from rows_of(lab, ["--recording", other.query()], file, "rooms", "another room")
    for number, (condition, arguments) in enumerate(LATER.items()):
        yield from rows_of(lab, ["--recording", room.query("later%d" % number, *arguments)], file, "rooms", condition)
    yield from rows_of(lab, ["--recording", room.query("hall", *HALL)], room.map("hall", HALL_MAP_STEP, HALL), "rooms",
                       "hall, a map of 3 frames")


def rows_of_recording(tool, lab, folder, name, keys):
    """Hints of the image do not depend on the key: under one key all conditions, under the others those that do."""
    place = Place(name, tool, folder)
    for key in NUMBERS[:keys]:
        with tempfile.TemporaryDirectory(dir=folder) as own:
            file = publish(tool, place, pathlib.Path(own), "patchwork", key)
            yield from rows_of(lab, place.recording.source("query"), file, name, None if key == 1 else "healthy")
            for source in elsewhere_of(place):
                yield from rows_of(lab, source, file, name, "another place")


def add(sums, key, row):
    known = sums.setdefault(key, dict.fromkeys(COUNTS, 0) | {"maps": 0})
    for name in COUNTS:
        known[name] += row[name]
    known["maps"] += 1


def measure(arguments):
    """The sums of the rooms, and of each recording, when all is in."""
    with room_options.folder_of(arguments.keep) as folder:
        tools = arguments.spherecloud, arguments.lab
        if "rooms" in arguments.names:
            sums = {}
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
                list(pool.map(lambda seed: Room(tools[0], folder, seed).query(), ROOMS))
                for rows in pool.map(lambda seed: list(rows_of_room(*tools, folder, seed)), ROOMS[:arguments.rooms]):
                    for key, row in rows:
                        add(sums, key, row)
            yield sums
        for name in [name for name in arguments.names if name != "rooms"]:
            sums = {}
            with tempfile.TemporaryDirectory() as own:
                for key, row in rows_of_recording(*tools, pathlib.Path(own), name, arguments.keys):
                    add(sums, key, row)
            yield sums


def ledger_of(path):
    places = ["rooms", *RECORDINGS]  # and others, which may be named
    return Ledger(path, COLUMNS, 1, lambda row: places.index(row[0]) if row[0] in places else len(places))


def main():
    parser = room_options.parser_of(__doc__, RESULTS, len(ROOMS))
    parser.add_argument("--lab", required=True)
    parser.add_argument("--keys", type=int, default=len(NUMBERS), choices=range(1, len(NUMBERS) + 1), metavar="N", help="how many [12]")
    parser.add_argument("names", nargs="*", default=["rooms", *RECORDINGS], metavar="NAME", help="rooms, or recordings [all]")
    arguments = parser.parse_args()
    ledger = ledger_of(arguments.results)
    for sums in measure(arguments):
        ledger.put([*key, row["maps"], *(row[name] for name in COUNTS)] for key, row in sums.items())


if __name__ == "__main__":
    main()
