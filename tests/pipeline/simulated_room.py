"""A simulated room, through the command line alone: its recordings, its maps, and what is localized in them."""
import concurrent.futures
import json
import os
import sys

import room_options
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
