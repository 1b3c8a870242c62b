#!/usr/bin/env python3
"""Many maps in one localizer: is a cold frame found in the right room, and what does each map more cost?

    maps.py --spherecloud BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites maps.csv, for review

Every simulated room has a map of lap one, with a key of its own; of every fourth room there is a double: the same room after its
things were moved (another arrangement), with a map of its own.  Frames of lap two are localized, each alone, in the map of their
room alone and in all maps together.  A frame of a room that has a double is right where its pose is right in either.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import statistics
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import WORST_CM, WORST_DEG
from nasty import errors
from private_key import key_of
from recordings import HERE, run, write_rows

RESULTS = HERE / "maps.csv"
ROOMS, OF_DOUBLES, FIRST_SEED = 64, 4, 4001  # maps in all; a double for each so many rooms; hints.py and nasty.py have seeds of these too
LAP_S, MAP_FRAMES, QUERY_FRAMES, QUERY_HZ = 16, 30, 6, 2.0
ETA, FAKES = 0.33, "patchwork"
COLUMNS = ["maps", "frames", "localized_percent", "within_5cm_5deg_percent", "right_map_percent_of_localized", "wrong_accepted",
           "match_ms_median", "frame_ms_median"]


def wanted_rows():
    """What the rows are of: the first column of each."""
    return [(1,), (ROOMS,)]


class Room:
    """A map, and frames of the same place later."""

    def __init__(self, tool, folder, number):
        self.tool, self.folder, self.number = tool, folder, number
        block, place = divmod(number, OF_DOUBLES + 1)
        self.is_double = place == OF_DOUBLES
        self.seed = FIRST_SEED + block * OF_DOUBLES + (0 if self.is_double else place)  # a double is the first of its block again
        self.map, self.query = folder / ("map_%d.sphc" % number), folder / ("query_%d" % number)

    def simulate(self, out, *arguments):
        if not (out / "groundtruth.txt").exists():
            run([self.tool, "simulate", "--out", out, "--seed", self.seed, "--walk-seed", self.seed, "--threads", 1, "--json",
                 *arguments, *(["--arrangement", 2] if self.is_double else [])])

    def make(self):
        walk = self.folder / ("walk_%d" % self.number)
        key = key_of("maps key %d" % self.number, self.folder / ("key_%d" % self.number))
        self.simulate(walk, "--frames", MAP_FRAMES, "--rate", MAP_FRAMES / LAP_S)
        self.simulate(self.query, "--from", LAP_S + self.number % LAP_S, "--frames", QUERY_FRAMES, "--rate", QUERY_HZ)
        if not self.map.exists():
            run([self.tool, "build", "--recording", walk, "--map", self.map, "--eta", ETA, "--fakes", FAKES, "--key", key,
                 "--ledger", self.folder / ("ledger_%d" % self.number), "--json"])
        return self

    def localize(self, rooms):
        """Answers to the frames of this room in the maps of `rooms`, with the number of the map's room."""
        answers = self.folder / ("answers_%d_%d" % (self.number, len(rooms)))
        maps = [part for room in rooms for part in ("--map", room.map, "--owner-note", str(room.map) + ".owner.json")]
        run([self.tool, "localize", "--recording", self.query, *maps, "--mode", "single", "--frames-json", answers, "--json"])
        for line in answers.read_text().splitlines():
            frame = json.loads(line)
            yield frame, rooms[frame["map"]] if frame["map"] is not None else None


def row_of(maps, answers):
    """answers: (room, frame, room of the map that was found)."""
    localized = [(room, frame, found) for room, frame, found in answers if frame["localized"]]
    right = [(room, frame) for room, frame, found in localized if found.seed == room.seed]
    close = [f for _, f in right if errors(f)[0] <= 5 and errors(f)[1] <= 5]
    sound = [f for _, f in right if errors(f)[0] <= WORST_CM and errors(f)[1] <= WORST_DEG]
    share = lambda part, whole: "%.1f" % (100 * len(part) / max(1, len(whole)))
    return dict(zip(COLUMNS, [
        maps, len(answers), share(localized, answers), share(close, answers), share(right, localized), len(localized) - len(sound),
        *("%.2f" % (statistics.median(time(frame) for _, frame, _ in answers) / 1000)
          for time in (lambda f: f["time_us"]["match"], lambda f: f["time_us"]["total"]))]))


def measure(tool, folder, count):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rooms = list(pool.map(lambda number: Room(tool, folder, number).make(), range(count)))
        for together in (False, True):
            found = pool.map(lambda room: [(room, *answer) for answer in room.localize(rooms if together else [room])], rooms)
            yield row_of(count if together else 1, [answer for answers in found for answer in answers])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [maps.csv]")
    parser.add_argument("--rooms", type=int, default=ROOMS, metavar="N", help="how many maps [%d]" % ROOMS)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="where recordings and maps are kept")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        rows = list(measure(arguments.spherecloud, folder, arguments.rooms))
    write_rows(arguments.results, COLUMNS, rows)


if __name__ == "__main__":
    main()
