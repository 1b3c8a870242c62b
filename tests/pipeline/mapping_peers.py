#!/usr/bin/env python3
"""How do others map the walks of mapping.py?  Real recordings through `spherecloud map`, COLMAP and Open3D, one after another.

    mapping_peers.py --spherecloud BIN [--only NAME...]      rewrites rows of mapping_peers.csv, for review

It needs `pip install pycolmap open3d numpy opencv-python-headless`.  COLMAP has no depth: its scale is the median, over the points
that it triangulated, of measured depth by its own.  Open3D's is RGB-D odometry between neighbours, loops by odometry
between frames that its own poses bring near, and a pose graph over them.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import HERE, Ledger, Recording, require, run

RESULTS = HERE / "mapping_peers.csv"
COLUMNS = ["recording", "mapper", "frames", "frames_mapped", "parts", "ate_rigid_m", "ate_similarity_m", "scale", "processor_s"]
FRAMES = {"redkitchen": 200, "hololens": 200, "hololens2": 173}  # the first ones: those of mapping.py
MAPPERS = ["spherecloud", "colmap global", "colmap global exhaustive", "open3d"]


class Walk:
    """A recording in the TUM layout: frames as (time, colour file, depth file), cameras, and the poses that score."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.calibration = json.loads((self.folder / "calibration.json").read_text())
        color, depth = ([line.split() for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]
                        for name in ("rgb.txt", "depth.txt"))
        self.frames = [(float(c[0]), c[1], d[1]) for c, d in zip(color, depth)]

    def truth(self):
        return read_trajectory(self.folder / "groundtruth.txt")

    def depth_m(self, index):
        import cv2
        image = cv2.imread(str(self.folder / self.frames[index][2]), cv2.IMREAD_UNCHANGED)
        return image.astype("float32") * self.calibration["depth_unit_m"]

    def depth_from_color(self):
        import numpy
        rotation = rotation_of(self.calibration["color_from_depth"]["q_wxyz"])
        shift_m = numpy.array(self.calibration["color_from_depth"]["t_m"])
        return rotation.T, -rotation.T @ shift_m


def prepare(name, tool, folder):
    """The frames of mapping.py's walk, in a folder of their own."""
    option, path, _, calibration = Recording(name, tool, folder).place("map")
    walk = folder / name
    run([tool, "convert", path, walk, "--calibration", calibration, "--json"])
    for listed in ("rgb.txt", "depth.txt"):
        frames = [line for line in (walk / listed).read_text().splitlines() if not line.startswith("#")]
        (walk / listed).write_text("\n".join(frames[:FRAMES[name]]) + "\n")
    return walk


def rotation_of(q):
    import numpy
    w, x, y, z = q
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def read_trajectory(path):
    """time: position."""
    places = {}
    for line in pathlib.Path(path).read_text().splitlines():
        if line and not line.startswith("#"):
            numbers = [float(x) for x in line.split()]
            places[round(numbers[0], 3)] = numbers[1:4]
    return places


def errors(found, truth):
    """RMSE after the best rigid alignment and the best similarity, and its scale (Umeyama 1991)."""
    import numpy
    times = sorted(set(found) & set(truth))
    a, b = numpy.array([found[t] for t in times]), numpy.array([truth[t] for t in times])
    ca, cb = a - a.mean(0), b - b.mean(0)
    u, s, vt = numpy.linalg.svd(cb.T @ ca)
    flip = numpy.diag([1, 1, numpy.sign(numpy.linalg.det(u @ vt))])
    rotation = u @ flip @ vt
    scale = numpy.trace(numpy.diag(s) @ flip) / (ca ** 2).sum()

    def rmse(k):
        return float(numpy.sqrt(((k * ca @ rotation.T - cb) ** 2).sum(1).mean()))

    return rmse(1), rmse(scale), 1 / float(scale)


def ours(walk, tool, out):
    run([tool, "map", "--recording", walk.folder, "--model", out.with_suffix(".model"), "--trajectory", out, "--json"])
    return 1


def measured_scale(walk, reconstruction):
    """Median of measured depth by the reconstruction's."""
    import numpy
    p = walk.calibration["depth_camera"]["params"]
    rotation, shift_m = walk.depth_from_color()
    index_of = {frame[1]: i for i, frame in enumerate(walk.frames)}
    scale = 1.0
    for _ in range(3):  # the cameras are apart by metres, so the scale decides which pixel is looked at
        ratios = []
        for image in reconstruction.images.values():
            if not image.has_pose:
                continue
            depth_m = walk.depth_m(index_of[image.name])
            pose = image.cam_from_world()
            points = numpy.array([reconstruction.points3D[q.point3D_id].xyz for q in image.points2D if q.has_point3D()])
            if not len(points):
                continue
            seen = (points @ pose.rotation.matrix().T + pose.translation) * scale @ rotation.T + shift_m
            seen = seen[seen[:, 2] > 0.1]
            u = numpy.floor(p[0] * seen[:, 0] / seen[:, 2] + p[2] + 0.5).astype(int)
            v = numpy.floor(p[1] * seen[:, 1] / seen[:, 2] + p[3] + 0.5).astype(int)
            inside = (u >= 0) & (v >= 0) & (u < depth_m.shape[1]) & (v < depth_m.shape[0])
            measured = depth_m[v[inside], u[inside]]
            ratios.extend(measured[measured > 0.3] / seen[inside, 2][measured > 0.3])
        scale *= float(numpy.median(ratios))
    return scale


def colmap(walk, out, kind):
    import pycolmap
    database, folder = out.parent / "colmap.db", out.parent / "colmap"
    folder.mkdir(exist_ok=True)
    reader = pycolmap.ImageReaderOptions()
    camera = walk.calibration["color_camera"]
    reader.camera_model, reader.camera_params = "PINHOLE", ",".join(str(x) for x in camera["params"])
    names = [frame[1] for frame in walk.frames]
    cpu = pycolmap.Device.cpu
    pycolmap.extract_features(database, walk.folder, image_names=names, camera_mode=pycolmap.CameraMode.SINGLE, reader_options=reader,
                              device=cpu)
    if "exhaustive" in kind:
        pycolmap.match_exhaustive(database, device=cpu)
    else:
        pycolmap.match_sequential(database, device=cpu)
    models = pycolmap.global_mapping(database, walk.folder, folder)
    best = max(models.values(), key=lambda model: model.num_reg_images())
    scale = measured_scale(walk, best)
    time_of = {frame[1]: frame[0] for frame in walk.frames}
    lines = []
    for image in best.images.values():
        if image.has_pose:
            x, y, z = scale * image.projection_center()
            lines.append("%.6f %.9f %.9f %.9f 0 0 0 1" % (time_of[image.name], x, y, z))
    out.write_text("\n".join(lines) + "\n")
    return len(models)


def registered(walk, index):
    """Depth on the colour image, the nearest of what falls on a pixel."""
    import numpy
    depth_m = walk.depth_m(index)
    p, c = walk.calibration["depth_camera"]["params"], walk.calibration["color_camera"]
    rotation, shift_m = walk.depth_from_color()
    v, u = numpy.nonzero(depth_m > 0.3)
    z = depth_m[v, u]
    points = (numpy.stack([(u - p[2]) / p[0] * z, (v - p[3]) / p[1] * z, z], 1) - shift_m) @ rotation  # color_from_depth
    f = c["params"]
    x = numpy.floor(f[0] * points[:, 0] / points[:, 2] + f[2] + 0.5).astype(int)
    y = numpy.floor(f[1] * points[:, 1] / points[:, 2] + f[3] + 0.5).astype(int)
    inside = (x >= 0) & (y >= 0) & (x < c["width"]) & (y < c["height"])
    image = numpy.full((c["height"], c["width"]), 1e9, numpy.float32)
    numpy.minimum.at(image, (y[inside], x[inside]), points[inside, 2].astype(numpy.float32))
    image[image > 1e8] = 0
    return image


def open3d(walk, out):
    import cv2
    import numpy
    import open3d as o3
    c = walk.calibration["color_camera"]
    lens = o3.camera.PinholeCameraIntrinsic(c["width"], c["height"], *c["params"][:4])
    images = []
    for i, frame in enumerate(walk.frames):
        color = cv2.cvtColor(cv2.imread(str(walk.folder / frame[1])), cv2.COLOR_BGR2RGB)
        images.append(o3.geometry.RGBDImage.create_from_color_and_depth(
            o3.geometry.Image(color), o3.geometry.Image(registered(walk, i)), depth_scale=1.0, depth_trunc=6.0))
    odometry = o3.pipelines.odometry
    options = odometry.OdometryOption()

    def between(i, j, guess):
        return odometry.compute_rgbd_odometry(images[i], images[j], lens, guess, odometry.RGBDOdometryJacobianFromHybridTerm(), options)

    registration = o3.pipelines.registration
    graph = registration.PoseGraph()
    pose = numpy.eye(4)
    graph.nodes.append(registration.PoseGraphNode(pose))
    for i in range(1, len(images)):
        good, step, information = between(i - 1, i, numpy.eye(4))
        pose = step @ pose
        graph.nodes.append(registration.PoseGraphNode(numpy.linalg.inv(pose)))
        graph.edges.append(registration.PoseGraphEdge(i - 1, i, step, information, uncertain=not good))
    for i in range(0, len(images), 5):
        for j in range(i + 10, len(images), 5):
            guess = numpy.linalg.inv(graph.nodes[j].pose) @ graph.nodes[i].pose
            if numpy.linalg.norm(guess[:3, 3]) > 0.5 or guess[2, 2] < 0.9:
                continue
            good, step, information = between(i, j, guess)
            if good:
                graph.edges.append(registration.PoseGraphEdge(i, j, step, information, uncertain=True))
    registration.global_optimization(
        graph, registration.GlobalOptimizationLevenbergMarquardt(), registration.GlobalOptimizationConvergenceCriteria(),
        registration.GlobalOptimizationOption(max_correspondence_distance=0.03, edge_prune_threshold=0.25, reference_node=0))
    out.write_text("".join("%.6f %.9f %.9f %.9f 0 0 0 1\n" % (frame[0], *node.pose[:3, 3])
                           for frame, node in zip(walk.frames, graph.nodes)))
    return 1


def map_by(mapper, walk, tool, out):
    """Writes the trajectory; number of parts."""
    if mapper == "spherecloud":
        return ours(walk, tool, out)
    return open3d(walk, out) if mapper == "open3d" else colmap(walk, out, mapper)


def processor_s():
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def measure(mapper, folder, tool):
    """A process of its own: what libraries keep and spend is this mapper's."""
    walk = Walk(folder)
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch) / "found.tum"
        begin_s = processor_s()
        parts = map_by(mapper, walk, tool, out)
        spent_s = processor_s() - begin_s
        found = read_trajectory(out)
        rigid, similarity, scale = errors(found, walk.truth())
    print(json.dumps([walk.folder.name, mapper, len(walk.frames), len(found), parts, "%.4f" % rigid, "%.4f" % similarity, "%.4f" % scale,
                      "%.0f" % spent_s]))


def wanted_rows():
    """What the rows are of: the first columns of each."""
    return [(name, mapper) for name in FRAMES for mapper in MAPPERS]


def ledger_of(path):
    return Ledger(path, COLUMNS, 2, lambda row: list(FRAMES).index(row[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping_peers.csv]")
    parser.add_argument("--only", nargs="+", default=list(FRAMES), choices=list(FRAMES), help="recordings [all]")
    parser.add_argument("--measure", nargs=2, metavar=("MAPPER", "WALK"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure:
        return measure(*arguments.measure, arguments.spherecloud)
    require(arguments.only)
    ledger = ledger_of(arguments.results)
    with tempfile.TemporaryDirectory() as scratch:
        for name in arguments.only:
            walk = prepare(name, arguments.spherecloud, pathlib.Path(scratch))
            for mapper in MAPPERS:
                done = subprocess.run([sys.executable, __file__, "--spherecloud", arguments.spherecloud, "--measure", mapper, str(walk)],
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                if done.returncode:
                    sys.exit("%s failed on %s\n%s" % (mapper, name, done.stderr[-2000:]))
                row = json.loads(done.stdout.splitlines()[-1])
                print(*row, flush=True)
                ledger.put([row])


if __name__ == "__main__":
    main()
