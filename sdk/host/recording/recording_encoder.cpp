#include "recording_encoder.h"

#include <algorithm>
#include <string>

#include "calibration_json.h"
#include "failure.h"
#include "host/recording/mcap/depth_rvl.h"
#include "pixels.h"

namespace sphc::recording {

namespace {

size_t pixelsOf(const sphc_camera &camera) { return size_t{camera.width} * camera.height; }

size_t mostDepthBytes(const sphc_rig &calibration) {
  const size_t pixels = pixelsOf(calibration.depth_camera);
  return std::max(kRvlHeadBytes + rvlMostBytes(pixels), kZstdHeadBytes + DepthZstdEncoder::mostBytes(pixels));
}

size_t mostMessageBytes(const sphc_rig &calibration) {
  return kMostMessageHeadBytes + std::max(3 * pixelsOf(calibration.color_camera), mostDepthBytes(calibration));
}

}  // namespace

RecordingEncoder::RecordingEncoder(const std::filesystem::path &path, const sphc_rig &calibration,
                                   const sphc_recorder_config &config)
    : config_(config),
      writer_(path, config.chunk_bytes, mostMessageBytes(calibration)),
      zstd_(pixelsOf(calibration.depth_camera)),
      depth_(mostDepthBytes(calibration)) {
  Bytes head;
  putSchemasAndChannels(
      head, {kindOf(SPHC_STREAM_COLOR), kindOf(SPHC_STREAM_DEPTH), Kind::kColorCapture, Kind::kDepthCapture,
             Kind::kPose, Kind::kDrops, amplitudeKind(), Kind::kAcceleration});
  putMetadata(head, "spherecloud", {{"version", "1"}});
  const std::string json = calibrationToJson(calibration);
  putAttachment(head, "calibration.json", "application/json",
                {reinterpret_cast<const uint8_t *>(json.data()), json.size()});
  writer_.begin(head);
}

Kind RecordingEncoder::kindOf(sphc_stream stream) const {
  if (stream == SPHC_STREAM_COLOR) return config_.jpeg_quality ? Kind::kColorJpeg : Kind::kColorImage;
  if (config_.depth_codec == SPHC_DEPTH_RVL) return Kind::kDepthRvl;
  return config_.depth_codec == SPHC_DEPTH_ZSTD ? Kind::kDepthZstd : Kind::kDepthImage;
}

Kind RecordingEncoder::amplitudeKind() const {
  return config_.depth_codec == SPHC_DEPTH_ZSTD ? Kind::kAmplitudeZstd : Kind::kAmplitudeImage;
}

ByteView RecordingEncoder::encodeDepth(Kind kind, const sphc_image &image) {
  const auto *depth = static_cast<const uint16_t *>(image.data);
  const size_t count = size_t{image.width} * image.height;
  uint8_t *const out = depth_.data();
  if (kind == Kind::kDepthRvl) {
    putRvlHead(out, image.width, image.height);
    return {out, kRvlHeadBytes + encodeRvl(depth, count, out + kRvlHeadBytes)};
  }
  putZstdHead(out, image.width, image.height);
  const size_t bytes = zstd_.encode(depth, count, out + kZstdHeadBytes, depth_.size() - kZstdHeadBytes);
  if (bytes == 0) throw Failure(SPHC_E_DEVICE, "zstd cannot encode a depth image: out of memory; free some");
  return {out, kZstdHeadBytes + bytes};
}

void RecordingEncoder::putEncoded(Kind kind, int64_t time_ns, const sphc_image &image, Bytes &out) {
  if (kind == Kind::kColorImage || kind == Kind::kDepthImage || kind == Kind::kAmplitudeImage)
    putImageMessage(out, time_ns, image);
  else
    putCompressedMessage(
        out, time_ns, kind,
        kind == Kind::kColorJpeg ? jpeg_.jpeg(image, config_.jpeg_quality) : encodeDepth(kind, image));
}

void RecordingEncoder::add(const CaptureNote &note, const sphc_image &image, const sphc_image &amplitude) {
  const bool is_color = image.format != SPHC_FORMAT_DEPTH16;
  const Kind kind = kindOf(is_color ? SPHC_STREAM_COLOR : SPHC_STREAM_DEPTH);
  putCaptureNote(
      writer_.beginMessage(is_color ? Kind::kColorCapture : Kind::kDepthCapture, note.sequence, note.time_ns),
      note);
  writer_.endMessage();
  if (amplitude.data) {
    const Kind its_kind = amplitudeKind();
    putEncoded(its_kind, note.time_ns, amplitude, writer_.beginMessage(its_kind, note.sequence, note.time_ns));
    writer_.endMessage();
  }
  putEncoded(kind, note.time_ns, image, writer_.beginMessage(kind, note.sequence, note.time_ns));
  writer_.endMessage();
  is_synced_ = false;
}

void RecordingEncoder::addPose(uint32_t sequence, int64_t time_ns, const sphc_rigid &world_from_camera) {
  putPoseMessage(writer_.beginMessage(Kind::kPose, sequence, time_ns), time_ns, world_from_camera);
  writer_.endMessage();
  is_synced_ = false;
}

void RecordingEncoder::addAcceleration(const TimedAcceleration &acceleration) {
  constexpr uint32_t kNoSequence = 0;
  putAcceleration(writer_.beginMessage(Kind::kAcceleration, kNoSequence, acceleration.time_ns), acceleration);
  writer_.endMessage();
  is_synced_ = false;
}

void RecordingEncoder::addDrop(const Drop &drop, int64_t log_time_ns) {
  putDrop(writer_.beginMessage(Kind::kDrops, drop.first_sequence, log_time_ns), drop);
  writer_.endMessage();
  is_synced_ = false;
}

void RecordingEncoder::sync() {
  if (is_synced_) return;
  writer_.endChunk();
  writer_.sync();
  is_synced_ = true;
}

void RecordingEncoder::finish(const sphc_recorder_statistics &statistics) {
  Bytes records;
  putMetadata(records, "spherecloud_statistics",
              {{"color_count", std::to_string(statistics.color_count)},
               {"depth_count", std::to_string(statistics.depth_count)},
               {"dropped_count", std::to_string(statistics.dropped_count)},
               {"missing_count", std::to_string(statistics.missing_count)},
               {"raw_bytes", std::to_string(statistics.raw_bytes)}});
  writer_.finish(records);
}

}  // namespace sphc::recording
