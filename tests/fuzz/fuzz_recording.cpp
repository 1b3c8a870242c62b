#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>

#include "drivers/replay/replay.h"
#include "host/recording/failure.h"
#include "host/recording/mcap/depth_rvl.h"
#include "host/recording/message_image.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/targets.h"
#include "tests/support/map_bytes.h"

namespace sphc::fuzz {
namespace {

// To the last byte, so that a sanitizer sees a step too far.
void readAmplitude(const sphc_image &image) {
  if (!image.data) return;
  if (image.format != SPHC_FORMAT_GRAY16 || image.stride_bytes < 2 * image.width)
    broken("amplitudes are numbers of 16 bits");
  const auto *bytes = static_cast<const uint8_t *>(image.data);
  const std::vector<uint8_t> copy(bytes, bytes + size_t{image.stride_bytes} * image.height);
  if (copy.empty()) broken("amplitudes have pixels");
}

// Poses and accelerations, as they were recorded.
void readMotion(const sphc_replay *replay) {
  int64_t last_ns = INT64_MIN, time_ns = 0;
  sphc_rigid pose;
  for (uint32_t i = 0; sphc_replay_recorded_pose(replay, i, &time_ns, &pose) == SPHC_OK; ++i) {
    if (i > 0 && time_ns <= last_ns) broken("poses come in order of time");
    last_ns = time_ns;
    double sum = 0;
    for (double q : pose.q_wxyz) sum += q * q;
    for (double t : pose.t_m) sum += 0 * t;
    if (!(std::abs(sum - 1) < 1e-9)) broken("poses are finite, and their rotations of unit length");
  }
  double felt_mps2[3];
  for (uint32_t i = 0; sphc_replay_acceleration(replay, i, &time_ns, felt_mps2) == SPHC_OK; ++i)
    for (double felt : felt_mps2)
      if (!std::isfinite(felt)) broken("accelerations are finite");
}

void readAll(sphc_replay *replay) {
  const uint32_t frames = std::min(sphc_replay_frame_count(replay), 20u);
  for (uint32_t i = 0; i < frames; ++i) {
    sphc_localizer_frame frame;
    sphc_message message = {};
    const sphc_status status = sphc_replay_read_frame(replay, i, &frame, &message);
    if (status > 0 || (status < 0 && !message.text[0])) broken("an image is read, or the failure explains itself");
    if (status == SPHC_OK) readAmplitude(frame.amplitude);
    if (status == SPHC_OK) accept();
  }
  readMotion(replay);
  sphc_source source;
  sphc_replay_source(replay, &source);
  source.start(source.self);
  int64_t last_ns = 0;
  for (uint32_t i = 0; i < 40; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source.acquire(source.self, 0, &capture);
    if (status == SPHC_END) return;
    if (status != SPHC_OK) continue;
    if (capture.time_ns < last_ns) broken("captures come in order of time");
    last_ns = capture.time_ns;
    readAmplitude(capture.amplitude);
    source.release(source.self, &capture);
  }
}

void openAndRead(const uint8_t *data, size_t bytes) {
  const MemoryFile file(data, bytes);
  sphc_replay *replay = nullptr;
  sphc_message message = {};
  const sphc_status status = sphc_replay_open(file.path().c_str(), nullptr, nullptr, &replay, &message);
  if (status != SPHC_OK) {
    if (status > 0 || !message.text[0] || replay) broken("a refusal is a failure that explains itself");
    return;
  }
  readAll(replay);
  sphc_replay_close(&replay);
}

// An MCAP file without the checksums of its chunks and of its data: 0 says that there is none.
bool dropChecksums(std::vector<uint8_t> *file) {
  constexpr uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  constexpr uint8_t kChunk = 0x06, kDataEnd = 0x0F;
  constexpr uint64_t kHeadBytes = 9, kCrcInChunk = 24, kCrcBytes = 4;
  if (file->size() < sizeof kMagic || !std::equal(std::begin(kMagic), std::end(kMagic), file->begin()))
    return false;
  for (uint64_t at = sizeof kMagic; file->size() - at > kHeadBytes;) {
    const uint8_t op = (*file)[at];
    const uint64_t content = at + kHeadBytes, left = file->size() - content, bytes = test::get64(*file, at + 1);
    const uint64_t crc = op == kChunk ? kCrcInChunk : 0;
    if ((op == kChunk || op == kDataEnd) && left >= crc + kCrcBytes)
      std::fill_n(file->begin() + static_cast<ptrdiff_t>(content + crc), kCrcBytes, uint8_t{0});
    if (bytes > left) break;
    at = content + bytes;
  }
  return true;
}

}  // namespace

void recording(const uint8_t *data, size_t bytes) {
  openAndRead(data, bytes);
  // And without checksums, else no changed byte of a chunk would ever be parsed.
  std::vector<uint8_t> unchecked(data, data + bytes);
  if (dropChecksums(&unchecked)) openAndRead(unchecked.data(), unchecked.size());
}

constexpr recording::Kind kImageKinds[] = {recording::Kind::kColorImage,   recording::Kind::kColorJpeg,
                                           recording::Kind::kDepthImage,   recording::Kind::kDepthRvl,
                                           recording::Kind::kDepthZstd,    recording::Kind::kAmplitudeImage,
                                           recording::Kind::kAmplitudeZstd};

// The place of its kind in the list above, then the message.
void message(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  const recording::Kind kind = kImageKinds[data[0] % std::size(kImageKinds)];
  const std::vector<uint8_t> exact(data + 1, data + bytes);
  const bool is_color = recording::streamOf(kind) == SPHC_STREAM_COLOR;
  const sphc_format numbers = recording::isAmplitude(kind) ? SPHC_FORMAT_GRAY16 : SPHC_FORMAT_DEPTH16;
  sphc_camera camera = {};
  camera.width = 16;
  camera.height = 16;
  std::vector<uint16_t> pixels(16 * 16 * 2, 0xABCD);
  const size_t used = is_color ? 16 * 16 * 3 / 2 : 16 * 16;
  try {
    recording::MessageDecoder().decode(kind, recording::viewOf(exact), camera,
                                       is_color ? SPHC_FORMAT_BGR8 : numbers,
                                       reinterpret_cast<uint8_t *>(pixels.data()));
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_DEVICE && failure.status() != SPHC_E_IMAGE) broken("the failure is the image's");
  }
  if (std::any_of(pixels.begin() + static_cast<ptrdiff_t>(used), pixels.end(),
                  [](uint16_t p) { return p != 0xABCD; }))
    broken("nothing is written behind the image");
}

void rvl(const uint8_t *data, size_t bytes) {
  const std::vector<uint8_t> exact(data, data + bytes);
  std::vector<uint16_t> depth(300);
  if (!recording::decodeRvl(recording::viewOf(exact), depth.data(), depth.size())) return;
  std::vector<uint8_t> encoded(recording::rvlMostBytes(depth.size()));
  std::vector<uint16_t> again(depth.size());
  encoded.resize(recording::encodeRvl(depth.data(), depth.size(), encoded.data()));
  if (!recording::decodeRvl(recording::viewOf(encoded), again.data(), again.size()) || again != depth)
    broken("what was decoded can be encoded");
  accept();
}

}  // namespace sphc::fuzz
