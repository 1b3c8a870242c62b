#include "lab/pose/described_frames.h"

#include <stdexcept>

#include "host/frames/frame_features.h"
#include "host/frames/frame_images.h"
#include "host/frames/recording.h"
#include "runtime/stages/align/sparse.h"

namespace sphc::host {
namespace {

constexpr DepthSensor kSensor = {0, 0.3, 6, 0.004, 0.002};  // the unit is the recording's
constexpr uint32_t kKeypoints = 1000;

class Describer {
 public:
  explicit Describer(const sphc_rig &calibration)
      : camera_(calibration.color_camera), features_(camera_.width(), camera_.height(), kKeypoints) {
    DepthSensor sensor = kSensor;
    sensor.unit_m = calibration.depth_unit_m;
    aligner_ =
        SparseAligner(camera_, Camera(calibration.depth_camera), rigidFromC(calibration.color_from_depth), sensor);
  }

  DescribedFrame describe(const sphc_localizer_frame &frame) {
    features_.extract(grayOf(frame.color, &gray_));
    DescribedFrame described;
    described.camera = pinhole();
    for (uint32_t i = 0; i < features_.count(); ++i) add(i, depthOf(frame.depth), &described);
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

  void add(uint32_t i, const ImageView<uint16_t> &depth, DescribedFrame *frame) const {
    Vector2 ray;
    if (!camera_.unproject(features_.pixel(i), &ray)) return;
    const PinholeCamera &c = frame->camera;
    Vector3 point_m;
    double sigma_m;
    const bool lifted = aligner_.lift(depth, features_.pixel(i), &point_m, &sigma_m);
    frame->pixels_px.emplace_back(c.fx_px * ray.x() + c.cx_px, c.fy_px * ray.y() + c.cy_px);
    frame->depths_m.push_back(lifted ? point_m.z() : 0);
    frame->descriptors.push_back(features_.descriptor(i));
  }

  Camera camera_;
  SparseAligner aligner_;
  FrameFeatures features_;
  std::vector<uint8_t> gray_;
};

}  // namespace

std::vector<DescribedFrame> describeFrames(recording::RecordingReader *reader) {
  Describer describer(reader->calibration());
  std::vector<DescribedFrame> frames;
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
    if (!pose) continue;
    const sphc_localizer_frame frame = reader->read(i);
    frames.push_back(describer.describe(frame));
    frames.back().name = std::to_string(frame.sequence);
    frames.back().camera_from_world = rigidFromC(*pose).inverse();
  }
  if (frames.empty())
    throw std::runtime_error("no frame to localize has a pose; without the truth nothing can be compared");
  return frames;
}

}  // namespace sphc::host
