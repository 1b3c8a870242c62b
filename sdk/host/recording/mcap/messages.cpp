#include "messages.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>

#include "cdr.h"
#include "records.h"

namespace sphc::recording {

namespace {

constexpr int64_t kNsPerSecond = 1000000000;

enum SchemaId : uint16_t { kImage = 1, kCompressedImage, kCapture, kPoseStamped, kDrop, kImu };

struct SchemaText {
  SchemaId id;
  const char *name;
  const char *text;   // without the types it uses
  const char *types;  // beside those of a header; null: it has no header
};

constexpr const char *kHeaderTypes =
    "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "=\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
constexpr const char *kPoseTypes =
    "=\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
    "=\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "=\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";
constexpr const char *kImuTypes =
    "=\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
    "=\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";

constexpr SchemaText kSchemas[] = {
    {kImage, "sensor_msgs/msg/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
     "uint8[] data\n",
     ""},
    {kCompressedImage, "sensor_msgs/msg/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n",
     ""},
    {kCapture, "spherecloud_msgs/msg/Capture",
     "# What is known of the image that follows on the stream's image topic.\n"
     "int64 time_ns\n"
     "int64 arrival_ns      # when the host had it, by its CLOCK_MONOTONIC; 0: not told\n"
     "uint32 sequence\n"
     "uint32 exposure_us    # 0: not told\n"
     "uint32 time_sigma_us  # of time_ns as the middle of the exposure\n"
     "int32 clock           # of time_ns: 0 the source's own, 1 the host's CLOCK_MONOTONIC, 2 CLOCK_BOOTTIME\n"
     "int32 time_point      # what time_ns is of the exposure: 0 middle, 1 start, 2 end, 3 arrival\n",
     nullptr},
    {kPoseStamped, "geometry_msgs/msg/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
     kPoseTypes},
    {kDrop, "spherecloud_msgs/msg/Drop",
     "# Captures that are not in the file.\n"
     "int64 time_ns         # of the first, or of the next that came where that is not known\n"
     "uint32 first_sequence\n"
     "uint32 count\n"
     "int32 stream          # 1 colour, 2 depth, 0 poses and accelerations\n"
     "int32 cause           # 1 the recorder's queue was full, 2 lost before the recorder\n",
     nullptr},
    {kImu, "sensor_msgs/msg/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
     "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
     "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n",
     kImuTypes},
};

struct ChannelText {
  Kind kind;
  const char *topic;
  SchemaId schema;
  sphc_stream stream;
  const char *format;  // of compressed images
};

constexpr ChannelText kChannels[] = {
    {Kind::kColorImage, "/color/image", kImage, SPHC_STREAM_COLOR, ""},
    {Kind::kColorJpeg, "/color/image/compressed", kCompressedImage, SPHC_STREAM_COLOR, "jpeg"},
    {Kind::kDepthImage, "/depth/image", kImage, SPHC_STREAM_DEPTH, ""},
    {Kind::kDepthRvl, "/depth/image/compressedDepth", kCompressedImage, SPHC_STREAM_DEPTH,
     "16UC1; compressedDepth rvl"},
    {Kind::kDepthZstd, "/depth/image/spherecloud", kCompressedImage, SPHC_STREAM_DEPTH, "16UC1; spherecloud zstd"},
    {Kind::kColorCapture, "/color/capture", kCapture, SPHC_STREAM_COLOR, ""},
    {Kind::kDepthCapture, "/depth/capture", kCapture, SPHC_STREAM_DEPTH, ""},
    {Kind::kPose, "/pose", kPoseStamped, SPHC_STREAM_NONE, ""},
    {Kind::kDrops, "/drops", kDrop, SPHC_STREAM_NONE, ""},
    {Kind::kAmplitudeImage, "/depth/amplitude", kImage, SPHC_STREAM_DEPTH, ""},
    {Kind::kAmplitudeZstd, "/depth/amplitude/spherecloud", kCompressedImage, SPHC_STREAM_DEPTH,
     "mono16; spherecloud zstd"},
    {Kind::kAcceleration, "/color/acceleration", kImu, SPHC_STREAM_NONE, ""},
};

const ChannelText &channelOf(Kind kind) {
  return *std::find_if(std::begin(kChannels), std::end(kChannels),
                       [kind](const ChannelText &channel) { return channel.kind == kind; });
}

// ROS 2 puts 80 '=' between the definitions.
std::string schemaText(const SchemaText &schema) {
  const std::string types = schema.types ? std::string("=\n") + kHeaderTypes + schema.types : "";
  std::string text = schema.text;
  for (const char c : types) text += c == '=' ? std::string(80, '=') : std::string(1, c);
  return text;
}

// The seconds of ROS end in 2038; log_time has the whole time.
void putStamp(CdrWriter &message, int64_t time_ns, std::string_view frame) {
  message.put(static_cast<uint32_t>(time_ns / kNsPerSecond));
  message.put(static_cast<uint32_t>(time_ns % kNsPerSecond));
  message.putText(frame);
}

void skipStamp(CdrReader &message) {
  message.take<uint32_t>();
  message.take<uint32_t>();
  message.takeText();
}

constexpr std::pair<sphc_format, std::string_view> kEncodings[] = {{SPHC_FORMAT_GRAY8, "mono8"},
                                                                   {SPHC_FORMAT_RGB8, "rgb8"},
                                                                   {SPHC_FORMAT_BGR8, "bgr8"},
                                                                   {SPHC_FORMAT_DEPTH16, "16UC1"},
                                                                   {SPHC_FORMAT_GRAY16, "mono16"}};

const char *frameOf(sphc_format format) {
  return format == SPHC_FORMAT_DEPTH16 || format == SPHC_FORMAT_GRAY16 ? "depth_camera" : "color_camera";
}

}  // namespace

Kind kindOf(std::string_view topic, std::string_view schema) {
  for (const ChannelText &channel : kChannels)
    if (topic == channel.topic && schema == kSchemas[channel.schema - 1].name) return channel.kind;
  return Kind::kNone;
}

bool isImage(Kind kind) { return kind >= Kind::kColorImage && kind <= Kind::kDepthZstd; }

bool isAmplitude(Kind kind) { return kind == Kind::kAmplitudeImage || kind == Kind::kAmplitudeZstd; }

sphc_stream streamOf(Kind kind) { return channelOf(kind).stream; }

void putSchemasAndChannels(Bytes &out, const std::vector<Kind> &kinds) {
  for (const SchemaText &schema : kSchemas) putSchema(out, schema.id, schema.name, "ros2msg", schemaText(schema));
  for (const Kind kind : kinds)
    putChannel(out, static_cast<uint16_t>(kind), channelOf(kind).schema, channelOf(kind).topic, "cdr",
               {{"offered_qos_profiles", ""}});
}

void putImageMessage(Bytes &out, int64_t time_ns, const sphc_image &image) {
  const uint32_t pixel_bytes = sphc_format_bytes(image.format);
  const uint32_t row_bytes = image.width * pixel_bytes;
  CdrWriter message(out);
  putStamp(message, time_ns, frameOf(image.format));
  message.put(image.height);
  message.put(image.width);
  message.putText(encodingOf(image.format));
  message.put(uint8_t{0});
  message.put(row_bytes);
  message.putLength(size_t{row_bytes} * image.height);
  for (uint32_t y = 0; y < image.height; ++y)
    append(out, static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes, row_bytes);
}

void putCompressedMessage(Bytes &out, int64_t time_ns, Kind kind, ByteView data) {
  CdrWriter message(out);
  putStamp(message, time_ns, streamOf(kind) == SPHC_STREAM_DEPTH ? "depth_camera" : "color_camera");
  message.putText(channelOf(kind).format);
  message.putLength(data.size);
  append(out, data.data, data.size);
}

void putCaptureNote(Bytes &out, const CaptureNote &note) {
  CdrWriter message(out);
  message.put(note.time_ns);
  message.put(note.arrival_ns);
  message.put(note.sequence);
  message.put(note.exposure_us);
  message.put(note.time_sigma_us);
  message.put(note.clock);
  message.put(note.time_point);
}

void putPoseMessage(Bytes &out, int64_t time_ns, const sphc_rigid &world_from_camera) {
  CdrWriter message(out);
  putStamp(message, time_ns, "world");
  for (const double x : world_from_camera.t_m) message.put(x);
  for (const int i : {1, 2, 3, 0}) message.put(world_from_camera.q_wxyz[i]);
}

void putDrop(Bytes &out, const Drop &drop) {
  CdrWriter message(out);
  message.put(drop.time_ns);
  message.put(drop.first_sequence);
  message.put(drop.count);
  message.put(drop.stream);
  message.put(static_cast<int32_t>(drop.cause));
}

// Of ROS's message the acceleration alone is known: a first covariance of -1 says so of the others.
void putAcceleration(Bytes &out, const TimedAcceleration &acceleration) {
  CdrWriter message(out);
  putStamp(message, acceleration.time_ns, "color_camera");
  const auto put = [&message](std::initializer_list<double> numbers) {
    for (const double number : numbers) message.put(number);
  };
  const double *felt = acceleration.felt_mps2;
  put({0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 0, 0});
  put({0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0});
  put({felt[0], felt[1], felt[2], 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

bool readImageMessage(ByteView message, ImageMessage &image) {
  CdrReader reader(message);
  skipStamp(reader);
  image.height = reader.take<uint32_t>();
  image.width = reader.take<uint32_t>();
  image.encoding = reader.takeText();
  const bool big_endian = reader.take<uint8_t>() != 0;
  image.step = reader.take<uint32_t>();
  image.data = reader.takeBytes();
  return reader.ok() && !big_endian;
}

bool readCompressedMessage(ByteView message, CompressedMessage &image) {
  CdrReader reader(message);
  skipStamp(reader);
  image.format = reader.takeText();
  image.data = reader.takeBytes();
  return reader.ok();
}

bool readCaptureNote(ByteView message, CaptureNote &note) {
  CdrReader reader(message);
  note.time_ns = reader.takeInt64();
  note.arrival_ns = reader.takeInt64();
  note.sequence = reader.take<uint32_t>();
  note.exposure_us = reader.take<uint32_t>();
  note.time_sigma_us = reader.take<uint32_t>();
  note.clock = reader.takeInt32();
  note.time_point = reader.takeInt32();
  return reader.ok() && note.clock >= SPHC_CLOCK_SOURCE && note.clock <= SPHC_CLOCK_BOOTTIME &&
         note.time_point >= SPHC_TIME_MIDDLE && note.time_point <= SPHC_TIME_ARRIVAL;
}

bool readPoseMessage(ByteView message, sphc_rigid &world_from_camera) {
  CdrReader reader(message);
  skipStamp(reader);
  for (double &x : world_from_camera.t_m) x = reader.takeDouble();
  for (const int i : {1, 2, 3, 0}) world_from_camera.q_wxyz[i] = reader.takeDouble();
  return reader.ok();
}

bool readDrop(ByteView message, Drop &drop) {
  CdrReader reader(message);
  drop.time_ns = reader.takeInt64();
  drop.first_sequence = reader.take<uint32_t>();
  drop.count = reader.take<uint32_t>();
  drop.stream = reader.takeInt32();
  drop.cause = static_cast<DropCause>(reader.takeInt32());
  return reader.ok();
}

std::string_view encodingOf(sphc_format format) {
  for (const auto &[known, encoding] : kEncodings)
    if (known == format) return encoding;
  return {};
}

sphc_format formatOf(std::string_view encoding) {
  for (const auto &[format, known] : kEncodings)
    if (known == encoding) return format;
  return 0;
}

void putRvlHead(uint8_t *out, uint32_t width, uint32_t height) {
  std::memset(out, 0, 12);
  storeLittle(out + 12, width);
  storeLittle(out + 16, height);
}

void putZstdHead(uint8_t *out, uint32_t width, uint32_t height) {
  storeLittle(out, width);
  storeLittle(out + 4, height);
}

}  // namespace sphc::recording
