#!/usr/bin/env python3
"""Accuracy of the whole pipeline on recordings, through the command line alone.

    accuracy.py --spherecloud BIN --update       measures every row and rewrites accuracy.csv; review the diff
    accuracy.py --spherecloud BIN --check NAME   measures the rows of NAME that have floors and holds them

Real recordings are looked for in $SPHC_DATA, else in ../shared/data beside the repository; --check exits with 77
(skipped) and says so where they are absent.  The key is fixed so that rows can be compared; it protects nothing.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from private_key import private_key

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LEDGER = HERE / "accuracy.csv"
ETAS = (1.0, 0.5, 0.33, 0.25)
SKIPPED = 77

# Frames as (first, last, step).  "block": frames in turn go to the map and to the query, so many at a time.
RECORDINGS = {
    "simulated": dict(map=(0, 99, 1), query=(100, 199, 1)),
    "redkitchen": dict(folder="redkitchen/seq-01", map=(0, 597, 3), query=(620, 799, 1)),
    "hololens": dict(folder="hololens", map=(0, 198, 2), query=(1, 199, 2)),
    "hololens_blocks": dict(folder="hololens", block=20),
}
MODES = {
    "single": ["--mode", "single"],
    "tracking": ["--mode", "tracking"],
    "odometry": ["--odometry"],
}
# What is measured, and floors at eta 33 %: (share within 5 cm and 5 deg, median cm, median deg).  Those of the paper's
# fakes first; patchwork, the default, shows fewer places, and loses some poses where views hardly overlap.
FLOORS = {
    "gaussian": {
        ("simulated", "single"): (99.0, 1.0, 0.3),
        ("redkitchen", "single"): (85.0, 1.8, None),
        ("redkitchen", "tracking"): (97.0, 1.5, None),
        ("hololens", "single"): (96.0, 1.2, None),
        ("hololens_blocks", "single"): (41.0, None, None),
        ("hololens_blocks", "tracking"): (41.0, None, None),
        ("hololens_blocks", "odometry"): (41.0, None, None),
    },
    "patchwork": {
        ("simulated", "single"): (99.0, 1.0, 0.3),
        ("redkitchen", "single"): (85.0, 1.8, None),
        ("redkitchen", "tracking"): (97.0, 1.5, None),
        ("hololens", "single"): (94.0, 1.2, None),
        ("hololens_blocks", "single"): (37.0, None, None),
    },
}
FLOOR_ETAS = {0.33: 0.0, 0.25: 4.0}  # how far below its floor the share may lie
# No accepted pose may be further from the truth than this.
WORST_CM, WORST_DEG = 25.0, 10.0
COLUMNS = ["recording", "fakes", "mode", "eta", "map_points", "frames", "localized_percent", "within_5cm_5deg_percent",
           "median_cm", "p90_cm", "worst_cm", "median_deg", "p90_deg", "worst_deg", "matches", "inliers"]


def run(command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode not in (0, 3):  # 3: ran, but nothing was localized
        sys.exit("failed: %s\n%s%s" % (" ".join(map(str, command)), result.stdout, result.stderr))
    return json.loads(result.stdout)


def frames(selection):
    first, last, step = selection
    return ["--first", first, "--last", last, "--step", step]


def every_other_block(source, folder, block, remainder):
    """A TUM recording of every other `block` frames of another."""
    folder.mkdir()
    for name in ("rgb", "depth", "groundtruth.txt"):
        (folder / name).symlink_to(source.resolve() / name)
    for name in ("rgb.txt", "depth.txt"):
        lines = [line for line in (source / name).read_text().splitlines() if not line.startswith("#")]
        kept = [line for i, line in enumerate(lines) if i // block % 2 == remainder]
        (folder / name).write_text("\n".join(kept) + "\n")


class Recording:
    """Where a recording is, and how the command line is told of its frames."""

    def __init__(self, name, tool, workdir):
        self.name, self.tool, self.workdir = name, tool, workdir
        spec = RECORDINGS[name]
        data = pathlib.Path(os.environ.get("SPHC_DATA", ROOT.parent / "shared" / "data"))
        self.folder = data / spec["folder"] if "folder" in spec else workdir / name
        self.spec = spec
        self.maps = {}

    def prepare(self):
        """False where the recording is absent."""
        if "folder" in self.spec and not self.folder.is_dir():
            return False
        if "folder" not in self.spec:
            run([self.tool, "simulate", "--out", self.folder, "--frames", 200, "--rate", 6.25, "--json"])
        if "block" in self.spec:
            for part, remainder in (("map", 0), ("query", 1)):
                every_other_block(self.folder, self.workdir / (self.name + part), self.spec["block"], remainder)
        return True

    def place(self, part):
        """part: "map" or "query"."""
        folder = self.workdir / (self.name + part) if "block" in self.spec else self.folder
        calibration = HERE / "calibration" / (self.spec.get("folder", "").split("/")[0] + ".json")
        return ["--recording", folder] + (["--calibration", calibration] if "folder" in self.spec else [])

    def source(self, part):
        return self.place(part) + (frames(self.spec[part]) if part in self.spec else [])

    def map(self, fakes, eta):
        """The map file and what its builder says, made once."""
        if (fakes, eta) not in self.maps:
            file = self.workdir / ("%s_%s_%d.sphc" % (self.name, fakes, round(100 * eta)))
            built = run([self.tool, "build", *self.source("map"), "--map", file, "--eta", eta,
                         "--fakes", fakes, "--key", private_key(self.workdir), "--ledger", str(file) + ".ledger", "--json"])
            self.maps[fakes, eta] = (file, built)
        return self.maps[fakes, eta]

    def measure(self, fakes, mode, eta):
        file, built = self.map(fakes, eta)
        found = run([self.tool, "localize", *self.source("query"), "--map", file, *MODES[mode],
                     "--owner-note", str(file) + ".owner.json", "--json"])
        translation, rotation = found["translation_error_m"], found["rotation_error_deg"]
        value = lambda x, scale: "" if x is None else "%.3f" % (x * scale)
        return {
            "recording": self.name, "fakes": fakes, "mode": mode, "eta": "%.2f" % eta, "map_points": built["points"],
            "frames": found["frames"], "localized_percent": "%.1f" % found["localized_percent"],
            "within_5cm_5deg_percent": "%.1f" % found["within_5cm_5deg_percent"],
            "median_cm": value(translation["median"], 100), "p90_cm": value(translation["p90"], 100),
            "worst_cm": value(translation["worst"], 100), "median_deg": value(rotation["median"], 1),
            "p90_deg": value(rotation["p90"], 1), "worst_deg": value(rotation["worst"], 1),
            "matches": "%d" % found["median"]["matches"], "inliers": "%d" % found["median"]["inliers"],
        }


def measured(name):
    return [(fakes, mode) for fakes, floors in FLOORS.items() for recording, mode in floors if recording == name]


def update(tool):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in RECORDINGS:
            recording = Recording(name, tool, pathlib.Path(folder))
            if not recording.prepare():
                sys.exit("%s is not there; all recordings are needed to rewrite the ledger" % recording.folder)
            for fakes, mode in measured(name):
                for eta in ETAS:
                    rows.append(recording.measure(fakes, mode, eta))
                    print(*rows[-1].values(), flush=True)
    with LEDGER.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def faults(row, floor, allowance):
    share, centimetres, degrees = floor
    if float(row["within_5cm_5deg_percent"]) < share - allowance:
        yield "within 5 cm and 5 deg: %s %%, floor %s %%" % (row["within_5cm_5deg_percent"], share - allowance)
    for column, ceiling in (("median_cm", centimetres), ("median_deg", degrees), ("worst_cm", WORST_CM),
                            ("worst_deg", WORST_DEG)):
        if ceiling is not None and not (row[column] and float(row[column]) <= ceiling):
            yield "%s: %s, ceiling %s" % (column, row[column], ceiling)


def check(tool, name):
    found = []
    with tempfile.TemporaryDirectory() as folder:
        recording = Recording(name, tool, pathlib.Path(folder))
        if not recording.prepare():
            print("skipped: no recording at %s; set SPHC_DATA" % recording.folder)
            sys.exit(SKIPPED)
        for fakes, mode in measured(name):
            for eta, allowance in FLOOR_ETAS.items():
                row = recording.measure(fakes, mode, eta)
                print(row, flush=True)
                found += ["%s, %s, eta %s: %s" % (fakes, mode, eta, fault) for fault in
                          faults(row, FLOORS[fakes][name, mode], allowance)]
    sys.exit("\n".join(found) if found else 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--update", action="store_true")
    group.add_argument("--check", choices=sorted(RECORDINGS))
    arguments = parser.parse_args()
    if arguments.update:
        update(arguments.spherecloud)
    else:
        check(arguments.spherecloud, arguments.check)


if __name__ == "__main__":
    main()
