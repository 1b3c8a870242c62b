#!/usr/bin/env python3
"""Reads recordings with other people's readers: the container with `mcap`, the messages with `mcap_ros2`.

    check_mcap.py WRITE_TINY_MCAP     runs this program, which writes recordings of known content, and checks them

The depth codecs are decoded by a second implementation, from docs/recording.md alone.  Fails, rather than skips, where
the packages are missing: toolchains/install_python_packages.sh brings them.
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    import zstandard
    from mcap.reader import NonSeekingReader, make_reader
    from mcap.stream_reader import StreamReader
    from mcap_ros2.decoder import DecoderFactory
except ImportError as error:
    sys.exit("%s\nrun toolchains/install_python_packages.sh" % error)

COLOR, DEPTH = (48, 32), (40, 24)
FIRST_NS, PERIOD_NS, LAG_NS = 1305031102175304123, 10000000, 1000003
FRAMES = [i for i in range(40) if not 10 <= i <= 12]


def color_bytes(i):
    return bytes((7 * i + 3 * x + 5 * y + 60 * c) % 256
                 for y in range(COLOR[1]) for x in range(COLOR[0]) for c in range(3))


def depth_pixels(i):
    return [(1000 * i + 30 * y + x) % 65536 for y in range(DEPTH[1]) for x in range(DEPTH[0])]


def amplitude_pixels(i):
    return [0 if x % 7 == 0 else (60000 + 300 * i + 17 * y * x) % 65536 for y in range(DEPTH[1]) for x in range(DEPTH[0])]


def unzigzag(code):
    return code >> 1 ^ -(code & 1)


def decode_rvl(data, count):
    words = struct.unpack("<%dI" % (len(data) // 4), data)
    nibbles = (word >> shift & 15 for word in words for shift in range(28, -4, -4))

    def number():
        value = shift = 0
        while True:
            nibble = next(nibbles)
            value |= (nibble & 7) << shift
            shift += 3
            if nibble < 8:
                return value

    pixels, last = [], 0
    while len(pixels) < count:
        pixels += [0] * number()
        for _ in range(number()):
            last += unzigzag(number())
            pixels.append(last)
    return pixels


def decode_zstd(data, count):
    planes = zstandard.ZstdDecompressor().decompress(data, max_output_size=2 * count)
    pixels, last = [], 0
    for code in (low | high << 8 for low, high in zip(planes[:count], planes[count:])):
        if code:
            negative = -last & 0xFFFF
            free = negative << 1 & 0xFFFF ^ (0xFFFF if negative & 0x8000 else 0)  # what a hole would have been
            last = last + unzigzag(code - (code <= free)) & 0xFFFF
        pixels.append(last if code else 0)
    return pixels


def depth_of(channel, message):
    count = DEPTH[0] * DEPTH[1]
    data = bytes(message.data)
    if channel.topic == "/depth/image":
        assert (message.encoding, message.step) == ("16UC1", 2 * DEPTH[0])
        return list(struct.unpack("<%dH" % count, data))
    if channel.topic == "/depth/image/compressedDepth":
        assert message.format == "16UC1; compressedDepth rvl"
        assert struct.unpack("<II", data[12:20]) == DEPTH
        return decode_rvl(data[20:], count)
    assert channel.topic == "/depth/image/spherecloud" and message.format == "16UC1; spherecloud zstd"
    assert struct.unpack("<II", data[:8]) == DEPTH
    return decode_zstd(data[8:], count)


def amplitude_of(channel, message):
    assert message.header.frame_id == "depth_camera"
    data = bytes(message.data)
    if channel.topic == "/depth/amplitude":
        assert (message.encoding, message.width, message.height, message.step) == ("mono16", *DEPTH, 2 * DEPTH[0])
        return list(struct.unpack("<%dH" % (DEPTH[0] * DEPTH[1]), data))
    assert channel.topic == "/depth/amplitude/spherecloud" and message.format == "mono16; spherecloud zstd"
    assert struct.unpack("<II", data[:8]) == DEPTH
    return decode_zstd(data[8:], DEPTH[0] * DEPTH[1])


def check_color(channel, message, i):
    if channel.topic == "/color/image/compressed":
        assert message.format == "jpeg" and bytes(message.data[:2]) == b"\xff\xd8"
        return
    assert (message.width, message.height, message.encoding, message.step) == (*COLOR, "bgr8", 3 * COLOR[0])
    assert bytes(message.data) == color_bytes(i), "colour %d" % i


def check_message(channel, record, message):
    """The number of the frame it belongs to."""
    i, rest = divmod(record.log_time - FIRST_NS, PERIOD_NS)
    assert rest == (LAG_NS if channel.topic.startswith("/depth") else 0) or channel.topic == "/drops"
    if channel.topic.endswith("/capture"):
        assert (message.time_ns, message.sequence, message.exposure_us) == (record.log_time, i, 8000 + i)
        assert message.arrival_ns == 123456789000 + i
        assert (message.clock, message.time_point) == (1, 1 if channel.topic.startswith("/color") else 3)
    elif channel.topic == "/pose":
        assert message.header.frame_id == "world" and message.header.stamp.sec == record.log_time // 10**9
        assert message.pose.position.y == 1 / 3 and message.pose.orientation.x == 0
    elif channel.topic == "/drops":
        assert (message.first_sequence, message.count, message.cause) == (10, 3, 2)
    elif channel.topic.startswith("/color"):
        check_color(channel, message, i)
    elif channel.topic.startswith("/depth/amplitude"):
        assert amplitude_of(channel, message) == amplitude_pixels(i), "amplitude %d" % i
    else:
        assert depth_of(channel, message) == depth_pixels(i), "depth %d" % i
    return i


def check_attachments(reader):
    attachments = list(reader.iter_attachments())
    assert [a.name for a in attachments] == ["calibration.json"]
    assert json.loads(attachments[0].data)["format"] == "spherecloud-calibration"
    metadata = {m.name: m.metadata for m in reader.iter_metadata()}
    assert metadata["spherecloud"]["version"] == "1"
    assert metadata["spherecloud_statistics"]["color_count"] == str(len(FRAMES))
    assert metadata["spherecloud_statistics"]["missing_count"] == "6"


def check(path):
    with path.open("rb") as stream:
        records = [type(record).__name__ for record in StreamReader(stream, validate_crcs=True).records]
        assert records[0] == "Header" and records[-1] == "Footer" and records.count("DataEnd") == 1
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        assert not isinstance(reader, NonSeekingReader), "the index is used"
        summary = reader.get_summary()
        assert reader.get_header().profile == "ros2"
        assert len(summary.chunk_indexes) == summary.statistics.chunk_count > 0
        found = {}
        for schema, channel, record, message in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(check_message(channel, record, message))
        counts = {summary.channels[c].topic: n for c, n in summary.statistics.channel_message_counts.items()}
        assert counts == {topic: len(numbers) for topic, numbers in found.items()}, counts
        for topic, numbers in found.items():
            assert numbers == ([13, 13] if topic == "/drops" else FRAMES), (topic, numbers)
        assert len(found) == 7
        check_attachments(reader)
    print("%s: %d messages in %d chunks" % (path.name, summary.statistics.message_count, len(summary.chunk_indexes)))


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        files = sorted(pathlib.Path(folder).glob("*.mcap"))
        assert len(files) == 4
        for file in files:
            check(file)


if __name__ == "__main__":
    main()
