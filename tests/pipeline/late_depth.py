#!/usr/bin/env python3
"""What are poses worth whose depth image is of another time than their colour image, and maps that are made of such images?
Walks of simulated rooms at 30 Hz, through the Python binding: each colour image with an earlier depth image and its time, as a
depth sensor that is late or slow gives it.  Maps of a short walk whose depth is older than colour too, its time told or not.

    late_depth.py --spherecloud BIN --library libspherecloud.so [--rooms N]      rewrites late_depth.csv, for review

Times are of the depth images that the headset took, 4 ms after colour: depth that is "older by 17 ms" was taken 13 ms before
colour.  Odometry is the truth, with a small sigma.  Needs numpy.
"""
import collections
import concurrent.futures
import json
import multiprocessing
import os
import pathlib
import shutil
import statistics
import sys

sys.dont_write_bytecode = True
import room_options
from private_key import key_of
from recordings import HERE, ROOT, run, write_csv

sys.path.insert(0, str(ROOT / "bindings" / "python"))
import spherecloud
from spherecloud import Frame, Localizer, Map, Mode, Prior, Recording

RESULTS = HERE / "late_depth.csv"
ROOMS = list(range(7001, 7013))  # seeds of room and walk; cameras.py has them too
LAP_S, MAP_FRAMES, RATE, QUERY_FRAMES = 16, 30, 30, 66
SHORT_FRAMES, SHORT_RATE = 132, 60  # of the short walk, in lap one where the query is in lap two
FIRST, STEP = 6, 3  # frames that are localized: depth of six frames before is there
ETA = 0.33
SURE, RIGHT_M, WRONG_M = 0.95, 0.05, 0.25
ODOMETRY_SIGMA = 1e-3  # rad and m a step

# By how many frames depth is older than the colour image of a frame.
LATE = {"0 ms": lambda frame: 0, "33 ms": lambda frame: 1, "67 ms": lambda frame: 2, "133 ms": lambda frame: 4,
        "200 ms": lambda frame: 6, "0 to 167 ms, at 5 Hz": lambda frame: frame % 6}
# Maps: of a lap, and of the short walk with depth so many frames older, and whether that is told.
LAP = "a lap"
SHORT = {"2 s": (0, True), "2 s, depth older by 17 ms": (1, True), "2 s, depth older by 17 ms, not told": (1, False)}
WAYS = {"single": (Mode.SINGLE, False), "tracking": (Mode.TRACKING, False), "tracking, odometry": (Mode.TRACKING, True)}
COLUMNS = ["map", "depth_is_older_by", "way", "rooms", "frames", "with_pose", "tracking", "sure", "sure_beyond_5cm", "beyond_25cm", "median_cm",
           "worst_median_cm", "p90_cm", "worst_cm", "error_over_sigma"]

Pose = collections.namedtuple("Pose", "error_m error_over_sigma confidence is_tracking")


def walk(tool, out, seed, frames, rate, *arguments):
    run([tool, "simulate", "--out", out, "--seed", seed, "--walk-seed", seed, "--frames", frames, "--rate", rate, "--threads", 1,
         *arguments, "--json"])
    return out


def with_late_depth(source, out, frames, is_told):
    """A walk of every second colour image of another, each with the depth image that is so many frames older."""
    def lines(name):
        return [line.split() for line in (source / name).read_text().splitlines() if not line.startswith("#")]

    def write(name, images):
        (out / name).mkdir(parents=True)
        (out / (name + ".txt")).write_text("".join("%s %s\n" % image for image in images))
        for _, file in images:
            os.link(source / file, out / file)

    color, depth = lines("rgb.txt"), lines("depth.txt")
    chosen = range(frames, len(color), 2)
    write("rgb", [tuple(color[i]) for i in chosen])
    write("depth", [(depth[i - frames if is_told else i][0], depth[i - frames][1]) for i in chosen])
    for name in ("calibration.json", "groundtruth.txt"):
        shutil.copy(source / name, out)
    return out


def prepare(tool, folder, seed):
    """A room's maps, with the owner's notes beside them, and its walk as a raw recording."""
    files = {name: folder / ("%d_%d.sphc" % (seed, number)) for number, name in enumerate([LAP, *SHORT])}
    query = folder / ("%d.raw" % seed)
    if query.exists():
        return files, query
    key = key_of("late depth key %d" % seed, folder / ("%d.key" % seed))
    since_s = LAP_S * (seed - ROOMS[0]) / len(ROOMS)  # each room is entered elsewhere
    walks = {LAP: walk(tool, folder / ("%d_lap" % seed), seed, MAP_FRAMES, MAP_FRAMES / LAP_S)}
    short = walk(tool, folder / ("%d_short" % seed), seed, SHORT_FRAMES, SHORT_RATE, "--from", "%.2f" % since_s)
    for number, (name, (frames, is_told)) in enumerate(SHORT.items()):
        walks[name] = with_late_depth(short, folder / ("%d_short_%d" % (seed, number)), frames, is_told)
    for name, file in files.items():
        run([tool, "build", "--recording", walks[name], "--map", file, "--eta", ETA, "--key", key,
             "--ledger", file.with_suffix(".ledger"), "--json"])
    frames = walk(tool, folder / ("%d_query" % seed), seed, QUERY_FRAMES, RATE, "--from", "%.2f" % (LAP_S + since_s))
    run([tool, "convert", frames, query, "--to", "raw", "--json"])
    return files, query


def pose_of(result, truth, centre_m):
    """centre_m: of the map, in the world of the recording."""
    offsets = [c + m - t for c, m, t in zip(result.pose.inverse().t_m, centre_m, truth.t_m)]
    error_m = sum(x * x for x in offsets) ** 0.5
    variance = sum(result.covariance[i][i] for i in (3, 4, 5))
    return Pose(error_m, error_m / variance ** 0.5, result.confidence, result.state.name == "TRACKING")


def localize(recording, map_file, centre_m, older_by, way):
    """Frames that were looked at, and the poses that were found."""
    mode, has_odometry = WAYS[way]
    poses, frames = [], range(FIRST, len(recording), STEP)
    with Map.open(map_file) as room, Localizer(recording.rig, room, mode=mode) as localizer:
        for number in frames:
            now, depth = recording[number], recording[number - LATE[older_by](number)].frame
            prior = Prior(odometry_from_camera=now.world_from_camera, odometry_rotation_sigma_rad=ODOMETRY_SIGMA,
                          odometry_translation_sigma_m=ODOMETRY_SIGMA) if has_odometry else None
            frame = Frame(now.frame.color, depth.depth, now.frame.color_time_ns, depth.depth_time_ns, prior=prior)
            result = localizer.process(frame)
            if result.pose:
                poses.append(pose_of(result, now.world_from_camera, centre_m))
    return len(frames), poses


def centre_of(map_file):
    return json.loads(pathlib.Path(str(map_file) + ".owner.json").read_text())["centre_in_world_m"]


def measure(tool, library, folder, seed):
    """Of one room all rows: how many frames, and the poses."""
    spherecloud.load(library)
    files, query = prepare(tool, folder, seed)
    recording = Recording(query)
    rows = [(LAP, older_by, way) for older_by in LATE for way in WAYS]
    rows += [(name, "0 ms", way) for name in SHORT for way in ("single", "tracking, odometry")]
    return {row: localize(recording, files[row[0]], centre_of(files[row[0]]), *row[1:]) for row in rows}


def row_of(rooms):
    poses = sorted(pose for _, found in rooms for pose in found)
    errors_cm = [100 * pose.error_m for pose in poses]
    medians_cm = [100 * statistics.median(pose.error_m for pose in found) for _, found in rooms if found]
    sure = [pose for pose in poses if pose.confidence >= SURE]
    counts = [len(rooms), sum(frames for frames, _ in rooms), len(poses), sum(pose.is_tracking for pose in poses), len(sure),
              sum(pose.error_m > RIGHT_M for pose in sure), sum(pose.error_m > WRONG_M for pose in poses)]
    if not poses:
        return counts
    squares = [pose.error_over_sigma ** 2 for pose in poses]
    figures = [statistics.median(errors_cm), max(medians_cm), errors_cm[9 * len(poses) // 10], errors_cm[-1], statistics.mean(squares) ** 0.5]
    return counts + ["%.2f" % figure for figure in figures]


def main():
    parser = room_options.parser_of(__doc__, RESULTS, len(ROOMS))
    parser.add_argument("--library", required=True)
    arguments = parser.parse_args()
    with room_options.folder_of(arguments.keep) as folder:
        with concurrent.futures.ProcessPoolExecutor(os.cpu_count(), multiprocessing.get_context("spawn")) as pool:
            jobs = [pool.submit(measure, arguments.spherecloud, arguments.library, folder, seed)
                    for seed in ROOMS[:arguments.rooms]]
            rooms = [job.result() for job in jobs]
    write_csv(arguments.results, [COLUMNS] + [[*key, *row_of([room[key] for room in rooms])] for key in rooms[0]])


if __name__ == "__main__":
    main()
