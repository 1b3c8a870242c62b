#!/usr/bin/env python3
"""What do masks by amplitude do to poses?  Raw depth of the simulated headset, localized without masks and with them.

    amplitude.py --spherecloud BIN [--rooms N]      rewrites amplitude.csv, for review

A ToF module that drops nothing measures the query; the map is made of what one measures that drops what it does not believe.
"""
import concurrent.futures
import itertools
import os
import statistics
import sys

sys.dont_write_bytecode = True
import room_options
from private_key import key_of
from recordings import HERE, run, write_csv

RESULTS = HERE / "amplitude.csv"
ROOMS = list(range(5001, 5013))  # seeds of room and walk; rig.py and the flat of nasty.py have them too
MASKS = 0, 75  # the least amplitude: any, and SPHC_SIMULATED_FAINT
LAP_S, FRAMES = 16, 30
ETA = 0.33
# What the world is made of, and of every how many frames of lap one there is a map.
WORLDS = {"room": ([], 1), "room, thin map": ([], 5), "hall, thin map": (["--with", "tiles,bare,doubles,mirror,window"], 5)}
COLUMNS = ["world", "amplitude_min", "rooms", "frames", "localized", "right", "wrong", "median_mm", "worst_median_mm", "p90_mm",
           "worst_p90_mm", "worst_mm"]


def wanted_rows():
    """What the rows are of: the first columns of each."""
    return itertools.product(WORLDS, MASKS)


def simulate(tool, out, seed, *arguments):
    if not out.exists():
        run([tool, "simulate", "--out", out, "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", FRAMES / LAP_S,
             "--threads", 1, *arguments, "--json"])
    return out


def build(tool, walk, step, seed, file):
    key = key_of("amplitude key %d" % seed, file.with_suffix(".key"))
    run([tool, "build", "--recording", walk, "--step", step, "--map", file, "--eta", ETA, "--key", key,
         "--ledger", file.with_suffix(".ledger"), "--force", "--json"])
    return file


def answers(tool, folder, seed):
    """Of one room: the summary of each world without masks and with them."""
    for number, (world, (arguments, step)) in enumerate(WORLDS.items()):
        name = "%d%s" % (seed, "_hard" if arguments else "")
        walk = simulate(tool, folder / (name + "_map"), seed, *arguments)
        query = simulate(tool, folder / (name + "_query.mcap"), seed, "--from", LAP_S, "--raw-depth", *arguments)
        map_file = build(tool, walk, step, seed, folder / ("%d_%d.sphc" % (seed, number)))
        for least in MASKS:
            yield (world, least), run([tool, "localize", "--recording", query, "--map", map_file, "--owner-note",
                                       str(map_file) + ".owner.json", "--mode", "single", "--amplitude-min", least, "--json"])


def row_of(summaries):
    def total(name):
        return sum(summary[name] for summary in summaries)

    def errors_mm(name):  # of the rooms that have poses
        return [1000 * summary["translation_error_m"][name] for summary in summaries if summary["localized"]]

    def mm(value):
        return "%.2f" % value

    return [len(summaries), total("frames"), total("localized"), total("within_5cm_5deg"), total("wrong_accepted"),
            mm(statistics.median(errors_mm("median"))), mm(max(errors_mm("median"))), mm(statistics.median(errors_mm("p90"))),
            mm(max(errors_mm("p90"))), mm(max(errors_mm("worst")))]


def measure(tool, folder, rooms):
    """Rows by world and mask, over all rooms."""
    found = {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for room in pool.map(lambda seed: list(answers(tool, folder, seed)), ROOMS[:rooms]):
            for key, summary in room:
                found.setdefault(key, []).append(summary)
    return [[*key, *row_of(summaries)] for key, summaries in found.items()]


def main():
    parser = room_options.parser_of(__doc__, RESULTS, len(ROOMS))
    arguments = parser.parse_args()
    with room_options.folder_of(arguments.keep) as folder:
        rows = measure(arguments.spherecloud, folder, arguments.rooms)
    write_csv(arguments.results, [COLUMNS, *rows])


if __name__ == "__main__":
    main()
