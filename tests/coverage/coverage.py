#!/usr/bin/env python3
"""Which lines and branches of the device's libraries and of the parsers the tests reach, by clang's own counters.

    coverage.py --build BUILD --results FILE       runs the programs below and rewrites FILE; fails below the floors
    coverage.py ... --missed                       lines that no test reaches, by file

BUILD was compiled as tests/run.sh coverage does.  A line counts once, however many instruction sets it was compiled for; of vector kernels
clang maps the lines of one instruction set, so the build has but one.
"""
import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(1, str(ROOT / "tests" / "pipeline"))
from recordings import write_csv


class Measured(typing.NamedTuple):
    """What is measured, by which programs, and the least percentages of it."""
    folders: tuple
    programs: list
    floors: dict


SETS = {
    "device": Measured(("sdk/runtime/", "sdk/signature/", "sdk/encryption/"),
                       ["unit_runtime", "unit_signature", "unit_encryption", "capi_test", "halves_test"], {"lines": 95.0, "branches": 85.0}),
    # Whatever reads files of others; mutations of seeds among the programs.
    "parsers": Measured(("sdk/host/images/", "sdk/host/recording/", "sdk/host/calibration/", "sdk/host/import/", "drivers/raw/", "drivers/pixels/"),
                        ["mutation_test", "replay_driver_test", "foreign_recordings_test", "raw_driver_test", "host_calibration_test", "unit_host", "host_images_test",
                         "pixels_test"], {"lines": 95.0}),
}
COLUMNS = ["set", "folder", "lines", "lines_reached", "lines_percent", "branches", "branches_reached", "branches_percent"]


def run_programs(build, programs):
    """Where each program is; leaves what they reached in one file."""
    raw, merged = build / "coverage", build / "coverage.profdata"
    shutil.rmtree(raw, ignore_errors=True)
    pattern = "|".join(programs)
    subprocess.run(["ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error", "-R", "^(%s)$" % pattern], check=True,
                   env={**os.environ, "LLVM_PROFILE_FILE": str(raw / "%m-%p.profraw")})
    subprocess.run(["llvm-profdata", "merge", "-sparse", *sorted(raw.glob("*.profraw")), "-o", merged], check=True)
    found = [next(path for path in build.rglob(name) if path.is_file()) for name in programs]
    return merged, [found[0], *(part for path in found[1:] for part in ("-object", path))]


def measured_files(merged, objects, folders):
    said = subprocess.run(["llvm-cov", "export", *objects, "-instr-profile", merged, "-skip-expansions"], check=True, stdout=subprocess.PIPE).stdout
    for file in json.loads(said)["data"][0]["files"]:
        path = pathlib.Path(file["filename"]).resolve()
        if path.is_relative_to(ROOT) and str(path.relative_to(ROOT)).startswith(folders):
            yield str(path.relative_to(ROOT)), file


def counts_of(file):
    lines, branches = file["summary"]["lines"], file["summary"]["branches"]
    return lines["count"], lines["covered"], branches["count"], branches["covered"]


def percent(part, whole):
    return 100.0 * part / whole if whole else 100.0


def rows_of(name, files):
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for path, file in files:
        for folder in (str(pathlib.PurePosixPath(path).parent), "all"):
            folders[folder] = [a + b for a, b in zip(folders[folder], counts_of(file))]
    for folder, (lines, lines_reached, branches, branches_reached) in sorted(folders.items(), key=lambda item: (item[0] == "all", item[0])):
        yield [name, folder, lines, lines_reached, "%.1f" % percent(lines_reached, lines), branches, branches_reached,
               "%.1f" % percent(branches_reached, branches)]


def missed_lines(file):
    """Lines that begin a region which was never entered."""
    lines = set()
    for line, _, count, has_count, is_entry, *_ in file["segments"]:
        if has_count and is_entry and count == 0:
            lines.add(line)
    return sorted(lines)


def measure(name, build, shows_missed):
    files = list(measured_files(*run_programs(build, SETS[name].programs), SETS[name].folders))
    if shows_missed:
        for path, file in files:
            for line in missed_lines(file):
                print("%s:%d" % (path, line))
    return list(rows_of(name, files))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--results", required=True, type=pathlib.Path)
    parser.add_argument("--missed", action="store_true")
    arguments = parser.parse_args()
    rows = [row for name in SETS for row in measure(name, arguments.build.resolve(), arguments.missed)]
    write_csv(arguments.results, [COLUMNS, *rows])
    totals = [dict(zip(COLUMNS, row)) for row in rows if row[1] == "all"]
    low = [(total, name, floor) for total in totals for name, floor in SETS[total["set"]].floors.items()
           if float(total[name + "_percent"]) < floor]
    for total, name, floor in low:
        print("%s: below %g %% of %s" % (total["set"], floor, name))
    print("; ".join("%(set)s: lines %(lines_percent)s %%, branches %(branches_percent)s %%" % total for total in totals))
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
