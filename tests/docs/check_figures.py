#!/usr/bin/env python3
"""Tables that pages quote from ledgers say what the ledgers say.

    check_figures.py ROOT

Each function below makes rows of a page's tables of a ledger in tests/pipeline, rounded as the page rounds.  Each row must stand
in the page; a cell that is None may say anything, and so may cells behind the last one.
"""
import csv
import sys
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path

from markdown import report


def rounded(number, digits):
    return str(Decimal(str(number)).quantize(Decimal(1).scaleb(-digits), ROUND_HALF_UP))


def cm(metres, digits=2):
    return f"{rounded(100 * Decimal(metres), digits)} cm"


def total(rows, column):
    return sum(int(row[column]) for row in rows)


def median(values):
    values = sorted(map(Decimal, values))
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2


def of(rows, **wanted):
    """The rows that have these values."""
    return [row for row in rows if all(row[column] == value for column, value in wanted.items())]


def late_depth(rows):
    ways = {"single": "none (single)", "tracking, odometry": "given"}
    for row in of(rows, map="a lap"):
        older, way = row["depth_is_older_by"], row["way"]
        if older != "0 ms" and way in ways and (older, way) != ("67 ms", "tracking, odometry"):
            yield [older, ways[way], row["with_pose"], row["sure"],
                   f"{rounded(row['median_cm'], 1)} cm", f"{rounded(row['worst_median_cm'], 1)} cm"]
    for made, older, told in (("2 s", "- 4 ms, as the headset takes it", "told"), ("2 s, depth older by 17 ms", "13 ms", "told"),
                              ("2 s, depth older by 17 ms, not told", "13 ms", "told as - 4 ms")):
        single, odometry = (of(rows, map=made, way=way)[0] for way in ways)
        yield [older, told, *(f"{rounded(row['median_cm'], 1)} cm" for row in (single, odometry)),
               str(total([single, odometry], "sure_beyond_5cm"))]


def hints(rows):
    names = {"lamps off, dusk": "lamps off at dusk (`simulate --with dark`)", "another room": "another room, another place",
             "another place": "another room, another place", "hall, a map of 3 frames": "equal furniture (`hall`), a map of 3 frames"}
    of_words = {"light": "too dark", "dusk": "too dark", "blurred": "too fast", "contrast": "too plain", "depth": "no depth in range",
                "another": "not in the map", "healthy": "nothing", "hall": "ambiguous"}
    for name in dict.fromkeys(names.get(row["condition"], row["condition"]) for row in rows):
        members = [row for row in rows if names.get(row["condition"], row["condition"]) == name]
        told = next(hint for word, hint in of_words.items() if word in name)
        yield [name, str(total(members, "frames")), str(total(members, "without_pose")), f"{total(members, 'told')} {told}"]


def negative(rows):
    for fault in dict.fromkeys(row["fault"] for row in rows):
        single, tracking = (of(rows, fault=fault, mode=mode) for mode in ("single", "tracking"))
        wrong = [f"{total(members, 'wrong_sure')} of {total(members, 'tried')}" for members in (single, tracking)]
        yield [fault, None, wrong[0], None, wrong[1],
               f"{total(tracking, 'named')} ({total(tracking, 'sequences_named')} of {total(tracking, 'sequences')})"]


def rolling(rows):
    for name, made, query, mode in (
            ("all rows at once, tracking", "at once", "at once", "tracking"),
            ("rolling, not told, tracking", "rolling", "rolling", "tracking"),
            ("told of queries alone, tracking", "rolling", "straightened", "tracking"),
            ("told of both, tracking", "straightened", "straightened", "tracking"),
            ("told of both, odometry", "straightened", "straightened", "odometry"), ("not told, single", "rolling", "rolling", "single"),
            ("told of both, single", "straightened", "straightened", "single")):
        cells = [name]
        for device in ("headset", "phone"):
            row = of(rows, device=device, map_shutter=made, query_shutter=query, mode=mode)[0]
            cells += [row["within_5cm_5deg_percent_mean"] + " %", f"{rounded(row['median_cm'], 1)} cm, {row['median_deg']}°",
                      rounded(row["translation_over_sigma_median"], 1)]
        yield cells


def mapping(rows):
    def errors(recording, column="ate_rigid_m"):
        return [cm(of(rows, recording=recording, poses=poses)[0][column]) for poses in ("none", "odometry", "approximate")]

    def of_rooms(column, poses, value):
        return cm(value(list(map(Decimal, (row[column] for row in of(rows, world="simulated", poses=poses))))))

    for recording in ("redkitchen", "hololens", "hololens2"):
        yield [recording, *errors(recording), cm(of(rows, recording=recording, poses="approximate")[0]["ate_unaligned_m"])]
    for name, value in (("twelve simulated rooms, median", median), ("the same, worst", max)):
        yield [name, *(of_rooms("ate_rigid_m", poses, value) for poses in ("none", "odometry", "approximate")),
               of_rooms("ate_unaligned_m", "approximate", value)]
    for recording, name in (("redkitchen", "redkitchen, every 3rd of 600"), ("hololens", "hololens"), ("hololens2", "hololens2"),
                            ("hololens_third", "hololens, every 3rd frame"), ("hololens2_third", "hololens2, every 3rd frame")):
        row = of(rows, recording=recording, poses="none")[0]
        yield [name, row["frames"], cm(row["ate_rigid_m"]), cm(row["ate_similarity_m"]), row["scale"], row["processor_s"] + " s"]


def mapping_growth(rows):
    for row in rows:
        back = cm(row["revisit_worst_m"]) if row["revisit_worst_m"] else ""
        yield [row["frames"], row["walk_s"] + " s", row["keyframes"], cm(row["ate_rigid_m"]), cm(row["worst_m"]), back,
               row["times_faster_than_walk"], row["most_memory_mib"] + " MiB"]


def mapping_localized(rows):
    for row in of(rows, truth="given"):
        if not row["recording"].startswith("room"):
            yield [None, row["poses"], f"{row['within_5cm_5deg']} of {row['frames']}",
                   f"{row['worst_key']} of {int(row['frames']) // int(row['keys'])}", f"{row['median_cm']} cm, {row['median_deg']} deg",
                   row["p90_cm"] + " cm"]


def mapping_peers(rows):
    names = {"spherecloud": "`spherecloud map`", "colmap global": "COLMAP", "colmap global exhaustive": "COLMAP, exhaustive",
             "open3d": "Open3D"}
    for row in rows:
        figures = [cm(row["ate_rigid_m"]), cm(row["ate_similarity_m"]), row["scale"]]
        diverged = Decimal(row["ate_rigid_m"]) > 1
        yield [row["recording"], names[row["mapper"]], *(["diverged", "-", "-"] if diverged else figures), row["processor_s"] + " s"]


def nasty(rows):
    apart = ("menu", "flat", "wallpaper", "binders", "papered", "office")  # the page tells of them beside its table
    for name, mode in (("single frames", "single"), ("tracking", "tracking"), ("tracking with odometry", "odometry")):
        members = [row for row in of(rows, mode=mode) if row["world"] not in apart]
        tracking = "" if mode == "single" else str(total(members, "wrong_tracking"))
        yield [name, *(f"{total(members, column):,}".replace(",", " ") for column in ("frames", "accepted")),
               str(total(members, "wrong_accepted")), tracking]


QUOTES = {"capture.md": (late_depth,), "hints.md": (hints,), "consistency.md": (negative,), "localizer.md": (rolling,),
          "mapping.md": (mapping, mapping_growth, mapping_localized, mapping_peers), "testing.md": (nasty,)}


def fits(cells, row):
    return len(row) >= len(cells) and all(want is None or want == is_there for want, is_there in zip(cells, row))


def faults_of(root):
    root, faults = Path(root), []
    for page, quotes in QUOTES.items():
        lines = (root / "docs" / page).read_text(encoding="utf-8").split("\n")
        table = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
        for quote in quotes:
            name = f"tests/pipeline/{quote.__name__}.csv"
            with open(root / name, encoding="utf-8", newline="") as file:
                wanted = list(quote(list(csv.DictReader(file))))
            missing = [cells for cells in wanted if not any(fits(cells, row) for row in table)]
            faults += [f"docs/{page}: no row \"{' | '.join(cell or '...' for cell in cells)}\", which {name} has" for cells in missing]
    return faults


if __name__ == "__main__":
    sys.exit(report(faults_of(sys.argv[1])))
