#!/usr/bin/env python3
"""Audits maps of recordings and of simulated rooms, and writes the figures into privacy.csv.

    privacy.py --spherecloud BIN [--rooms FOLDER] [--strategies NAME...] [--places NAME...] [--only ATTACK...]

Real recordings are looked for in $SPHC_DATA, else in ../shared/data beside the repository.  Simulated rooms 901 to 906,
which no attacker has trained on, are made in FOLDER unless they are there.  Every place is published under two keys;
figures are means of both.  Rows are replaced one by one: what is not measured stays.  The rows of map "all" put the views of
all places together, and are made anew of the table for every strategy whose pictures all places have.
"""
import argparse
import collections
import os
import pathlib
import sys
import tempfile
from statistics import mean

from private_key import private_key
from recordings import HERE, ran, read_rows, write_rows

DATA = pathlib.Path(os.environ.get("SPHC_DATA", HERE.parent.parent.parent / "shared" / "data"))
RESULTS = HERE / "privacy.csv"
ROOMS = range(901, 907)
STRATEGIES = ("gaussian", "patchwork", "warped")
KEYS = 2


def room(tool, path, seed, walk_seed, *options):
    if not path.exists():
        ran([tool, "simulate", "--out", path, "--seed", seed, "--walk-seed", walk_seed, *options, "--json"])
    return path


def places(tool, rooms, wanted):
    """(name, what it is mapped from, photos that it is not mapped from)"""
    calibration = HERE / "calibration"
    real = {"redkitchen": ([DATA / "redkitchen/seq-01", "--calibration", calibration / "redkitchen.json", "--last", 597,
                            "--step", 3], ["--photos-first", 620, "--photos-last", 799]),
            "hololens": ([DATA / "hololens", "--calibration", calibration / "hololens.json"], [])}
    for name, (recording, photos) in real.items():
        if name in wanted:
            yield name, ["--recording", *recording], photos
    for seed in ROOMS:
        if "room %d" % seed in wanted:
            photos = room(tool, rooms / ("%d.photos" % seed), seed, seed + 1000, "--frames", 30, "--rate", 2)
            yield "room %d" % seed, ["--recording", room(tool, rooms / str(seed), seed, seed)], ["--photos", photos]


ALL_PLACES = ["redkitchen", "hololens", *("room %d" % seed for seed in ROOMS)]


def without_map(folder):
    for stale in folder.glob("map.*"):
        stale.unlink()


def audited(options, folder, name, recording, strategy):
    """Rows of the figures, of each key."""
    tool, model = options.spherecloud, folder / "points.model"
    for key in range(1, KEYS + 1):
        without_map(folder)
        digits = folder / "key"
        digits.write_text("%064x\n" % key)
        digits.chmod(0o600)
        ledger, figures = folder / "map.ledger", folder / "map.csv"
        ran([tool, "build", "--model", model, "--map", folder / "map.sphc", "--ledger", ledger, "--key", digits,
             "--fakes", strategy, "--json"])
        ran([tool, "audit", folder / "map.sphc", "--truth", ledger, *recording, "--figures", figures, "--name",
                     name, "--json", *(word for attack in options.only for word in ("--only", attack))],
            accepted=(0, 4, 5))
        yield read_rows(figures)


def name_of(row):
    """What a row is of.  The remark of a figure of the audit counts something, and is none of it."""
    variant = "" if row["attack"] == "audit" and "." in row["metric"] else row["variant"]
    return row["attack"], row["map"], row["strategy"], variant, row["metric"]


def means(of_keys):
    """Of each figure, which every key must give."""
    of_keys = list(of_keys)
    values, first = collections.defaultdict(list), {}
    for row in (row for rows in of_keys for row in rows):
        values[name_of(row)].append(float(row["value"]))
        first.setdefault(name_of(row), row)
    for name, found in values.items():
        if len(found) != len(of_keys):
            sys.exit("%s is there %d times under %d keys, so it has no mean of all" % (" ".join(filter(None, name)), len(found), len(of_keys)))
    return {name: {**row, "value": "%.4g" % mean(values[name])} for name, row in first.items()}


def write_results(rows):
    write_rows(RESULTS, list(rows[0]), rows)


def replace(fresh):
    """In the table: rows of the same name in their place, others after the last of their group."""
    fresh = dict(fresh)
    rows = [fresh.pop(name_of(row), row) for row in read_rows(RESULTS)]
    for row in fresh.values():
        group = [i for i, other in enumerate(rows)
                 if all(other[column] == row[column] for column in ("attack", "map", "strategy"))]
        rows.insert(group[-1] + 1 if group else len(rows), row)
    write_results(rows)


def put_together(rows):
    """Rows of map "all": what share of the views of all places is told."""
    told = collections.defaultdict(dict)  # strategy, points, metric: place: value
    for row in rows:
        if row["attack"] == "audit" and row["map"] != "all" and row["metric"] in ("retrieval_coarse", "retrieval_fine", "views"):
            told[row["strategy"], row["variant"], row["metric"]][row["map"]] = float(row["value"])
    for (strategy, points, metric), of_places in told.items():
        views = told[strategy, points, "views"]
        if metric == "views" or set(of_places) != set(ALL_PLACES):
            continue
        total = sum(views.values())
        share = sum(of_places[place] * views[place] for place in views) / total
        error = (share * (1 - share) / total) ** 0.5  # both keys show the same views
        for suffix, value in (("", "%.4g" % share), ("_standard_error", "%.2g" % error)):
            yield {"attack": "audit", "map": "all", "strategy": strategy, "eta": "0.33", "variant": points,
                   "metric": metric + suffix, "value": value}


def replace_all():
    rows = read_rows(RESULTS)
    fresh = list(put_together(rows))
    strategies = {row["strategy"] for row in fresh}
    write_results([row for row in rows if (row["attack"], row["map"]) != ("audit", "all") or row["strategy"] not in strategies]
                  + fresh)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--rooms", type=pathlib.Path)
    parser.add_argument("--strategies", nargs="+", default=STRATEGIES, choices=STRATEGIES)
    parser.add_argument("--places", nargs="+", default=ALL_PLACES, choices=ALL_PLACES)
    parser.add_argument("--only", nargs="+", default=[], metavar="ATTACK")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, recording, photos in places(options.spherecloud, options.rooms or folder, options.places):
            without_map(folder)
            ran([options.spherecloud, "build", *recording, "--save-model", folder / "points.model", "--map",
                 folder / "map.sphc", "--ledger", folder / "map.ledger", "--key", private_key(folder), "--force", "--json"])
            for strategy in options.strategies:
                fresh = means(audited(options, folder, name, [*recording, *photos], strategy))
                replace(fresh)
                print(name, strategy, {row["metric"]: row["value"] for row in fresh.values() if "." in row["metric"]},
                      flush=True)
    replace_all()


if __name__ == "__main__":
    main()
