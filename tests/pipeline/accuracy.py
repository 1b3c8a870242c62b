#!/usr/bin/env python3
"""Accuracy of the whole pipeline on recordings, through the command line alone.

    accuracy.py --spherecloud BIN --update       measures every row and rewrites accuracy.csv; review the diff
    accuracy.py --spherecloud BIN --check NAME   measures the eta 33 % row of NAME and holds it against its floor

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

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LEDGER = HERE / "accuracy.csv"
ETAS = (1.0, 0.5, 0.33, 0.25)
SKIPPED = 77

# Frames as (first, last, step); floors hold at eta 33 %: (share within 5 cm and 5 deg, median cm, median deg).
RECORDINGS = {
    "simulated": dict(map=(0, 99, 1), query=(100, 199, 1), floor=(99.0, 1.0, 0.3)),
    "redkitchen": dict(folder="redkitchen/seq-01", map=(0, 597, 3), query=(620, 799, 5), floor=(60.0, 4.0, None)),
    "hololens": dict(folder="hololens", map=(0, 198, 2), query=(1, 199, 2), floor=(85.0, None, None)),
}
# No accepted pose may be further from the truth than this.
WORST_CM, WORST_DEG = 25.0, 10.0
COLUMNS = ["recording", "eta", "map_points", "frames", "localized_percent", "within_5cm_5deg_percent",
           "median_cm", "p90_cm", "worst_cm", "median_deg", "p90_deg", "worst_deg", "matches", "inliers"]


def run(command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode not in (0, 3):  # 3: ran, but nothing was localized
        sys.exit("failed: %s\n%s%s" % (" ".join(map(str, command)), result.stdout, result.stderr))
    return json.loads(result.stdout)


def frames(selection):
    first, last, step = selection
    return ["--first", first, "--last", last, "--step", step]


class Recording:
    """Where a recording is, and how the command line is told of it."""

    def __init__(self, name, tool, workdir):
        self.name, self.tool, self.spec = name, tool, RECORDINGS[name]
        if "folder" in self.spec:
            data = pathlib.Path(os.environ.get("SPHC_DATA", ROOT.parent / "shared" / "data"))
            self.folder = data / self.spec["folder"]
            self.source = ["--recording", self.folder, "--calibration", HERE / "calibration" / (name + ".json")]
        else:
            self.folder = workdir / name
            self.source = ["--recording", self.folder]

    def prepare(self):
        """False where the recording is absent."""
        if "folder" in self.spec:
            return self.folder.is_dir()
        if not self.folder.is_dir():
            run([self.tool, "simulate", "--out", self.folder, "--frames", 200, "--rate", 6.25, "--json"])
        return True

    def measure(self, eta, workdir):
        map_file = workdir / ("%s_%d.sphc" % (self.name, round(100 * eta)))
        built = run([self.tool, "build", *self.source, *frames(self.spec["map"]), "--map", map_file, "--eta", eta,
                     "--key", HERE / "test_key.txt", "--json"])
        found = run([self.tool, "localize", *self.source, *frames(self.spec["query"]), "--map", map_file,
                     "--owner-note", str(map_file) + ".owner.json", "--json"])
        translation, rotation = found["translation_error_m"], found["rotation_error_deg"]
        value = lambda x, scale: "" if x is None else "%.3f" % (x * scale)
        return {
            "recording": self.name, "eta": "%.2f" % eta, "map_points": built["points"], "frames": found["frames"],
            "localized_percent": "%.1f" % found["localized_percent"],
            "within_5cm_5deg_percent": "%.1f" % found["within_5cm_5deg_percent"],
            "median_cm": value(translation["median"], 100), "p90_cm": value(translation["p90"], 100),
            "worst_cm": value(translation["worst"], 100), "median_deg": value(rotation["median"], 1),
            "p90_deg": value(rotation["p90"], 1), "worst_deg": value(rotation["worst"], 1),
            "matches": "%d" % found["median"]["matches"], "inliers": "%d" % found["median"]["inliers"],
        }


def update(tool):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in RECORDINGS:
            recording = Recording(name, tool, pathlib.Path(folder))
            if not recording.prepare():
                sys.exit("%s is not there; all recordings are needed to rewrite the ledger" % recording.folder)
            for eta in ETAS:
                rows.append(recording.measure(eta, pathlib.Path(folder)))
                print(*rows[-1].values(), flush=True)
    with LEDGER.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def check(tool, name):
    with tempfile.TemporaryDirectory() as folder:
        recording = Recording(name, tool, pathlib.Path(folder))
        if not recording.prepare():
            print("skipped: no recording at %s; set SPHC_DATA" % recording.folder)
            sys.exit(SKIPPED)
        row = recording.measure(0.33, pathlib.Path(folder))
    print(row)
    share, centimetres, degrees = recording.spec["floor"]
    faults = []
    if float(row["within_5cm_5deg_percent"]) < share:
        faults.append("within 5 cm and 5 deg: %s %%, floor %s %%" % (row["within_5cm_5deg_percent"], share))
    for column, ceiling in (("median_cm", centimetres), ("median_deg", degrees), ("worst_cm", WORST_CM),
                            ("worst_deg", WORST_DEG)):
        if ceiling is not None and not (row[column] and float(row[column]) <= ceiling):
            faults.append("%s: %s, ceiling %s" % (column, row[column], ceiling))
    sys.exit("\n".join(faults) if faults else 0)


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
