#include "lab/negative/sequence.h"

#include <algorithm>
#include <cstring>

#include "host/evaluate/played_odometry.h"

namespace sphc::host {
namespace {

template <typename T>
std::vector<T> pixelsOf(const sphc_image &image, size_t values_a_row) {
  std::vector<T> pixels(values_a_row * image.height);
  for (uint32_t y = 0; y < image.height; ++y)
    std::memcpy(&pixels[y * values_a_row],
                static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes,
                values_a_row * sizeof(T));
  return pixels;
}

// With odometry; the faults that are to be told without it take it away.
void addShot(recording::RecordingReader *reader, uint32_t index, PlayedOdometry *odometry, Sequence *sequence) {
  const std::optional<sphc_localizer_frame> frame = reader->tryRead(index);
  if (!frame) return;
  sequence->color_format = frame->color.format;
  Shot shot;
  shot.color = pixelsOf<uint8_t>(frame->color, size_t{frame->color.width} * sequence->channels());
  shot.depth = pixelsOf<uint16_t>(frame->depth, frame->depth.width);
  shot.color_time_ns = frame->color_time_ns;
  shot.depth_time_ns = frame->depth_time_ns;
  shot.world_from_camera = reader->worldFromCamera(index);
  if (const sphc_localizer_prior *prior = odometry->at(index)) shot.prior = *prior;
  sequence->shots.push_back(std::move(shot));
}

}  // namespace

std::vector<Sequence> readSequences(recording::RecordingReader *reader, uint32_t most) {
  const uint32_t frames = reader->frameCount();
  const uint32_t there = std::max(1u, frames / kSequenceFrames), count = std::min(most, there);
  PlayedOdometry odometry(reader);
  std::vector<Sequence> sequences;
  for (uint32_t i = 0; i < count; ++i) {
    Sequence sequence;
    sequence.rig = reader->calibration();
    const uint32_t first = i * there / count * kSequenceFrames;
    for (uint32_t index = first; index < std::min(frames, first + kSequenceFrames); ++index)
      addShot(reader, index, &odometry, &sequence);
    sequences.push_back(std::move(sequence));
  }
  return sequences;
}

sphc_localizer_frame frameOf(const Sequence &sequence, const Shot &shot, uint32_t number) {
  sphc_localizer_frame frame = {};
  frame.struct_size = sizeof frame;
  frame.sequence = number;
  frame.color_time_ns = shot.color_time_ns;
  frame.depth_time_ns = shot.depth_time_ns;
  frame.color = {shot.color.data(), sequence.colorWidth(), sequence.colorHeight(),
                 sequence.colorWidth() * sequence.channels(), sequence.color_format};
  frame.depth = {shot.depth.data(), sequence.depthWidth(), sequence.depthHeight(), 2 * sequence.depthWidth(),
                 SPHC_FORMAT_DEPTH16};
  if (shot.prior.flags) frame.prior = &shot.prior;
  return frame;
}

}  // namespace sphc::host
