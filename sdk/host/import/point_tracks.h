// Points that grow as frames are added: observations that agree are merged.
#pragma once
#include <vector>

#include "host/import/point_model.h"
#include "host/import/rgbd_import.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/depth_sensor.h"

namespace sphc::host {

// Noise assumed of the mapping sensor.
constexpr DepthSensor kMappingNoise = {0, 0, 0, 0.004, 0.002};

// A keypoint of one mapping frame, lifted and placed in the world.
struct Observation {
  Vector3 position_m;   // world
  Vector3 camera_m;     // where the camera was, world
  Matrix3 information;  // inverse covariance of position_m, world axes
  Vector2 image_px;     // where the image shows it
  Vector2 pixel_px;     // where it would, had all rows been exposed at once
  double depth_m;
  double sigma_m;         // along the view
  double metric_scale_m;  // size of the keypoint's Gaussian in space
  Descriptor descriptor;
  uint32_t recording = 0;  // of those that are imported together, the oldest first
  uint32_t spot = 0;       // of the image (fixed_in_image.h)
};

// A point as the frames agree on it.
struct TrackedPoint {
  ModelPoint point;
  std::vector<Vector3> cameras_m;  // where those were that saw it, world; the last ones of many
  std::vector<uint32_t> spots;     // where they saw it in their images
  uint32_t recording = 0;          // the last that saw it
};
// Near-duplicates are merged.
PointModel modelOf(const std::vector<TrackedPoint> &points);

class PointTracks {
 public:
  explicit PointTracks(const RgbdImportOptions &options) : options_(options) {}

  // Joins a frame's observations to the points they reproject onto and resemble, and makes new points of the
  // others. Returns how many joined.
  size_t add(const Camera &camera, const Rigid &camera_from_world, const std::vector<Observation> &observations);
  size_t count() const { return tracks_.size(); }
  // Robust positions, representative descriptors; points with too few agreeing observations are left out.
  std::vector<TrackedPoint> points() const;

 private:
  struct Track {
    Vector3 position_m;
    double metric_scale_m;
    std::vector<Observation> observations;
  };
  struct Candidate {
    size_t track;
    Vector2 pixel_px;
    double depth_m;
  };
  std::vector<std::vector<Candidate>> project(const Camera &camera, const Rigid &camera_from_world) const;
  double compare(const Observation &observation, const Candidate &candidate) const;

  RgbdImportOptions options_;
  std::vector<Track> tracks_;
};

}  // namespace sphc::host
