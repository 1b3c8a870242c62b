"""The recordings that scripts measure on, as the command line is told of them, and the ledgers that they write.

Real ones are looked for in $SPHC_DATA, else in ../shared/data beside the repository.  Where they are absent a test is
skipped, unless $SPHC_REQUIRE_DATA says that they must be there.
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SKIPPED = 77

# Frames as (first, last, step).  "block": frames in turn go to the map and to the query, so many at a time.
RECORDINGS = {
    "simulated": dict(simulated=["--frames", 200, "--rate", 6.25], map=(0, 99, 1), query=(100, 199, 1)),
    "redkitchen": dict(folder="redkitchen/seq-01", map=(0, 597, 3), query=(620, 799, 1)),
    "hololens": dict(folder="hololens", map=(0, 198, 2), query=(1, 199, 2)),
    "hololens_blocks": dict(folder="hololens", block=20),
    # Hard ones: a thin map, one that shows the place from elsewhere, and one of views that hardly overlap.
    "redkitchen_thin": dict(folder="redkitchen/seq-01", map=(0, 597, 20), query=(620, 799, 1)),
    "redkitchen_reversed": dict(folder="redkitchen/seq-01", map=(620, 799, 6), query=(0, 597, 3)),
    "hololens2_blocks": dict(folder="hololens2", calibration="hololens", block=20),
    # Queries alone.
    "hololens2": dict(folder="hololens2", calibration="hololens"),
    "other_room": dict(simulated=["--frames", 40, "--rate", 6.25, "--seed", 902, "--walk-seed", 902]),
}


def ran(command, accepted=(0,), **more):
    """What became of a command.  Ends the script where its exit status is none of those."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, **more)
    if result.returncode not in accepted:
        sys.exit("ended with %d: %s\n%s%s" % (result.returncode, " ".join(map(str, command)), result.stdout, result.stderr))
    return result


def run(command):
    """What a command says in JSON."""
    return json.loads(ran(command, accepted=(0, 3, 6)).stdout)  # 3: ran, but nothing was localized; 6: mapped, but parts never met


def frames(selection):
    first, last, step = selection
    return ["--first", first, "--last", last, "--step", step]


def absent(folder):
    """Ends a test or a script whose recording is not there."""
    if os.environ.get("SPHC_REQUIRE_DATA", "0") not in ("", "0"):
        sys.exit("no recording at %s, and SPHC_REQUIRE_DATA says that it must be there" % folder)
    print("skipped: no recording at %s; set SPHC_DATA" % folder)
    sys.exit(SKIPPED)


def require(names):
    """Ends a script that measures, before it writes a ledger without their rows, when one of these recordings is absent."""
    for name in names:
        recording = Recording(name, None, pathlib.Path())
        if not recording.is_there():
            absent(recording.folder)


def every_other_block(source, folder, block, remainder):
    """A TUM recording of every other `block` frames of another."""
    for name in ("rgb", "depth"):
        lines = [line for line in (source / (name + ".txt")).read_text().splitlines() if not line.startswith("#")]
        kept = [line for i, line in enumerate(lines) if i // block % 2 == remainder]
        (folder / name).mkdir(parents=True)
        (folder / (name + ".txt")).write_text("\n".join(kept) + "\n")
        for line in kept:
            shutil.copyfile(source / line.split()[1], folder / line.split()[1])
    shutil.copyfile(source / "groundtruth.txt", folder / "groundtruth.txt")


def read_rows(path):
    """Of a file with a head of names, a dict each."""
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, rows):
    """Whole, or not at all."""
    part = path.with_suffix(".part")
    with part.open("w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(rows)
    part.replace(path)


def write_rows(path, columns, rows):
    """Of each row, a dict, the values that are columns."""
    write_csv(path, [columns, *([row[column] for column in columns] for row in rows)])


class Ledger:
    """A CSV file of figures of which a part is measured anew: other rows stay.  The first `named` columns say what a row is of; rows
    are in the order of `order`, a function of a row, else as they come."""

    def __init__(self, path, columns, named, order=None):
        self.path, self.columns, self.named, self.order = path, columns, named, order
        self.groups = {}
        if not path.exists():
            return
        with path.open(newline="") as file:
            head, *rows = csv.reader(file)
        if head != columns:
            sys.exit("%s has other columns than this script writes; remove it and measure all of it" % path)
        self.groups = self.grouped(rows)

    def grouped(self, rows):
        groups = {}
        for row in rows:
            groups.setdefault(tuple(row[:self.named]), []).append(row)
        return groups

    def put(self, rows):
        """Writes them in the place of those that are of the same."""
        self.groups |= self.grouped(rows)
        every = [row for group in self.groups.values() for row in group]
        write_csv(self.path, [self.columns, *(sorted(every, key=self.order) if self.order else every)])


class Recording:
    """Where a recording is, and how the command line is told of its frames."""

    def __init__(self, name, tool, workdir):
        self.name, self.tool, self.workdir, self.spec = name, tool, workdir, RECORDINGS[name]
        data = pathlib.Path(os.environ.get("SPHC_DATA", ROOT.parent / "shared" / "data"))
        self.folder = data / self.spec["folder"] if "folder" in self.spec else workdir / name

    def is_there(self):
        return "simulated" in self.spec or self.folder.is_dir()

    def prepare(self):
        """Simulates it, or sorts its frames into blocks, where that is how it is made."""
        if "simulated" in self.spec:
            run([self.tool, "simulate", "--out", self.folder, *self.spec["simulated"], "--json"])
        if "block" in self.spec:
            for part, remainder in (("map", 0), ("query", 1)):
                every_other_block(self.folder, self.workdir / (self.name + part), self.spec["block"], remainder)

    def place(self, part):
        """part: "map" or "query"."""
        folder = self.workdir / (self.name + part) if "block" in self.spec else self.folder
        if "simulated" in self.spec:
            return ["--recording", folder]
        calibration = self.spec.get("calibration", self.spec["folder"].split("/")[0])
        return ["--recording", folder, "--calibration", HERE / "calibration" / (calibration + ".json")]

    def source(self, part):
        return self.place(part) + (frames(self.spec[part]) if part in self.spec else [])
