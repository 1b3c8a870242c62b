#!/usr/bin/env python3
"""Which lines and branches of the device's libraries the tests reach, by clang's own counters.

    coverage.py --build BUILD --results FILE       runs the programs below and rewrites FILE; fails below the floors
    coverage.py ... --missed                       lines that no test reaches, by file

BUILD was compiled as tests/run.sh coverage does.  A line counts once, however many instruction sets it was compiled for; of vector kernels
clang maps the lines of one instruction set, so the build has but one.
"""
import argparse
import collections
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ["unit_runtime", "unit_signature", "unit_encryption", "capi_test", "halves_test"]
MEASURED = ("sdk/runtime/", "sdk/signature/", "sdk/encryption/")
FLOORS = {"lines": 95.0, "branches": 85.0}
COLUMNS = ["folder", "lines", "lines_reached", "lines_percent", "branches", "branches_reached", "branches_percent"]


def run_programs(build):
    """Where each program is; leaves what they reached in one file."""
    raw, merged = build / "coverage", build / "coverage.profdata"
    shutil.rmtree(raw, ignore_errors=True)
    pattern = "|".join(PROGRAMS)
    subprocess.run(["ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error", "-R", "^(%s)$" % pattern], check=True,
                   env={**os.environ, "LLVM_PROFILE_FILE": str(raw / "%m-%p.profraw")})
    subprocess.run(["llvm-profdata", "merge", "-sparse", *sorted(raw.glob("*.profraw")), "-o", merged], check=True)
    found = [next(path for path in build.rglob(name) if path.is_file()) for name in PROGRAMS]
    return merged, [found[0], *(part for path in found[1:] for part in ("-object", path))]


def measured_files(merged, objects):
    said = subprocess.run(["llvm-cov", "export", *objects, "-instr-profile", merged, "-skip-expansions"], check=True, stdout=subprocess.PIPE).stdout
    for file in json.loads(said)["data"][0]["files"]:
        path = pathlib.Path(file["filename"]).resolve()
        if path.is_relative_to(ROOT) and str(path.relative_to(ROOT)).startswith(MEASURED):
            yield str(path.relative_to(ROOT)), file


def counts_of(file):
    lines, branches = file["summary"]["lines"], file["summary"]["branches"]
    return lines["count"], lines["covered"], branches["count"], branches["covered"]


def percent(part, whole):
    return 100.0 * part / whole if whole else 100.0


def rows_of(files):
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for path, file in files:
        for folder in (str(pathlib.PurePosixPath(path).parent), "all"):
            folders[folder] = [a + b for a, b in zip(folders[folder], counts_of(file))]
    for folder, (lines, lines_reached, branches, branches_reached) in sorted(folders.items(), key=lambda item: (item[0] == "all", item[0])):
        yield [folder, lines, lines_reached, "%.1f" % percent(lines_reached, lines), branches, branches_reached,
               "%.1f" % percent(branches_reached, branches)]


def missed_lines(file):
    """Lines that begin a region which was never entered."""
    lines = set()
    for line, _, count, has_count, is_entry, *_ in file["segments"]:
        if has_count and is_entry and count == 0:
            lines.add(line)
    return sorted(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--results", required=True, type=pathlib.Path)
    parser.add_argument("--missed", action="store_true")
    arguments = parser.parse_args()
    files = list(measured_files(*run_programs(arguments.build.resolve())))
    if arguments.missed:
        for path, file in files:
            for line in missed_lines(file):
                print("%s:%d" % (path, line))
    rows = list(rows_of(files))
    with arguments.results.open("w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([COLUMNS, *rows])
    total = dict(zip(COLUMNS, rows[-1]))
    print("lines %s %%, branches %s %%" % (total["lines_percent"], total["branches_percent"]))
    low = [name for name, floor in FLOORS.items() if float(total[name + "_percent"]) < floor]
    for name in low:
        print("below %g %%: %s" % (FLOORS[name], name))
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
