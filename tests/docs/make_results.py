#!/usr/bin/env python3
"""Writes docs/results.md from the committed results: tests/pipeline/*.csv and tests/memory/*.csv.

    make_results.py ROOT            writes the page
    make_results.py ROOT --check    compares it with the page that is there

All figures stand in the CSV files and on this page.  Pages of methods link to its sections; tables that they quote of it are compared
by check_figures.py.
"""
import csv
import sys
from pathlib import Path

INTRO = """# Results

<!-- Made by tests/docs/make_results.py; edit that, or the CSV files, and run `ninja results_page`. -->

This page is made from the committed CSV files by `ninja results_page`, and the test `docs.results_are_current` fails
when it is stale. Each section names its file and the build target that measures it again.

- *simulated* is the headset of [drivers_simulated.md](drivers_simulated.md). *redkitchen* is from the data set
  7-Scenes, *hololens* is a walk through three rooms with a HoloLens. In *hololens_blocks* each block of frames is
  localized by a map of the other blocks.
- *gaussian* are the paper's fakes, *patchwork* the default ([fakes.md](fakes.md)). *eta* is the share of real points.
- A table has ratios of times and no milliseconds, since machines differ. [testing.md](testing.md#results) says which
  files a test compares with what it measures.
"""


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def cell(text):
    return text.replace("|", "\\|")


def label(column):
    return cell(column.replace("_", " "))


def table(columns, rows):
    """A Markdown table; the columns are names, the rows lists of text."""
    lines = ["| " + " | ".join(map(label, columns)) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(map(cell, row)) + " |" for row in rows]) + "\n"


def groups(rows, columns):
    """Rows by their values in these columns, in the order of the file."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[column] for column in columns), []).append(row)
    return found


def flat(rows, by, level="###"):
    """A table for each value of the columns `by`, with all other columns that are not empty."""
    parts = []
    for values, members in groups(rows, by).items():
        columns = [name for name in members[0] if name not in by and any(row[name] for row in members)]
        if by:
            parts.append(f"{level} {', '.join(values)}\n")
        parts.append(table(columns, [[row[name] for name in columns] for row in members]))
    return "\n".join(parts)


def pivot(rows, by, across, value):
    """A table with a row for each value of the columns `by`, and a column for each value of `across`."""
    columns = list(dict.fromkeys(row[across] for row in rows))
    by = [name for name in by if any(row[name] for row in rows)]
    body = []
    for values, members in groups(rows, by).items():
        known = {row[across]: row[value] for row in members}
        body.append([*values, *(known.get(name, "") for name in columns)])
    return table([*by, *columns], body)


def attack(rows, name):
    chosen = [row for row in rows if row["attack"] == name]
    return pivot(chosen, ["map", "strategy", "eta", "variant"], "metric", "value")


def attack_by_map(rows, name, metric):
    """One metric of an attack: a row for each map and strategy, a column for each variant."""
    chosen = [row for row in rows if row["attack"] == name and row["metric"] == metric]
    return pivot(chosen, ["map", "strategy"], "variant", "value")


def readable(text):
    """Bytes as people say them; nothing where the number says it."""
    size = int(text)
    if size < 4096:
        return ""
    return f"{size / 1024:.0f} KiB" if size < 1024 * 1024 else f"{size / 1048576:.2f} MiB"


def memory(rows):
    """What each configuration takes as a whole, then the large pieces of the usual one."""
    whole = [[row["configuration"], row["memory"], row["bytes"], readable(row["bytes"])] for row in rows
             if row["piece"] == "all"]
    usual = sorted((row for row in rows if row["configuration"] == "640x480/800 keypoints" and row["piece"] != "all"),
                   key=lambda row: -int(row["bytes"]))[:8]
    other = [row for row in rows if row["piece"] not in ("all",) and row["memory"] == "map file"]
    return "\n".join([
        table(["configuration", "memory", "bytes", ""], whole),
        "The largest pieces of 640 x 480 with 800 keypoints:\n",
        table(["memory", "piece", "bytes"], [[row["memory"], row["piece"], row["bytes"]] for row in usual]),
        "A map file:\n",
        table(["piece", "bytes"], [[row["piece"], row["bytes"]] for row in other])])


def growth(rows):
    """Time of the pose stage against the number of correspondences, and against eta: ratios to the peer's."""
    parts = []
    for axis in dict.fromkeys(row["axis"] for row in rows):
        chosen = [row for row in rows if row["axis"] == axis]
        parts.append(f"### By {axis.replace('_', ' ')}\n")
        parts.append(pivot(chosen, ["file", "depth", "how", "x"], "variant", "times_faster_than_poselib"))
    return "\n".join(parts)


def audit(rows):
    """One table a strategy: figures down, maps across."""
    chosen = [row for row in rows if row["attack"] == "audit"]
    parts = []
    for (strategy,), members in groups(chosen, ["strategy"]).items():
        single = [row for row in members if row["map"] != "all"]
        # The variant counts views or repeats eta, which differ from map to map; the rest names what was attacked.
        for row in single:
            row["of"] = "" if row["variant"].endswith("views") or row["variant"].startswith("eta is") else row["variant"]
        parts.append(f"### {strategy}\n\n" + pivot(single, ["metric", "of"], "map", "value"))
        whole = [row for row in members if row["map"] == "all"]
        if whole:
            parts.append("All maps together:\n\n" + pivot(whole, ["variant"], "metric", "value"))
    return "\n".join(parts)


def at_a_glance(rows):
    """The default fakes at eta 1/3, each frame by itself: one row a recording."""
    chosen = [row for row in rows if (row["fakes"], row["mode"], row["eta"]) == ("patchwork", "single", "0.33")]
    if not chosen:
        raise ValueError("accuracy.csv has no row of patchwork, single, 0.33")
    shown = ("recording", "keys", "frames", "localized", "within", "median_cm", "median_deg", "worst_cm", "wrong_accepted")
    columns = [name for name in chosen[0] if name.startswith(shown)]
    return table(columns, [[row[name] for name in columns] for row in chosen])


def localization(rows):
    """(title, file, target, what the figures are, the tables): the localizer and its stages."""
    return [
        ("Accuracy", "pipeline/accuracy.csv", "update_results",
         "Whole recordings through `spherecloud localize`, 800 keypoints a frame. Percentages are of all frames; errors are\n"
         "of the frames that were localized. Where a row has several keys, a column that ends in *median* or *worst* is over the\n"
         "keys. Frames of *..._elsewhere* are of another place, and those of *..._rest* of the rest of the walk: most of them\n"
         "must be refused. Method: [testing.md](testing.md#accuracy), [localizer.md](localizer.md).",
         flat(rows("accuracy.csv"), ["recording"])),
        ("Whole frames", "pipeline/frame.csv", "frame_results",
         "The localizer beside pipelines of packages on an open point map of the same place, at eta 33 %, in one interleaved\n"
         "run. `times faster than peer`: the time of `opencv sift, faiss ivf 16` over this one's. The group *scaling* has\n"
         "maps of redkitchen of growing size. Measured on 2026-11-29, bytes too; the current ones are in [Memory](#memory).\n"
         "Method: [bench.md](bench.md#whole-frames).",
         flat(rows("frame.csv"), ["recording"])),
        ("Features", "pipeline/features.csv", "features_results",
         "Keypoints and matches of pairs of frames 8 and 20 apart; *verified* ones agree with the recorded poses.\n"
         "Method: [bench.md](bench.md#features), [features.md](features.md).",
         flat(rows("features.csv"), ["recording"])),
        ("Alignment", "pipeline/align.csv", "align_results",
         "redkitchen. `edge px`: median distance from depth edges to image edges. Method: [bench.md](bench.md#alignment),\n"
         "[alignment.md](alignment.md).",
         flat(rows("align.csv"), ["depth"])),
        ("Matching", "pipeline/match.csv", "match_results",
         "1000 queries of redkitchen on maps of growing size. `times faster than ivf`: than the fastest `faiss ivf` row of\n"
         "at least the same `ratio set recall`. Method: [bench.md](bench.md#matching), [matching.md](matching.md).",
         flat(rows("match.csv"), ["points"])),
        ("Pose", "pipeline/pose.csv", "pose_results",
         "Estimators on the same correspondences with known poses. *tof*: depth of the sensor; *oracle*: depth of the true\n"
         "points. PoseLib, OpenCV and OpenGV get the true points and no fake. Method: [bench.md](bench.md#pose),\n"
         "[pose.md](pose.md).",
         flat(rows("pose.csv"), ["file", "depth"])),
        ("Growth of the pose stage", "pipeline/pose_growth.csv", "pose_growth_results",
         "PoseLib's time over the variant's, of the same run. Method: [bench.md](bench.md#growth).",
         growth(rows("pose_growth.csv"))),
    ]


def trust(rows):
    """How far poses are to be believed."""
    return [
        ("Confidence", "pipeline/confidence.csv", "update_results",
         "The poses of the accuracy rows, pooled over the keys: how often they are right, what they said, and their errors\n"
         "over the stated sigmas. `ece`: expected calibration error. *Sure*: a confidence of 0.99 or more. Method:\n"
         "[confidence.md](confidence.md).",
         flat(rows("confidence.csv"), ["recording", "fakes", "mode"])),
        ("Hard worlds", "pipeline/nasty.csv", "nasty_results",
         "Simulated rooms that combine what makes real ones hard. Wrong: beyond 25 cm or 10 deg. Method:\n"
         "[testing.md](testing.md#hard-worlds).",
         flat(rows("nasty.csv"), ["world"])),
    ]


def mapping(rows):
    """Maps of walks without poses."""
    return [
        ("Mapping without poses", "pipeline/mapping.csv", "mapping_results",
         "Walks mapped by their images and depths alone (`none`), and with poses that are off by 5 cm and 1 deg each (`approximate`) or\n"
         "drift by 1 % and 1 deg after a metre (`odometry`), beside the poses that the recordings hold. `ate`: root of the mean square of\n"
         "the places' errors, after the best rigid alignment, without any, and after the best similarity; `scale`: a true metre as mapped.\n"
         "Rotations after the rigid alignment by places. Method: [mapping.md](mapping.md).",
         flat(rows("mapping.csv"), ["world", "poses"])),
        ("Growth of mapping", "pipeline/mapping_growth.csv", "mapping_growth_results",
         "A walk round and round in one simulated room at 30 Hz, and twice through a flat of eight rooms. `worst m`: of one frame, after the\n"
         "rigid alignment; `times faster than walk`: its length over the time of the whole command, on two cores; `processor s a walk s`: of\n"
         "all threads; memory: the most that was resident. Method: [mapping.md](mapping.md#long-walks).",
         flat(rows("mapping_growth.csv"), ["world"])),
        ("Mapping of flats", "pipeline/mapping_flats.csv", "mapping_flats_results",
         "Simulated flats of eight rooms at 4 Hz, each once through all rooms and on into the first ones again, 165 s. `revisit worst m`: how\n"
         "far the path misses itself at most where it comes back. Other columns as above. Method: [mapping.md](mapping.md#long-walks).",
         flat(rows("mapping_flats.csv"), [])),
        ("Localization in maps without poses", "pipeline/mapping_localized.csv", "mapping_localized_results",
         "Frames that are in neither map, localized one by one (eta 33 %, `--align`) in maps of the same frames: with the poses that the\n"
         "recording holds (`given`), and mapped without (`found`). `truth`: the poses that the answers are compared with, the recording's or\n"
         "those that `map` finds for all of its frames. Counts are sums over the keys; `worst key`: within 5 cm and 5 deg. Errors are medians\n"
         "over the keys. Method: [mapping.md](mapping.md).",
         flat(rows("mapping_localized.csv"), ["recording"])),
        ("Mapping by others", "pipeline/mapping_peers.csv", "mapping_peers_results",
         "The same real walks by COLMAP (its scale from depth) and by Open3D's RGB-D odometry and pose graph, one after another on the\n"
         "same machine. `processor_s`: of all threads. Method: [mapping.md](mapping.md#beside-others).",
         flat(rows("mapping_peers.csv"), ["recording"])),
        ("Calibrations refined", "pipeline/calibration_fit.csv", "calibration_fit_results",
         "Walks mapped with a calibration as it was given, and with `--refine-calibration`: by how much focal length, principal\n"
         "point, and turn and shift of `color_from_depth` are off, and the path's error after a rigid alignment. *spoiled*: off at\n"
         "random; *sound*: as the recording has it, which for real ones counts as the truth. Method: [mapping.md](mapping.md).",
         flat(rows("calibration_fit.csv"), ["given", "calibration"])),
    ]


def commands(rows):
    """What the command does when the system fails it, and says while a walk is recorded."""
    return [
        ("Faults of the system", "pipeline/faults.csv", "faults_results",
         "Commands that write, with one call of the system that fails in each run, or with the end of the process there. `calls`: how many\n"
         "of the kind the command makes; `tried`: how many of them failed, one a run. *Refused*: exit status 1 with a cause; *done*: all files\n"
         "are there. Method: [testing.md](testing.md#faults-of-the-system).",
         flat(rows("faults.csv"), ["command"])),
        ("Guidance", "pipeline/guide.csv", "guide_results",
         "What is said while a walk is recorded. `confirmed`: pairs of views that two comparisons take for a loop; `false`: of these,\n"
         "beyond 25 cm or 10 deg of the recording's poses; `loops`: what is told of them. The last columns count frames, each alone.\n"
         "Method: [guide.md](guide.md).",
         flat(rows("guide.csv"), ["world"])),
    ]


def devices(rows):
    """Several maps, devices, shutters and cameras."""
    return [
        ("Many maps", "pipeline/maps.csv", "maps_results",
         "Cold frames of simulated rooms in the map of their room alone, and in all maps of one localizer, a double for every fourth\n"
         "room. Wrong: in the map of another room, or beyond 25 cm or 10 deg. Method: [localizer.md](localizer.md#several-maps).",
         flat(rows("maps.csv"), ["maps"])),
        ("Maps of other devices", "pipeline/cameras.csv", "cameras_results",
         "Twelve simulated rooms, six of them hard, mapped by one device with ten frames, and localized in by another. Wrong: beyond\n"
         "25 cm or 10 deg. Method: [localizer.md](localizer.md#a-map-of-another-device).",
         flat(rows("cameras.csv"), ["map", "query"])),
        ("Rolling shutters", "pipeline/rolling.csv", "rolling_results",
         "Two seconds at 30 Hz in each of twelve simulated rooms, six of them hard, on a lap of ten seconds; maps of ten frames. `rolling`:\n"
         "20 ms from the first row to the last; `straightened`: the same, and the row time is told. Wrong: beyond 25 cm or 10 deg. Method: [localizer.md](localizer.md#rolling-shutters).",
         flat(rows("rolling.csv"), ["device", "map_shutter", "query_shutter"])),
        ("Rigs of several cameras", "pipeline/rig.csv", "rig_results",
         "Cold frames of twelve simulated rooms with bare walls, by the first camera of a rig and by more of them, with as many\n"
         "keypoints in all: as the walk looks, and with nothing but a wall ahead. Method: [localizer.md](localizer.md#rigs-of-several-cameras).",
         flat(rows("rig.csv"), ["view"])),
    ]


def sensors(rows):
    """Sensors that are broken, doubtful or late, and what is said of them."""
    return [
        ("Broken sensors", "pipeline/negative.csv", "negative_results",
         "Sequences of 30 frames, broken in every way. Wrong: beyond 25 cm or 10 deg; sure: with a confidence above 0.5.\n"
         "`named`: frames whose result names a fault. Method: [consistency.md](consistency.md).",
         flat(rows("negative.csv"), ["recording", "fakes", "mode"])),
        ("Masks by amplitude", "pipeline/amplitude.csv", "amplitude_results",
         "Raw depth of the simulated headset, localized without masks (`amplitude_min` 0) and with them. Right: within 5 cm and\n"
         "5 deg; wrong: beyond 25 cm or 10 deg. Errors: the median over the rooms, and the worst room. Method:\n"
         "[formats.md](formats.md#amplitude-and-confidence-of-depth).",
         flat(rows("amplitude.csv"), ["world"])),
        ("Late depth", "pipeline/late_depth.csv", "late_depth_results",
         "Frames of simulated rooms whose depth is older than colour, in maps of a lap; and frames as the headset takes them, 4 ms apart,\n"
         "in maps of a short walk, some of them of older depth. Sure: with a confidence of 0.95 or more. `error_over_sigma`: root mean square;\n"
         "1 is honest. Method: [capture.md](capture.md#motion-between-the-two-exposures).",
         flat(rows("late_depth.csv"), ["map"])),
        ("Hints", "pipeline/hints.csv", "hints_results",
         "Frames without a pose under conditions, and what they are told. `told`: the hint of the condition; of healthy frames, none.\n"
         "Method: [hints.md](hints.md).",
         flat(rows("hints.csv"), ["place"])),
    ]


def costs(rows):
    """What frames cost."""
    return [
        ("Deadlines", "pipeline/deadline.csv", "deadline_results",
         "Frames that end within their deadline and 0.3 ms, in processor time, and what is left of the poses. A deadline of 0 is none.\n"
         "Each frame goes through all deadlines of a table before the next one does. The last of `single` and `tracking` is half of the median\n"
         "time without one of the last 31 frames; what stands there is its median.\n"
         "Right: within 5 cm and 5 deg; wrong: beyond 25 cm or 10 deg. Method: [localizer.md](localizer.md#a-deadline).",
         flat(rows("deadline.csv"), ["recording", "case"])),
        ("Worst cases", "pipeline/worst.csv", "worst_results",
         "Frames and maps made to cost the most, beside the frames and the map that they were made of, each by itself. `times normal`: processor\n"
         "time over the median of a normal frame; `times deadline`: over a deadline of twice that. Measured on 2026-11-24, bytes too; the current ones are in\n"
         "[Memory](#memory). Method: [testing.md](testing.md#worst-cases).",
         flat(rows("worst.csv"), ["recording"])),
        ("Several cores", "pipeline/parallel.csv", "parallel_results",
         "Cold frames on a map of 50 000 points, by one thread and by several in turn: the median wall time of one over that of\n"
         "the row. `same bytes`: frames with the result of one thread. Method: [localizer.md](localizer.md#on-several-cores).",
         flat(rows("parallel.csv"), ["recording"])),
    ]


def peers(rows):
    """The systems of the literature, codecs, and descriptors."""
    return [
        ("Baselines", "pipeline/compare.csv", "compare_results",
         "Systems of the literature on the same matches. `times slower than sphere`: the median time over that of the\n"
         "library at eta 33 %. Method: [baselines.md](baselines.md).",
         flat(rows("compare.csv"), ["input", "depth"])),
        ("Recording codecs", "pipeline/recording.csv", "recording_results",
         "Depth codecs: how much smaller than raw, and time to encode over that of the default.\n"
         "Method: [recording.md](recording.md).",
         flat(rows("recording.csv"), ["recording", "width", "height"])),
        ("Descriptors", "pipeline/descriptors.csv", "descriptors_results",
         "Coarser descriptors, and descriptors under a key: what localization loses and what a stranger can still tell.\n"
         "Method: [descriptors.md](descriptors.md).",
         flat(rows("descriptors.csv"), ["place"])),
    ]


def robustness(rows):
    """Fuzzers, the soak, and what tests reach."""
    return [
        ("Fuzzing", "pipeline/fuzz.csv", "fuzz_results",
         "libFuzzer on one core of a machine that did other work too. `edges`: of the code, reached; `inputs`: that add coverage; `findings`:\n"
         "inputs that crashed, took more than 20 s or left a promise unkept. A run of `map` reads a map twice, as it is and with its checksums\n"
         "made right; a run of `session` makes up to 40 calls. Method: [testing.md](testing.md#fuzzing).",
         flat(rows("fuzz.csv"), ["sanitizers"])),
        ("Soak", "pipeline/soak.csv", "soak_results",
         "A headset in fast motion; every answer is checked, and a promise that is not kept ends the run. `elsewhere`: frames of a room without a\n"
         "map; wrong poses: of frames that are not broken, beyond 25 cm or 10 deg. Method: [testing.md](testing.md#soak).",
         flat(rows("soak.csv"), [])),
        ("Coverage", "pipeline/coverage.csv", "coverage_results",
         "Lines and branches that tests reach (clang). `device`: the libraries of a device, by their unit tests and those of the C interface; `parsers`:\n"
         "what reads files of others, by its unit tests and mutations of seeds.\n"
         "Method: [testing.md](testing.md#coverage).",
         flat(rows("coverage.csv"), [])),
    ]


def privacy(rows):
    """What attacks won."""
    releases = ("intersection", "triangulation", "leaks", "presence", "querying client")
    return [
        ("Density attack", "pipeline/privacy.csv", "density_results",
         "Points recovered from lines alone. Method: [baselines.md](baselines.md#the-density-attack).",
         attack(rows, "density")),
        ("Real or fake", "pipeline/privacy.csv", "audit_results",
         "AUC by cue and classifier (0.5 is chance); precision of the share eta and of the tenth that score highest (chance:\n"
         "eta); AUC of layers that an oracle has separated. Patchwork and warped: means of two keys. Method:\n"
         "[real_or_fake.md](real_or_fake.md).",
         attack_by_map(rows, "real_or_fake", "auc")
         + "\nPrecision of the share eta:\n\n" + attack_by_map(rows, "real_or_fake", "precision_at_eta")
         + "\nPrecision of the first tenth:\n\n" + attack_by_map(rows, "real_or_fake", "precision_at_tenth")
         + "\nAUC of layers:\n\n" + attack_by_map(rows, "real_or_fake", "auc_of_layers")),
        ("Image inversion", "pipeline/privacy.csv", None,
         "Measured by the program `measure_inversion` ([README](../sdk/lab/train/README.md)); no target of the build measures it.\n"
         "Pictures painted from the sphere centre, before near-duplicates were merged and with one network; the audit below\n"
         "has maps as they are published today. Method: [inversion.md](inversion.md).",
         attack(rows, "inversion")),
        ("Audit", "pipeline/privacy.csv", "audit_results",
         "Every map under `spherecloud audit`. Method: [audit.md](audit.md).",
         audit(rows)),
        ("Several releases", "pipeline/privacy.csv", "releases_results",
         "One place released several times, without discipline (*undisciplined*) and through the owner's ledger\n"
         "(*released*). Method: [release.md](release.md).",
         "\n".join(f"### {name[0].upper()}{name[1:]}\n\n{attack(rows, name)}" for name in releases)),
    ]


def memory_sections(folder):
    return [
        ("Memory", "memory/bytes.csv", "memory_results", "What a caller hands over. Method: [memory.md](memory.md).",
         memory(read(folder / "bytes.csv"))),
        ("Code size", "portability/size.csv", "size_results",
         "Code and constants of a program that calls the whole interface but capture, for each machine, and what a test allows.\n"
         "A dynamic C library is not in it. Method: [boards.md](boards.md#code-size).",
         flat(read(folder.parent / "portability" / "size.csv"), [])),
        ("Stack", "memory/stack.csv", "memory_results", "A ceiling for each call; the tests fail above it.",
         flat(read(folder / "stack.csv"), [])),
    ]


def page(root):
    pipeline = Path(root) / "tests" / "pipeline"
    parts = [INTRO, f"## At a glance\n\nThe default fakes (patchwork, eta 1/3), each frame by itself:\n\n"
                    f"{at_a_glance(read(pipeline / 'accuracy.csv'))}"]

    def rows(name):
        return read(pipeline / name)

    of_pipeline = localization, trust, mapping, commands, devices, sensors, costs, peers, robustness
    sections = [section for part in of_pipeline for section in part(rows)]
    sections += privacy(rows("privacy.csv")) + memory_sections(Path(root) / "tests" / "memory")
    for title, file, target, words, tables in sections:
        measured = f", measured by `ninja {target}`" if target else ""
        parts.append(f"## {title}\n\n[`tests/{file}`](../tests/{file}){measured}.\n{words}\n\n{tables}")
    return "\n".join(parts)


def main():
    root = Path(sys.argv[1])
    path, text = root / "docs" / "results.md", page(root)
    if "--check" not in sys.argv[2:]:
        path.write_text(text, encoding="utf-8")
        return 0
    if path.exists() and path.read_text(encoding="utf-8") == text:
        print("docs/results.md says what the CSV files say")
        return 0
    print("docs/results.md is stale: run `ninja results_page`, look at the difference and commit it")
    return 1


if __name__ == "__main__":
    sys.exit(main())
