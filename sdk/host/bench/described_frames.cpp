#include "host/bench/described_frames.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "host/bench/features_variant.h"
#include "runtime/stages/align/sparse.h"
#include "runtime/stages/features/gray.h"

namespace sphc::host {
namespace {

constexpr DepthSensor kSensor = {0, 0.3, 6, 0.004, 0.002};  // the unit is the recording's
constexpr char kExtractor[] = "ours 1000";

class Describer {
 public:
  explicit Describer(const sphc_calibration &calibration) : camera_(calibration.color_camera) {
    DepthSensor sensor = kSensor;
    sensor.unit_m = calibration.depth_unit_m;
    aligner_ = SparseAligner(camera_, Camera(calibration.depth_camera), rigidFromDoor(calibration.color_from_depth),
                             sensor);
    for (FeaturesVariant &variant : ourFeatures(camera_.width(), camera_.height()))
      if (variant.name == kExtractor) extractor_ = std::move(variant);
    if (!extractor_.run) throw std::runtime_error("the recording cannot be described: " + extractor_.absent);
    gray_.resize(static_cast<size_t>(camera_.width()) * static_cast<size_t>(camera_.height()));
  }

  DescribedFrame describe(const sphc_frame &frame) {
    const int32_t width = camera_.width(), height = camera_.height();
    bgrToGray(static_cast<const uint8_t *>(frame.color.data), static_cast<int32_t>(frame.color.stride_bytes), width,
              height, gray_.data(), width);
    const FoundFeatures found = extractor_.run({gray_.data(), width, height, width});
    const ImageView<uint16_t> depth = {
        static_cast<const uint16_t *>(frame.depth.data), static_cast<int32_t>(frame.depth.width),
        static_cast<int32_t>(frame.depth.height), static_cast<int32_t>(frame.depth.stride_bytes / 2)};
    DescribedFrame described;
    described.camera = pinhole();
    for (size_t i = 0; i < found.pixels_px.size(); ++i) add(found, i, depth, &described);
    return described;
  }

 private:
  PinholeCamera pinhole() const {
    return {camera_.fx(),
            camera_.fy(),
            camera_.parameters().params[2],
            camera_.parameters().params[3],
            static_cast<uint32_t>(camera_.width()),
            static_cast<uint32_t>(camera_.height())};
  }

  void add(const FoundFeatures &found, size_t i, const ImageView<uint16_t> &depth, DescribedFrame *frame) const {
    Vector2 ray;
    if (!camera_.unproject(found.pixels_px[i], &ray)) return;
    const PinholeCamera &c = frame->camera;
    Vector3 point_m;
    double sigma_m;
    const bool lifted = aligner_.lift(depth, found.pixels_px[i], &point_m, &sigma_m);
    frame->pixels_px.emplace_back(c.fx_px * ray.x() + c.cx_px, c.fy_px * ray.y() + c.cy_px);
    frame->depths_m.push_back(lifted ? point_m.z() : 0);
    Descriptor descriptor;
    std::memcpy(descriptor.bytes, found.descriptors.data() + i * sizeof descriptor.bytes, sizeof descriptor.bytes);
    frame->descriptors.push_back(descriptor);
  }

  Camera camera_;
  SparseAligner aligner_;
  FeaturesVariant extractor_;
  std::vector<uint8_t> gray_;
};

}  // namespace

std::vector<DescribedFrame> describeFrames(sphc_replay *replay) {
  sphc_calibration calibration = {};
  calibration.struct_size = sizeof calibration;
  if (sphc_replay_calibration(replay, &calibration) != SPHC_OK)
    throw std::runtime_error("the recording's calibration cannot be read; check the calibration file");
  Describer describer(calibration);
  std::vector<DescribedFrame> frames;
  for (uint32_t i = 0; i < sphc_replay_frame_count(replay); ++i) {
    sphc_rigid pose;
    sphc_frame frame;
    sphc_message message;
    if (sphc_replay_pose(replay, i, &pose) != SPHC_OK) continue;
    if (sphc_replay_read_frame(replay, i, &frame, &message) != SPHC_OK)
      throw std::runtime_error("frame " + std::to_string(i) + " cannot be read: " + message.text);
    frames.push_back(describer.describe(frame));
    frames.back().name = std::to_string(frame.sequence);
    frames.back().camera_from_world = rigidFromDoor(pose).inverse();
  }
  if (frames.empty())
    throw std::runtime_error("no frame to localize has a pose; without the truth nothing can be compared");
  return frames;
}

}  // namespace sphc::host
