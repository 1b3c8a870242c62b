"""Package peers of the whole frame, over stdin and stdout; peer.cpp is the other end.

A message either way is u32 length, JSON, and where the JSON says so ("payload") that many bytes.  Peers work on an
open point map: true 3D points of the mapping frames with their own descriptors, nothing hidden, no fake.  Colour pixels,
first-pixel centre (0, 0) as in OpenCV; poses are world_from_camera; metres.
"""
import importlib
import json
import os
import struct
import sys
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
os.environ["GLOG_minloglevel"] = "2"

MERGE_PX = 3.0  # a keypoint joins a point that reprojects so near ...
MERGE_DEPTH = 0.03  # ... at a depth that differs by at most this share ...
MERGE_SIFT, MERGE_ORB = 250.0, 64  # ... and whose descriptor is as near as this
DEPTH_EDGE = 0.05  # depths around a keypoint differ at most by this share
RATIO = 0.8
PNP_PX, PNP_CONFIDENCE, PNP_ITERATIONS, PNP_FEWEST = 4.0, 0.9999, 1000, 6


def optional(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


np, cv2, faiss, hnswlib, pycolmap = (optional(name) for name in ("numpy", "cv2", "faiss", "hnswlib", "pycolmap"))


def cpu_seconds():
    return 1e-9 * time.process_time_ns()


# ---- cameras


class Cameras:
    """Where depth is measured, seen from the colour camera."""

    def __init__(self, message):
        self.color, self.color_distortion = self.intrinsics(message["color"])
        depth, depth_distortion = self.intrinsics(message["depth"])
        self.size, self.depth_size = message["color"]["size"], message["depth"]["size"]
        self.rotation = np.array(message["color_from_depth"]["rotation"]).reshape(3, 3)
        self.translation = np.array(message["color_from_depth"]["translation_m"])
        self.unit_m, self.nearest_m, self.farthest_m = message["depth_unit_m"], message["depth_min_m"], message["depth_max_m"]
        width, height = self.depth_size
        grid = np.stack(np.meshgrid(np.arange(width), np.arange(height)), -1).reshape(-1, 1, 2).astype(np.float64)
        rays = cv2.undistortPoints(grid, depth, depth_distortion).reshape(-1, 2)
        self.rays = np.concatenate([rays, np.ones((len(rays), 1))], 1) @ self.rotation.T

    @staticmethod
    def intrinsics(camera):
        fx, fy, cx, cy = camera["params"][:4]
        return np.array([[fx, 0, cx - 0.5], [0, fy, cy - 0.5], [0, 0, 1]]), np.array(camera["params"][4:], np.float64)

    def normalized(self, pixels):
        """Undistorted image coordinates at unit depth."""
        points = np.ascontiguousarray(pixels, np.float64).reshape(-1, 1, 2)
        return cv2.undistortPoints(points, self.color, self.color_distortion).reshape(-1, 2)

    def registered(self, depth):
        """Depth image in the undistorted colour camera: the nearest of what falls on a pixel; 0: nothing does."""
        z = depth.reshape(-1).astype(np.float64) * self.unit_m
        seen = (z > self.nearest_m) & (z < self.farthest_m)
        points = self.rays[seen] * z[seen, None] + self.translation
        points = points[np.argsort(-points[:, 2])]  # the nearest is written last
        x, y = self.pixels(points).T
        width, height = self.size
        image = np.zeros((height, width))
        inside = (x >= 0) & (x < width) & (y >= 0) & (y < height) & (points[:, 2] > 0)
        image[y[inside], x[inside]] = points[inside, 2]
        return image

    def pixels(self, points):
        plane = points[:, :2] / np.maximum(points[:, 2:], 1e-9)
        around = np.clip(plane * np.diag(self.color)[:2] + self.color[:2, 2], -1e6, 1e6)
        return np.rint(around).astype(np.int64)

    def lift(self, registered, pixels):
        """Points in the camera at colour pixels, and which of them have a depth that can be trusted."""
        registered = np.pad(registered, 1)
        plane = self.normalized(pixels)
        x, y = self.pixels(np.concatenate([plane, np.ones((len(plane), 1))], 1)).T
        width, height = self.size
        inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
        x, y = np.where(inside, x, 0), np.where(inside, y, 0)
        around = np.stack([registered[y + dy, x + dx] for dy in range(3) for dx in range(3)], 1)
        around[around == 0] = np.nan
        there = inside & (np.count_nonzero(~np.isnan(around), 1) >= 3)
        around[~there] = 1
        z = np.nanmedian(around, 1)
        there &= np.nanmax(around, 1) - np.nanmin(around, 1) < DEPTH_EDGE * z
        return np.concatenate([plane * z[:, None], z[:, None]], 1), there


# ---- point maps


def mirrored(descriptors):
    """SIFT descriptors of the mirror image of their patches."""
    return descriptors.reshape(-1, 4, 4, 8)[:, ::-1, :, (8 - np.arange(8)) % 8].reshape(-1, 128)


def negative(descriptors):
    """SIFT descriptors of the negative of their patches."""
    return descriptors.reshape(-1, 4, 4, 8)[:, ::-1, ::-1, :].reshape(-1, 128)


def foreign_sift(descriptors, count, random):
    """Mirrored, negative, both; once these are used up, noisy copies of them."""
    turned = mirrored(descriptors)
    pool = np.concatenate([turned, negative(descriptors), negative(turned)])
    pool = pool[random.permutation(len(pool))]
    foreign = [pool[:count]]
    while sum(map(len, foreign)) < count:
        copies = pool[: count - sum(map(len, foreign))]
        noisy = np.maximum(copies * (1 + 0.45 * random.standard_normal(copies.shape)), 0)
        noisy *= 512 / np.linalg.norm(noisy, axis=1, keepdims=True)
        foreign.append(np.minimum(np.rint(noisy), 255).astype(np.float32))
    return np.concatenate(foreign)


def foreign_orb(descriptors, count, random):
    """Copies with a quarter of their bits turned."""
    copies = descriptors[random.integers(0, len(descriptors), count)]
    return copies ^ np.packbits(random.random((count, 8 * copies.shape[1]), np.float32) < 0.25, axis=1)


def opencv_detector(create):
    def make(count):
        detector = create(count)

        def describe(image):
            keypoints, descriptors = detector.detectAndCompute(image, None)
            return np.array([k.pt for k in keypoints]).reshape(-1, 2), descriptors

        return describe

    return make


def colmap_detector(count):
    options = pycolmap.FeatureExtractionOptions()
    options.use_gpu, options.num_threads, options.sift.max_num_features = False, 1, count
    sift = pycolmap.Sift(options, pycolmap.Device.cpu)

    def describe(image):
        keypoints, descriptors = sift.extract(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY))
        return keypoints[:, :2].astype(np.float64) - 0.5, 512 * descriptors

    return describe


DETECTORS = {
    "sift": opencv_detector(lambda count: cv2.SIFT_create(count)),
    "orb": opencv_detector(lambda count: cv2.ORB_create(count)),
    "colmap": colmap_detector,
}


class Features:
    """A detector, and the map of points that it described."""

    def __init__(self, name, keypoints, mapping_keypoints):
        self.binary = name == "orb"
        self.query, self.mapping = DETECTORS[name](keypoints), DETECTORS[name](mapping_keypoints)
        self.points = np.zeros((0, 3))
        self.descriptors = np.zeros((0, 32 if self.binary else 128), np.uint8 if self.binary else np.float32)
        self.seen = np.zeros(0, np.int64)
        self.indexes = {}

    def describe(self, detector, image):
        pixels, descriptors = detector(image)
        return pixels, self.descriptors[:0] if descriptors is None else descriptors

    def distances(self, a, b):
        if self.binary:
            return np.unpackbits(a ^ b, axis=1).sum(1)
        return np.linalg.norm(a - b, axis=1)

    def add(self, cameras, image, registered, rotation, translation):
        """A mapping frame: its keypoints with depth join the points they fall on and resemble, or are new points."""
        pixels, descriptors = self.describe(self.mapping, image)
        if not len(pixels):
            return
        lifted, there = cameras.lift(registered, pixels)
        lifted, descriptors, joined = lifted[there], descriptors[there], np.zeros(there.sum(), bool)
        for keypoint, point in self.pairs(cameras, lifted, descriptors, (self.points - translation) @ rotation):
            if not joined[keypoint]:
                joined[keypoint] = True
                self.seen[point] += 1
        world = lifted @ rotation.T + translation
        self.points = np.concatenate([self.points, world[~joined]])
        self.descriptors = np.concatenate([self.descriptors, descriptors[~joined]])
        self.seen = np.concatenate([self.seen, np.ones((~joined).sum(), np.int64)])

    def pairs(self, cameras, lifted, descriptors, points):
        """Keypoints with points that they fall on and resemble, the most alike first."""
        focal = cameras.color[0, 0]
        plane = points[:, :2] / np.maximum(points[:, 2:], 1e-9)
        near = np.nonzero((points[:, 2] > 0.1) & (np.abs(plane) < 2).all(1))[0]
        if not len(near):
            return []
        # Candidates by a window across, in order of x.
        near = near[np.argsort(plane[near, 0])]
        own, places, reach = lifted[:, :2] / lifted[:, 2:], plane[near], MERGE_PX / focal
        first = np.searchsorted(places[:, 0], own[:, 0] - reach)
        counts = np.searchsorted(places[:, 0], own[:, 0] + reach) - first
        keypoint = np.repeat(np.arange(len(own)), counts)
        column = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts) + np.repeat(first, counts)
        close = ((own[keypoint] - places[column]) ** 2).sum(1) < reach**2
        keypoint, point = keypoint[close], near[column[close]]
        fits = np.abs(points[point, 2] / lifted[keypoint, 2] - 1) < MERGE_DEPTH
        keypoint, point = keypoint[fits], point[fits]
        apart = self.distances(descriptors[keypoint], self.descriptors[point])
        alike = np.nonzero(apart < (MERGE_ORB if self.binary else MERGE_SIFT))[0]
        alike = alike[np.argsort(apart[alike])]
        return zip(keypoint[alike], point[alike])

    def resize(self, count):
        """Exactly so many points: those seen most often, then foreign ones that lie about where own ones do."""
        self.indexes = {}
        best = np.argsort(-self.seen, kind="stable")[:count]
        points, descriptors = self.points[best], self.descriptors[best]
        missing, random = count - len(best), np.random.default_rng(1)
        foreign = (foreign_orb if self.binary else foreign_sift)(descriptors, missing, random)
        places = points[random.integers(0, len(points), missing)]
        self.map_points = np.concatenate([points, places + 0.1 * random.standard_normal(places.shape)])
        self.map_descriptors = np.concatenate([descriptors, foreign])


# ---- nearest two


def cells_for(count):
    """512 at 50 000 points: a power of two above 2 sqrt(n)."""
    return 1 << int(np.ceil(np.log2(2 * np.sqrt(count))))


def faiss_ivf(probes):
    def build(descriptors):
        cells = cells_for(len(descriptors))
        index = faiss.IndexIVFFlat(faiss.IndexFlatL2(128), 128, cells)
        index.cp.max_points_per_centroid = 48
        index.train(descriptors)
        index.add(descriptors)
        return index

    def search(index, queries):
        index.nprobe = probes
        squared, at = index.search(queries, 2)
        return np.sqrt(squared), at

    return build, search


def faiss_flat():
    def build(descriptors):
        index = faiss.IndexFlatL2(128)
        index.add(descriptors)
        return index

    def search(index, queries):
        squared, at = index.search(queries, 2)
        return np.sqrt(squared), at

    return build, search


def hnsw():
    def build(descriptors):
        index = hnswlib.Index("l2", 128)
        index.init_index(len(descriptors), M=16, ef_construction=100, random_seed=1)
        index.set_num_threads(1)
        index.add_items(descriptors, num_threads=1)
        index.set_ef(32)
        return index

    def search(index, queries):
        at, squared = index.knn_query(queries, 2, num_threads=1)
        return np.sqrt(squared), at

    return build, search


def pairs_of(matches):
    pairs = [m for m in matches if len(m) == 2]
    apart = np.full((len(matches), 2), np.inf)
    at = np.full((len(matches), 2), -1, np.int64)
    for m in pairs:
        apart[m[0].queryIdx] = m[0].distance, m[1].distance
        at[m[0].queryIdx] = m[0].trainIdx, m[1].trainIdx
    return apart, at


def opencv(make):
    def build(descriptors):
        matcher = make()
        matcher.add([descriptors])
        matcher.train()
        return matcher

    return build, lambda matcher, queries: pairs_of(matcher.knnMatch(queries, k=2))


def flann():
    return cv2.FlannBasedMatcher({"algorithm": 1, "trees": 4}, {"checks": 128})


class Variant:
    def __init__(self, name, features, match, index, packages=()):
        self.name, self.features, self.match, self.index = name, features, match, index
        needed = (("numpy", np), ("opencv-python-headless", cv2)) + packages
        missing = [package for package, module in needed if module is None]
        self.absent = "this Python lacks it: pip install " + " ".join(missing) if missing else ""


def variants():
    with_faiss = (("faiss-cpu", faiss),)
    return [
        Variant("opencv sift, faiss ivf 16", "sift", faiss_ivf(16), "ivf", with_faiss),
        Variant("opencv sift, faiss ivf 8", "sift", faiss_ivf(8), "ivf", with_faiss),
        Variant("opencv sift, faiss flat", "sift", faiss_flat(), "flat", with_faiss),
        Variant("opencv sift, hnswlib", "sift", hnsw(), "hnsw", (("hnswlib", hnswlib),)),
        Variant("opencv sift, opencv flann", "sift", opencv(flann), "flann"),
        Variant("opencv sift, opencv bf", "sift", opencv(lambda: cv2.BFMatcher(cv2.NORM_L2)), "bf"),
        Variant("opencv orb, opencv bf", "orb", opencv(lambda: cv2.BFMatcher(cv2.NORM_HAMMING)), "bf"),
        Variant("pycolmap sift, faiss ivf 16", "colmap", faiss_ivf(16), "ivf", with_faiss + (("pycolmap", pycolmap),)),
    ]


# ---- a frame


def find_pose(cameras, points, pixels):
    """camera_from_world by RANSAC, then the least squares of its inliers; None when there is none."""
    if len(points) < PNP_FEWEST:
        return None
    found, r, t, inliers = cv2.solvePnPRansac(
        points, pixels, cameras.color, cameras.color_distortion, flags=cv2.SOLVEPNP_AP3P, reprojectionError=PNP_PX,
        confidence=PNP_CONFIDENCE, iterationsCount=PNP_ITERATIONS)
    if not found or inliers is None or len(inliers) < PNP_FEWEST:
        return None
    best = inliers.ravel()
    r, t = cv2.solvePnPRefineLM(points[best], pixels[best], cameras.color, cameras.color_distortion, r, t)
    return cv2.Rodrigues(r)[0], t.ravel(), len(best)


class Peers:
    def __init__(self):
        self.variants = variants()
        self.features, self.last = {}, {}

    def greet(self, _, __):
        versions = {m.__name__: m.__version__ for m in (np, cv2, faiss, hnswlib, pycolmap) if hasattr(m, "__version__")}
        return {"peer": "SPHC", "versions": versions, "variants": [{"name": v.name, "absent": v.absent} for v in self.variants]}

    def begin(self, message, _):
        """Cameras, and which variants will be asked for."""
        cv2.setNumThreads(1)
        if faiss:
            faiss.omp_set_num_threads(1)
        self.cameras = Cameras(message)
        for i in message["variants"]:
            name = self.variants[i].features
            if name not in self.features:
                self.features[name] = Features(name, message["keypoints"], message["mapping_keypoints"])
        return {}

    def images(self, message, payload):
        width, height = self.cameras.size
        color = np.frombuffer(payload, np.uint8, 3 * width * height).reshape(height, width, 3)
        depth = np.frombuffer(payload, np.uint16, offset=3 * width * height)
        return color, depth

    def map(self, message, payload):
        color, depth = self.images(message, payload)
        rotation, registered = np.array(message["rotation"]).reshape(3, 3), self.cameras.registered(depth)
        for features in self.features.values():
            features.add(self.cameras, color, registered, rotation, np.array(message["translation_m"]))
        return {}

    def index(self, message, _):
        """A map of so many points, for the variants that were named at the beginning."""
        for features in self.features.values():
            features.resize(message["points"])
        self.last = {}
        for i in message["variants"]:
            v = self.variants[i]
            features = self.features[v.features]
            if v.index not in features.indexes:
                features.indexes[v.index] = v.match[0](features.map_descriptors)
        return {"own": {name: min(len(f.points), message["points"]) for name, f in self.features.items()}}

    def described(self, name, frame, color):
        """Keypoints, and the seconds they took; once a frame for all variants with this detector."""
        if self.last.get(name, (None,))[0] != frame:
            begin = cpu_seconds()
            found = self.features[name].describe(self.features[name].query, color)
            self.last[name] = frame, found, cpu_seconds() - begin
        return self.last[name][1:]

    def query(self, message, payload):
        variant = self.variants[message["variant"]]
        features = self.features[variant.features]
        color, _ = self.images(message, payload)
        cv2.setRNGSeed(message["seed"])
        (pixels, descriptors), features_s = self.described(variant.features, message["frame"], color)
        begin = cpu_seconds()
        apart, at = variant.match[1](features.indexes[variant.index], descriptors) if len(descriptors) > 1 else pairs_of([])
        good = np.nonzero((at[:, 1] >= 0) & (apart[:, 0] < RATIO * apart[:, 1]))[0]
        points = features.map_points[at[good, 0]]
        matched = cpu_seconds()
        pose = find_pose(self.cameras, points, pixels[good])
        done = cpu_seconds()
        answer = {"features_s": features_s, "match_s": matched - begin, "pose_s": done - matched,
                  "keypoints": len(pixels), "matches": len(good), "found": pose is not None}
        if pose:
            answer.update(rotation=pose[0].ravel().tolist(), translation_m=pose[1].tolist(), inliers=pose[2])
        return answer


# ---- the other end


def read(stream, size):
    data = stream.read(size)
    if len(data) < size:
        sys.exit(0)
    return data


def send(outgoing, message):
    text = json.dumps(message).encode()
    data = struct.pack("=I", len(text)) + text
    while data:
        data = data[os.write(outgoing, data):]


def main():
    incoming, outgoing = os.fdopen(0, "rb"), os.dup(1)
    os.dup2(2, 1)  # whatever a library prints stays out of the way
    peers = Peers()
    while True:
        message = json.loads(read(incoming, struct.unpack("=I", read(incoming, 4))[0]))
        payload = read(incoming, message.get("payload", 0))
        try:
            answer = getattr(peers, message["do"])(message, payload)
        except Exception as error:  # told, not died of: the other end says it with cause
            answer = {"error": "%s: %s" % (type(error).__name__, error)}
        send(outgoing, answer)


main()
