#!/usr/bin/env python3
"""Fuzzes all targets of a build with SPHC_FUZZ, one after another on one core, and writes what they did to tests/pipeline/fuzz.csv.

    fuzz.py BUILD [--seconds N] [--only TARGET]...        with --only the rows of these, and keeps the others
    fuzz.py BUILD --more ...                              adds executions, seconds and findings to what the rows say
    fuzz.py BUILD --keep [--only TARGET]...               fuzzes nothing; the smallest inputs that add coverage go to corpora/ of the tree

BUILD/corpora/TARGET keeps inputs from one run to the next, and BUILD/findings what ended a target. map and session, the doors of a
device, take a third of the time each. Exit status 1: there is a finding.
"""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import time

PIPELINE = pathlib.Path(__file__).resolve().parent.parent / "pipeline"
sys.dont_write_bytecode = True
sys.path.insert(1, str(PIPELINE))
from recordings import write_rows

RESULTS = PIPELINE / "fuzz.csv"
COLUMNS = ["sanitizers", "target", "executions", "seconds", "edges", "inputs", "findings"]
DOORS = ["map", "session"]
KEPT = pathlib.Path(__file__).resolve().parent / "corpora"
MOST_KEPT_BYTES = 16384  # of a target
LIMITS = ["-timeout=20", "-rss_limit_mb=3000", "-print_final_stats=1"]


def shares(targets, seconds):
    """Whole seconds of each target."""
    doors = [target for target in targets if target in DOORS]
    others = len(targets) - len(doors)
    of_door = seconds / 3 if others else seconds / max(len(doors), 1)
    of_other = (seconds - of_door * len(doors)) / max(others, 1)
    return {target: max(1, round(of_door if target in doors else of_other)) for target in targets}


def sanitizers_of(build):
    """As the build was configured, without what makes it a fuzzer; fewer sanitizers run many times faster."""
    value = re.search(r"^SPHC_SANITIZE:\w+=(.*)$", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE)
    return " ".join(name for name in value[1].split(",") if "fuzzer" not in name) or "none"


def last_number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def fuzz(build, target, seconds):
    """A row. A target that ends early, by a finding, begins anew until its time is over."""
    programs, corpus, findings = build / "tests" / "fuzz", build / "corpora" / target, build / "findings"
    corpus.mkdir(parents=True, exist_ok=True)
    findings.mkdir(exist_ok=True)
    row = dict.fromkeys(COLUMNS, 0) | {"sanitizers": sanitizers_of(build), "target": target}
    begin = time.monotonic()
    while (left := seconds - int(time.monotonic() - begin)) > 0:
        done = subprocess.run(
            [programs / f"fuzz_{target}", *LIMITS, f"-max_total_time={left}", f"-artifact_prefix={findings}/{target}-", corpus,
             programs / "seeds" / target], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", check=False)
        executions = last_number(r"stat::number_of_executed_units: (\d+)", done.stderr)
        row["executions"] += executions
        row["edges"] = max(row["edges"], last_number(r"cov: (\d+)", done.stderr))
        if done.returncode:
            row["findings"] += 1
            (findings / f"{target}.log").write_text(done.stderr[-20000:], encoding="utf-8")
        if not executions:
            break  # a seed ends it at once
    row["seconds"] = round(time.monotonic() - begin)
    row["inputs"] = len(list(corpus.iterdir()))
    return row


def added(before, row):
    """The row of both campaigns; edges and inputs are of the later one."""
    return row | {name: int(before[name]) + row[name] for name in ("executions", "seconds", "findings")}


def keep(build, target):
    """One file of the tree: the smallest inputs of those that together reach all that the corpus reaches, each behind its length."""
    with tempfile.TemporaryDirectory() as merged:
        corpora = [path for path in (build / "corpora" / target, build / "tests" / "fuzz" / "seeds" / target) if path.is_dir()]
        subprocess.run([build / "tests" / "fuzz" / f"fuzz_{target}", *LIMITS, "-merge=1", merged, *corpora], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=True)
        inputs = sorted((path.read_bytes() for path in pathlib.Path(merged).iterdir()), key=lambda input: (len(input), input))
    written, total = [], 0
    for each in inputs:
        if written and total + 4 + len(each) > MOST_KEPT_BYTES:
            break
        written.append(len(each).to_bytes(4, "little") + each)
        total += 4 + len(each)
    (KEPT / f"{target}.inputs").write_bytes(b"".join(written))
    print(f"{target}: {len(written)} of {len(inputs)} inputs, {total} bytes", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="folder of the build")
    parser.add_argument("--seconds", type=int, default=3600, help="of all targets together")
    parser.add_argument("--only", action="append", metavar="TARGET")
    parser.add_argument("--more", action="store_true", help="add to the rows that are there")
    parser.add_argument("--keep", action="store_true", help="write corpora/ of the tree instead")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    targets = arguments.only or sorted(path.name for path in (build / "tests" / "fuzz" / "seeds").iterdir())
    if arguments.keep:
        for target in targets:
            keep(build, target)
        return 0
    rows = {}
    if RESULTS.exists():
        with RESULTS.open(encoding="utf-8", newline="") as file:
            rows = {(row["sanitizers"], row["target"]): row for row in csv.DictReader(file)}
    measured = []
    for target, seconds in shares(targets, arguments.seconds).items():
        measured.append(fuzz(build, target, seconds))
        key = (measured[-1]["sanitizers"], target)
        rows[key] = added(rows[key], measured[-1]) if arguments.more and key in rows else measured[-1]
        print(" ".join(f"{name} {measured[-1][name]}" for name in COLUMNS), flush=True)
        write_rows(RESULTS, COLUMNS, (rows[key] for key in sorted(rows)))
    return 1 if any(row["findings"] for row in measured) else 0


if __name__ == "__main__":
    sys.exit(main())
