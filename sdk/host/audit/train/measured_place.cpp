#include "host/audit/train/measured_place.h"

#include <sstream>
#include <stdexcept>

#include "host/audit/attack/virtual_camera.h"
#include "host/audit/score/frame_view.h"
#include "host/audit/score/look_around.h"
#include "host/audit/train/replay_handle.h"
#include "host/build/sphere_cloud.h"
#include "host/frames/frame_features.h"
#include "host/import/rgbd_import.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/features/gray.h"

namespace sphc::host {
namespace {

constexpr double kApartDeg = 20, kSeenShare = 0.5;

struct Description {
  std::string name, recording, calibration;
  uint32_t first = 0, last = UINT32_MAX, step = 1;
};

Description parse(const std::string &text) {
  Description place;
  std::istringstream stream(text);
  std::string first, last, step;
  std::getline(stream, place.name, '=');
  std::getline(stream, place.recording, ',');
  std::getline(stream, place.calibration, ',');
  if (std::getline(stream, first, ',')) place.first = static_cast<uint32_t>(std::stoul(first));
  if (std::getline(stream, last, ',')) place.last = static_cast<uint32_t>(std::stoul(last));
  if (std::getline(stream, step, ',')) place.step = static_cast<uint32_t>(std::stoul(step));
  if (place.recording.empty())
    throw std::runtime_error(text + " is not name=recording,calibration,first,last,step");
  return place;
}

Replay open(const Description &place) {
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  config.first = place.first;
  config.last = place.last;
  config.step = place.step;
  return openReplay(place.recording.c_str(), place.calibration.empty() ? nullptr : place.calibration.c_str(),
                    &config);
}

// Frames whose axes are far enough from each other.
class FrameReader {
 public:
  FrameReader(sphc_replay *replay, const Camera &camera, const PointModel &model)
      : replay_(replay),
        camera_(camera),
        features_(camera.width(), camera.height(), RgbdImportOptions().max_keypoints) {
    for (const ModelPoint &point : model.points) {
      positions_.push_back(point.position_m);
      descriptors_.push_back(point.descriptor);
    }
  }

  void read(MeasuredPlace *place) {
    std::vector<Vector3> axes;
    for (uint32_t i = 0; i < sphc_replay_frame_count(replay_); ++i) {
      sphc_rigid pose;
      sphc_frame frame;
      sphc_message message;
      if (sphc_replay_pose(replay_, i, &pose) != SPHC_OK) continue;
      const Rigid world_from_camera = rigidFromDoor(pose);
      const Vector3 axis = world_from_camera.rotation.col(2);
      if (!farFrom(axis, axes) || sphc_replay_read_frame(replay_, i, &frame, &message) != SPHC_OK) continue;
      axes.push_back(axis);
      const cv::Mat grey = greyOf(frame.color);
      place->frame_truths.push_back(frameView(grey, camera_));
      place->own_keypoints.push_back(ownKeypoints(grey));
      place->unprotected.push_back(see(positions_, descriptors_, {}, world_from_camera.inverse()));
    }
  }

 private:
  static bool farFrom(const Vector3 &axis, const std::vector<Vector3> &others) {
    for (const Vector3 &other : others)
      if (axis.dot(other) > std::cos(kApartDeg * 3.14159265358979323846 / 180)) return false;
    return true;
  }

  static cv::Mat greyOf(const sphc_image &color) {
    cv::Mat grey(static_cast<int>(color.height), static_cast<int>(color.width), CV_8U);
    bgrToGray(static_cast<const uint8_t *>(color.data), static_cast<int32_t>(color.stride_bytes), grey.cols,
              grey.rows, grey.data, static_cast<int32_t>(grey.step));
    return grey;
  }

  SeenPoints ownKeypoints(const cv::Mat &grey) {
    features_.extract({grey.data, grey.cols, grey.rows, static_cast<int32_t>(grey.step)});
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

  sphc_replay *replay_;
  Camera camera_;
  FrameFeatures features_;
  std::vector<Vector3> positions_;
  std::vector<Descriptor> descriptors_;
};

Camera colorCamera(sphc_replay *replay) {
  sphc_calibration calibration;
  sphc_calibration_init(&calibration, sizeof calibration);
  if (sphc_replay_calibration(replay, &calibration) != SPHC_OK)
    throw std::runtime_error("the recording's calibration cannot be read");
  return Camera(calibration.color_camera);
}

}  // namespace

MeasuredPlace readPlace(const std::string &description, SecretRandom *random) {
  const Description described = parse(description);
  const Replay replay = open(described);
  RgbdImportSummary summary;
  const PointModel model = importRgbd(replay.get(), {}, {}, &summary);
  MeasuredPlace place;
  place.name = described.name;
  Vector3 centre_m;
  place.points = makeSphereCloud(model, {1}, *gaussianFakes(), random, &centre_m).points;
  const Panorama panorama = lookAround(replay.get(), centre_m);
  place.rotations = choosePoses(replay.get(), panorama, kApartDeg, kSeenShare);
  for (const Matrix3 &rotation : place.rotations) place.centre_truths.push_back(panorama.view(rotation));
  FrameReader(replay.get(), colorCamera(replay.get()), model).read(&place);
  return place;
}

}  // namespace sphc::host
