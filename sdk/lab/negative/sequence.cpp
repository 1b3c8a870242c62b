#include "lab/negative/sequence.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

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
class ShotReader {
 public:
  explicit ShotReader(recording::RecordingReader *reader) : reader_(reader), odometry_(reader) {}

  Sequence empty() const {
    Sequence sequence;
    sequence.rig = reader_->calibration();
    return sequence;
  }

  void add(uint32_t index, Sequence *sequence) {
    const std::optional<sphc_localizer_frame> frame = reader_->tryRead(index, &why_);
    if (!frame) return;
    sequence->color_format = frame->color.format;
    Shot shot;
    shot.color = pixelsOf<uint8_t>(frame->color, size_t{frame->color.width} * sequence->channels());
    shot.depth = pixelsOf<uint16_t>(frame->depth, frame->depth.width);
    shot.color_time_ns = frame->color_time_ns;
    shot.depth_time_ns = frame->depth_time_ns;
    shot.world_from_camera = reader_->worldFromCamera(index);
    if (const sphc_localizer_prior *prior = odometry_.at(index)) shot.prior = *prior;
    sequence->shots.push_back(std::move(shot));
    has_read_ = true;
  }

  void requireAny() const {
    if (!has_read_) throw std::runtime_error("not one frame can be read; the last says: " + why_);
  }

 private:
  recording::RecordingReader *reader_;
  PlayedOdometry odometry_;
  bool has_read_ = false;
  std::string why_;
};

}  // namespace

std::vector<Sequence> readSequences(recording::RecordingReader *reader, uint32_t most) {
  const uint32_t frames = reader->frameCount();
  const uint32_t there = std::max(1u, frames / kSequenceFrames), count = std::min(most, there);
  ShotReader shots(reader);
  std::vector<Sequence> sequences;
  for (uint32_t i = 0; i < count; ++i) {
    Sequence sequence = shots.empty();
    const uint32_t first = i * there / count * kSequenceFrames;
    for (uint32_t index = first; index < std::min(frames, first + kSequenceFrames); ++index)
      shots.add(index, &sequence);
    sequences.push_back(std::move(sequence));
  }
  shots.requireAny();
  return sequences;
}

Sequence readFrames(recording::RecordingReader *reader, uint32_t most) {
  const uint32_t frames = reader->frameCount(), count = std::min(most, frames);
  ShotReader shots(reader);
  Sequence sequence = shots.empty();
  for (uint32_t i = 0; i < count; ++i) shots.add(static_cast<uint32_t>(uint64_t{i} * frames / count), &sequence);
  shots.requireAny();
  return sequence;
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
