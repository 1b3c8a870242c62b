// The messages of a recording: ROS 2's own where there are some, so that other tools show them (docs/recording.md).
#pragma once

#include <spherecloud/spherecloud_capture.h>

#include "bytes.h"

namespace sphc::recording {

// A channel's number in a file that we write is that of its kind.
enum class Kind : uint16_t {
  kNone,
  kColorImage,
  kColorJpeg,
  kDepthImage,
  kDepthRvl,
  kDepthZstd,
  kColorCapture,
  kDepthCapture,
  kPose,
  kDrops,
  kAmplitudeImage,
  kAmplitudeZstd,
  kAcceleration,
  kLast = kAcceleration
};

// kNone for a topic or schema that is none of ours.
Kind kindOf(std::string_view topic, std::string_view schema);
bool isImage(Kind kind);      // of colour or depth
bool isAmplitude(Kind kind);  // of the depth image that follows
sphc_stream streamOf(Kind kind);

// The schemas, then these channels.
void putSchemasAndChannels(Bytes &out, const std::vector<Kind> &kinds);

// What is known of a capture beside its image.
struct CaptureNote {
  int64_t time_ns, arrival_ns;
  uint32_t sequence, exposure_us, time_sigma_us;
  sphc_clock_id clock;
  sphc_time_point time_point;
};

enum class DropCause : int32_t {
  kQueueFull = 1,  // the recorder's
  kBefore = 2      // a gap in the stream's sequence: lost before it came to the recorder
};
struct Drop {
  sphc_stream stream;
  uint32_t first_sequence, count;
  int64_t time_ns;  // of the first; of the next one that came where that is not known
  DropCause cause;
};

// What an accelerometer felt, in the axes of the colour camera: at rest 9.81 m/s^2 upwards.
struct TimedAcceleration {
  int64_t time_ns;
  double felt_mps2[3];
};

// Views of what a message holds.
struct ImageMessage {
  uint32_t width, height, step;
  std::string_view encoding;
  ByteView data;
};
struct CompressedMessage {
  std::string_view format;
  ByteView data;
};

// Each appends one message.  Images are packed: rows without padding.
void putImageMessage(Bytes &out, int64_t time_ns, const sphc_image &image);
void putCompressedMessage(Bytes &out, int64_t time_ns, Kind kind, ByteView data);
void putCaptureNote(Bytes &out, const CaptureNote &note);
void putPoseMessage(Bytes &out, int64_t time_ns, const sphc_rigid &world_from_camera);
void putDrop(Bytes &out, const Drop &drop);
void putAcceleration(Bytes &out, const TimedAcceleration &acceleration);
// The most that such a message needs beside its pixels or compressed bytes.
constexpr size_t kMostMessageHeadBytes = 384;

// False when malformed.
bool readImageMessage(ByteView message, ImageMessage &image);
bool readCompressedMessage(ByteView message, CompressedMessage &image);
bool readCaptureNote(ByteView message, CaptureNote &note);
bool readPoseMessage(ByteView message, sphc_rigid &world_from_camera);
bool readDrop(ByteView message, Drop &drop);

// "bgr8" and so on, GRAY16 for amplitudes; empty, or 0, for what is none.
std::string_view encodingOf(sphc_format format);
sphc_format formatOf(std::string_view encoding);

// Bytes before the compressed ones in CompressedMessage::data.
constexpr size_t kRvlHeadBytes = 20;  // ROS: twelve of no meaning here, width, height
constexpr size_t kZstdHeadBytes = 8;  // width, height
void putRvlHead(uint8_t *out, uint32_t width, uint32_t height);
void putZstdHead(uint8_t *out, uint32_t width, uint32_t height);

}  // namespace sphc::recording
