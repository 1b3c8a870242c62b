#!/usr/bin/env python3
"""How well does one localize in maps of walks without poses?  Beside maps of the same frames with the poses that the recordings hold.

    mapping_localized.py --spherecloud BIN [--keys N] [--only NAME ...]      rewrites rows of mapping_localized.csv, for review

A recording is mapped once by `map`, which does not read its poses ("found"), and once by `build`, which trusts them ("given").
Both models are published by each key.  Frames that are in neither map are localized one by one, and both are compared with
the same poses after a rigid alignment (`localize --align`), since a map without poses has a world of its own.  These are the
recording's ("given"), and of real walks also those that `map` finds for all of its frames ("found"): where each kind of map is the
better one beside its own kind of poses, the two trajectories differ, and the maps do not.
"""
import argparse
import concurrent.futures
import os
import pathlib
import statistics
import sys
import tempfile

sys.dont_write_bytecode = True
from private_key import NUMBERS, numbered_key
from recordings import HERE, Ledger, Recording, frames, require, run

RESULTS = HERE / "mapping_localized.csv"
ROOMS = range(6001, 6013)  # those of mapping.py
LAP = 100  # frames: the first lap is mapped, the second, from other places, is localized
# Frames of the map and of the queries.
REAL = {"redkitchen": ((0, 597, 3), (620, 799, 1)), "hololens": ((0, 198, 2), (1, 199, 2)), "hololens2": ((0, 998, 2), (1, 999, 2))}
POSES = ["given", "found"]
ETA, FAKES = 0.33, "patchwork"
COLUMNS = ["recording", "truth", "poses", "keys", "frames", "localized", "within_5cm_5deg", "worst_key", "median_cm", "p90_cm", "median_deg", "p90_deg"]


def make_model(poses, tool, source, folder):
    model = folder / (poses + ".model")
    if poses == "found":
        run([tool, "map", *source, "--model", model, "--json"])
    else:
        run([tool, "build", *source, "--save-model", model, "--map", folder / "unused.sphc", "--json"])
    return model


def localize(model, key, tool, queries):
    with tempfile.TemporaryDirectory(dir=model.parent) as scratch:
        folder = pathlib.Path(scratch)
        room = folder / "room.sphc"
        run([tool, "build", "--model", model, "--map", room, "--eta", ETA, "--fakes", FAKES, "--key", numbered_key(key, folder), "--ledger", folder / "ledger", "--json"])
        return run([tool, "localize", *queries, "--map", room, "--owner-note", str(room) + ".owner.json", "--mode", "single", "--align", "--json"])


def row_of(recording, truth, poses, answers):
    """Frames are summed over the keys; errors are the median over them of each key's own."""
    def middle(error, which, scale=1):
        return "%.2f" % statistics.median(scale * answer[error][which] for answer in answers)

    def total(name):
        return sum(answer[name] for answer in answers)

    return [recording, truth, poses, len(answers), total("frames"), total("localized"), total("within_5cm_5deg"), min(answer["within_5cm_5deg"] for answer in answers),
            middle("translation_error_m", "median", 100), middle("translation_error_m", "p90", 100), middle("rotation_error_deg", "median"),
            middle("rotation_error_deg", "p90")]


def measure(name, keys, tool, source, queries, folder):
    """`queries`: for each kind of truth the frames with it."""
    models = {poses: make_model(poses, tool, source, folder) for poses in POSES}
    for truth, frames_with_it in queries.items():
        for poses, model in models.items():
            yield row_of(name, truth, poses, [localize(model, key, tool, frames_with_it) for key in keys])


def with_found_poses(place, tool, folder):
    """The recording, with the poses that are found for all of its frames in place of its own."""
    run([tool, "map", *place, "--model", folder / "all.model", "--trajectory", folder / "all.tum", "--json"])
    return [*place, "--poses-from", folder / "all.tum"]


def measure_real(name, keys, tool, folder):
    of_map, of_queries = REAL[name]
    place = Recording(name, tool, folder).place("map")
    places = {"given": place, "found": with_found_poses(place, tool, folder)}
    yield from measure(name, keys, tool, place + frames(of_map), {truth: at + frames(of_queries) for truth, at in places.items()}, folder)


def measure_room(name, keys, tool, folder):
    walk, seed = folder / "walk", name[len("room"):]
    run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--frames", 2 * LAP, "--rate", 6.25, "--threads", 1, "--json"])
    place = ["--recording", walk]
    yield from measure(name, keys, tool, place + frames((0, LAP - 1, 1)), {"given": place + frames((LAP, 2 * LAP - 1, 1))}, folder)


WALKS = {**dict.fromkeys(REAL, measure_real), **{"room%d" % seed: measure_room for seed in ROOMS}}


def wanted_rows():
    """What the rows are of: the first columns of each."""
    return [(name, truth, poses) for name in WALKS for truth in (POSES if name in REAL else ["given"]) for poses in POSES]


def line_of(row):
    return ("%-12s beside %-6s poses, map of %-6s, %3s keys: %4s frames, %4s localized, %4s within 5 cm and 5 deg (worst key %s), median %s cm, "
            "p90 %s cm, median %s deg, p90 %s deg" % tuple(row))


def ledger_of(path):
    return Ledger(path, COLUMNS, 1, lambda row: list(WALKS).index(row[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping_localized.csv]")
    parser.add_argument("--keys", type=int, default=len(NUMBERS), choices=range(1, len(NUMBERS) + 1), metavar="N", help="how many [12]")
    parser.add_argument("--only", nargs="+", default=list(WALKS), choices=WALKS, metavar="NAME", help="what to measure; other rows stay [all]")
    arguments = parser.parse_args()
    require(name for name in arguments.only if name in REAL)
    keys = NUMBERS[:arguments.keys]
    ledger = ledger_of(arguments.results)
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        def measure(name):
            folder = pathlib.Path(scratch) / name
            folder.mkdir()
            rows = []
            for row in WALKS[name](name, keys, arguments.spherecloud, folder):
                print(line_of(row), flush=True)
                rows.append(row)
            return rows

        ledger.put([row for rows in pool.map(measure, arguments.only) for row in rows])


if __name__ == "__main__":
    main()
