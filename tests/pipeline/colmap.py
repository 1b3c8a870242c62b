#!/usr/bin/env python3
"""A map from COLMAP's own reconstruction of the simulated headset's images, and frames localized in it.

    colmap.py --spherecloud BIN [--keep FOLDER]

Runs the `colmap` of the machine (Debian's is 3.8) on colour images alone; depth tells the scale.  Exits with 77 (skipped)
and says so where there is none.  COLMAP's world is another than the recording's, so that distances between the localized
frames are compared with the true ones.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import statistics
import sys
import tempfile

from private_key import private_key
from recordings import SKIPPED, ran

FRAMES = 24  # at 4 Hz; even ones are mapped, odd ones localized
# Floors and ceilings.  COLMAP is another at each run: on so few images its camera path is bent by up to a centimetre, and
# distances between frames with it.
LEAST_POINTS, LEAST_SHARE, MOST_CM, MOST_SCALE = 400, 0.7, 6.0, 0.07


def run(command, cwd):
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen")
    return ran(command, accepted=(0, 3), cwd=cwd, env=environment).stdout


def reconstruct(tool, recording, folder):
    """COLMAP on the even frames, with the camera known."""
    (folder / "images").mkdir()
    (folder / "sparse").mkdir()
    for image in sorted((recording / "rgb").iterdir())[::2]:
        shutil.copy(image, folder / "images")
    run([tool, "calibration", recording / "calibration.json", "--to", "colmap", "--out", folder / "cameras"], folder)
    lines = (folder / "cameras" / "cameras.txt").read_text().splitlines()
    _, model, _, _, *parameters = [line.split() for line in lines if not line.startswith("#")][0]
    run(["colmap", "feature_extractor", "--database_path", "database.db", "--image_path", "images",
         "--ImageReader.single_camera", 1, "--ImageReader.camera_model", model, "--ImageReader.camera_params",
         ",".join(parameters), "--SiftExtraction.use_gpu", 0, "--SiftExtraction.num_threads", 2,
         "--SiftExtraction.first_octave", 0, "--SiftExtraction.max_num_features", 900], folder)
    run(["colmap", "sequential_matcher", "--database_path", "database.db", "--SiftMatching.use_gpu", 0,
         "--SiftMatching.num_threads", 2, "--SequentialMatching.overlap", 4,
         "--SequentialMatching.quadratic_overlap", 0], folder)
    run(["colmap", "mapper", "--database_path", "database.db", "--image_path", "images", "--output_path", "sparse",
         "--Mapper.ba_refine_focal_length", 0, "--Mapper.ba_refine_extra_params", 0, "--Mapper.num_threads", 2],
        folder)
    models = list((folder / "sparse").iterdir())
    return max(models, key=lambda model: (model / "points3D.bin").stat().st_size)


def positions(path):
    """time -> position, of a trajectory in the TUM layout."""
    rows = [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return {round(float(row[0]), 3): [float(x) for x in row[1:4]] for row in rows}


def errors(localized, truth):
    """How far distances between frames are off, in cm, and the scale that is still missing: no frame of reference."""
    times = sorted(set(localized) & set(truth))
    pairs = [(math.dist(localized[one], localized[other]), math.dist(truth[one], truth[other]))
             for i, one in enumerate(times) for other in times[:i]]
    off = [100 * abs(found - true) for found, true in pairs]
    return statistics.median(off), statistics.median(true / found for found, true in pairs if true > 0.5)


def check(tool, recording, folder, model, name, source):
    """Builds by `source`, localizes the odd frames; gives what was wrong."""
    map_file = folder / (name + ".sphc")
    built = json.loads(run([tool, "build", "--colmap", model, *source, "--depth", recording / "depth", "--calibration",
                            recording / "calibration.json", "--map", map_file, "--ledger", folder / (name + ".ledger"), "--eta", 0.5, "--key",
                            private_key(folder), "--json"], folder))
    trajectory = folder / (name + ".tum")
    found = json.loads(run([tool, "localize", "--recording", recording, "--first", 1, "--step", 2, "--map", map_file,
                            "--owner-note", str(map_file) + ".owner.json", "--trajectory", trajectory, "--mode",
                            "single", "--json"], folder))
    off, scale = errors(positions(trajectory), positions(recording / "groundtruth.txt"))
    print("%s: %d points, %d of %d frames, median %.2f cm, scale %.4f" %
          (name, built["points_kept"], found["localized"], found["frames"], off, scale))
    if built["points_kept"] < LEAST_POINTS:
        yield "only %d points" % built["points_kept"]
    if found["localized"] < LEAST_SHARE * found["frames"]:
        yield "only %d of %d frames localized" % (found["localized"], found["frames"])
    if not off < MOST_CM:
        yield "median error %.2f cm" % off
    if not abs(math.log(scale)) < MOST_SCALE:
        yield "scale is off by a factor of %.4f" % scale
    up = built["world_from_model_axes"][6:]
    if abs(sum(x * x for x in up) - 1) > 1e-6:
        yield "axes are no rotation"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--keep", help="work in this new folder and leave it there")
    arguments = parser.parse_args()
    if not shutil.which("colmap"):
        print("skipped: no colmap here; toolchains/install_packages.sh test installs it")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.keep or temporary)
        folder.mkdir(exist_ok=True)
        tool, recording = pathlib.Path(arguments.spherecloud).resolve(), folder / "recording"
        run([tool, "simulate", "--out", recording, "--frames", FRAMES, "--rate", 4], folder)
        model = reconstruct(tool, recording, folder)
        faults = []
        for name, source in (("images", ["--images", folder / "images"]),
                             ("database", ["--database", folder / "database.db"])):
            faults += ["%s: %s" % (name, fault) for fault in check(tool, recording, folder, model, name, source)]
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
