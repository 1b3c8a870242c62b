#include "lab/train/measured_place.h"

#include <sstream>
#include <stdexcept>

#include "host/audit/attack/virtual_camera.h"
#include "host/audit/score/centre_views.h"
#include "host/audit/score/frame_view.h"
#include "host/frames/frame_features.h"
#include "host/frames/frame_images.h"
#include "host/frames/recording.h"
#include "host/import/rgbd_import.h"
#include "host/publish/sphere_cloud.h"
#include "runtime/base/elementary.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr double kApartDeg = 20;  // of frames' axes

struct Description {
  std::string name;
  RecordingOptions recording;
};

Description parse(const std::string &text) {
  Description place;
  RecordingOptions &recording = place.recording;
  std::istringstream stream(text);
  std::string first, last, step;
  std::getline(stream, place.name, '=');
  std::getline(stream, recording.folder, ',');
  std::getline(stream, recording.calibration, ',');
  if (std::getline(stream, first, ',')) recording.first = static_cast<uint32_t>(std::stoul(first));
  if (std::getline(stream, last, ',')) recording.last = static_cast<uint32_t>(std::stoul(last));
  if (std::getline(stream, step, ',')) recording.step = static_cast<uint32_t>(std::stoul(step));
  if (recording.folder.empty())
    throw std::runtime_error(text + " is not name=recording,calibration,first,last,step");
  return place;
}

// Frames whose axes are far enough from each other.
class FrameReader {
 public:
  FrameReader(RecordingReader *reader, const Camera &camera, const PointModel &model)
      : reader_(reader),
        camera_(camera),
        features_(camera.width(), camera.height(), RgbdImportOptions().max_keypoints) {
    for (const ModelPoint &point : model.points) {
      positions_.push_back(point.position_m);
      descriptors_.push_back(point.descriptor);
    }
  }

  void read(MeasuredPlace *place) {
    std::vector<Vector3> axes;
    for (uint32_t i = 0; i < reader_->frameCount(); ++i) {
      const std::optional<sphc_rigid> pose = reader_->worldFromCamera(i);
      if (!pose) continue;
      const Rigid world_from_camera = rigidFromC(*pose);
      const Vector3 axis = world_from_camera.rotation.col(2);
      const std::optional<sphc_localizer_frame> frame = farFrom(axis, axes) ? reader_->tryRead(i) : std::nullopt;
      if (!frame) continue;
      axes.push_back(axis);
      const GrayView grey = grayOf(frame->color, &grey_);
      place->frame_truths.push_back(frameView(cv::Mat(grey.height, grey.width, CV_8U, grey_.data()), camera_));
      place->own_keypoints.push_back(ownKeypoints(grey));
      place->unprotected.push_back(see(positions_, descriptors_, {}, world_from_camera.inverse()));
    }
  }

 private:
  static bool farFrom(const Vector3 &axis, const std::vector<Vector3> &others) {
    for (const Vector3 &other : others)
      if (axis.dot(other) > std::cos(kApartDeg * kPi / 180)) return false;
    return true;
  }

  SeenPoints ownKeypoints(const GrayView &grey) {
    features_.extract(grey);
    std::vector<Vector3> rays;
    std::vector<Descriptor> descriptors;
    for (uint32_t i = 0; i < features_.count(); ++i) {
      Vector2 ray;
      if (!camera_.unproject(features_.pixel(i), &ray)) continue;
      rays.emplace_back(ray.x(), ray.y(), 1);
      descriptors.push_back(features_.descriptor(i));
    }
    return see(rays, descriptors, {}, {});
  }

  RecordingReader *reader_;
  Camera camera_;
  FrameFeatures features_;
  std::vector<uint8_t> grey_;
  std::vector<Vector3> positions_;
  std::vector<Descriptor> descriptors_;
};

}  // namespace

MeasuredPlace readPlace(const std::string &description, SecretRandom *random) {
  const Description described = parse(description);
  const auto reader = openRecording(described.recording);
  RgbdImportSummary summary;
  const PointModel model = importRgbd({{reader.get()}}, {}, {}, &summary);
  MeasuredPlace place;
  place.name = described.name;
  const Vector3 centre_m = centreOf(model.points);
  for (const ModelPoint &point : model.points) place.points.push_back(seenFrom(centre_m, point));
  shuffle(&place.points, random);
  place.centre_views = viewsFromCentre(reader.get(), centre_m, [](uint32_t, uint32_t) {});
  FrameReader(reader.get(), Camera(reader->calibration().color_camera), model).read(&place);
  return place;
}

}  // namespace sphc::host
