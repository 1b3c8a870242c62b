#!/usr/bin/env python3
"""Reads a ROS 2 recording that another writer made (mcap_ros2: chunks of zstd with checksums, full messages).

    check_ros2.py SPHERECLOUD     converts such a recording with the command and compares what came out of it

Fails, rather than skips, where the packages are missing: toolchains/install_python_packages.sh brings them.
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory
    from mcap_ros2.writer import Writer
except ImportError as error:
    sys.exit("%s\nrun toolchains/install_python_packages.sh" % error)

FRAMES, START_NS, STEP_NS = 4, 1700000000123456789, 33333333
SIDE = 16
LINE = "=" * 80 + "\n"
HEADER = (LINE + "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
          LINE + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n")
POINTS = (LINE + "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" +
          LINE + "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n" +
          LINE + "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n")
TYPES = {
    "sensor_msgs/msg/Image":
        "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
        "uint8[] data\n" + HEADER,
    "sensor_msgs/msg/CameraInfo":
        "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\n"
        "float64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\nsensor_msgs/RegionOfInterest roi\n" + HEADER +
        LINE + "MSG: sensor_msgs/RegionOfInterest\nuint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\n"
        "bool do_rectify\n",
    "tf2_msgs/msg/TFMessage":
        "geometry_msgs/TransformStamped[] transforms\n" +
        LINE + "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\n"
        "geometry_msgs/Transform transform\n" +
        LINE + "MSG: geometry_msgs/Transform\ngeometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n" +
        HEADER + POINTS,
    "nav_msgs/msg/Odometry":
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
        "geometry_msgs/TwistWithCovariance twist\n" +
        LINE + "MSG: geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance\n" +
        LINE + "MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n" +
        LINE + "MSG: geometry_msgs/TwistWithCovariance\ngeometry_msgs/Twist twist\nfloat64[36] covariance\n" +
        LINE + "MSG: geometry_msgs/Twist\ngeometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" +
        HEADER + POINTS,
}


def header(time_ns, frame):
    return {"stamp": {"sec": time_ns // 10**9, "nanosec": time_ns % 10**9}, "frame_id": frame}


def image(time_ns, frame, encoding, data):
    return {"header": header(time_ns, frame), "height": SIDE, "width": SIDE, "encoding": encoding, "is_bigendian": 0,
            "step": len(data) // SIDE, "data": data}


def info(frame, focal):
    return {"header": header(START_NS, frame), "height": SIDE, "width": SIDE, "distortion_model": "plumb_bob",
            "d": [0.1, 0.0, 0.0, 0.0, 0.0], "k": [focal, 0.0, 7.5, 0.0, focal, 7.5, 0.0, 0.0, 1.0], "r": [0.0] * 9,
            "p": [0.0] * 12, "binning_x": 0, "binning_y": 0,
            "roi": {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}}


def vector(x=0.0, y=0.0, z=0.0):
    return {"x": x, "y": y, "z": z}


def quaternion():
    return {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}


def depth_data(i):
    return struct.pack("<%dH" % SIDE**2, *(500 * i + p for p in range(SIDE**2)))


def write_bag(path):
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=2000)
        schemas = {name: writer.register_msgdef(name, text) for name, text in TYPES.items()}

        def put(topic, kind, message, time_ns):
            writer.write_message(topic, schemas[kind], message, log_time=time_ns + 7000000)

        put("/tf_static", "tf2_msgs/msg/TFMessage", {"transforms": [
            {"header": header(0, "base"), "child_frame_id": frame,
             "transform": {"translation": vector(x), "rotation": quaternion()}}
            for frame, x in (("color", 0.0), ("depth", 0.25))]}, START_NS)
        put("/rgb/camera_info", "sensor_msgs/msg/CameraInfo", info("color", 20.0), START_NS)
        put("/depth/camera_info", "sensor_msgs/msg/CameraInfo", info("depth", 10.0), START_NS)
        for i in range(FRAMES):
            time_ns = START_NS + i * STEP_NS
            put("/rgb/image", "sensor_msgs/msg/Image", image(time_ns, "color", "bgr8", bytes([i] * 3 * SIDE**2)), time_ns)
            put("/depth/image", "sensor_msgs/msg/Image", image(time_ns, "depth", "16UC1", depth_data(i)), time_ns)
            put("/odom", "nav_msgs/msg/Odometry", {
                "header": header(time_ns, "odom"), "child_frame_id": "base",
                "pose": {"pose": {"position": vector(1.0, 2.0 * i), "orientation": quaternion()},
                         "covariance": [0.0] * 36},
                "twist": {"twist": {"linear": vector(), "angular": vector()}, "covariance": [0.0] * 36}}, time_ns)
        writer.finish()


def check_converted(path):
    with path.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        found = {}
        for _, channel, record, message in reader.iter_decoded_messages():
            i, rest = divmod(record.log_time - START_NS, STEP_NS)
            assert rest == 0, "times are those of the headers"
            found.setdefault(channel.topic, []).append(i)
            if channel.topic == "/color/image":
                assert bytes(message.data) == bytes([i] * 3 * SIDE**2)
            elif channel.topic == "/depth/image":
                assert bytes(message.data) == depth_data(i)
            elif channel.topic == "/pose":
                assert (message.pose.position.x, message.pose.position.y) == (1, 2 * i)
        for topic in ("/color/image", "/depth/image", "/pose"):
            assert found[topic] == list(range(FRAMES)), (topic, found)
        calibration = json.loads(next(iter(reader.iter_attachments())).data)
        assert calibration["color_camera"]["params"][:4] == [20, 20, 8, 8]
        assert calibration["color_from_depth"]["t_m"] == [0.25, 0, 0]


def main():
    with tempfile.TemporaryDirectory() as folder:
        bag, converted = pathlib.Path(folder, "bag.mcap"), pathlib.Path(folder, "converted.mcap")
        write_bag(bag)
        told = subprocess.run([sys.argv[1], "convert", str(bag), str(converted), "--depth-codec", "raw", "--json"],
                              check=True, stdout=subprocess.PIPE).stdout
        counts = json.loads(told)
        assert (counts["color"], counts["depth"], counts["poses"]) == (FRAMES,) * 3, counts
        check_converted(converted)
    print("a recording of %d frames by mcap_ros2 came through" % FRAMES)


if __name__ == "__main__":
    main()
