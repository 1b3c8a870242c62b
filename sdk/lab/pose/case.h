// A query as the estimators get it: keypoints lifted by depth, with what is known of their errors, and for the
// peers that need them true points.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lab/pose/file.h"
#include "runtime/types/correspondence.h"

namespace sphc::host {

enum class DepthSource { kTof, kOracle };
const char *depthName(DepthSource source);  // "tof", "oracle"

// What the estimator is told of errors, 1 sigma: keypoints and points of a structure from motion, and a structured
// light sensor that works from 0.8 to 4 m.
struct CaseNoise {
  double pixel_sigma_px = 0.5, ray_sigma_px = 0.7;           // of a keypoint with depth, and of one without
  double depth_sigma_m = 0.006, depth_sigma_per_m2 = 0.004;  // of z: sigma_m + sigma_per_m2 z^2
  double map_sigma_m = 0.0005;
};
CaseNoise noiseFor(DepthSource source);

struct PoseCase {
  std::string name;
  uint32_t index = 0;  // in its file; 0 begins a recording anew
  DepthSource source = DepthSource::kTof;
  uint32_t eta_percent = 0;
  PinholeCamera camera;
  Rigid truth_camera_from_map;

  std::vector<Correspondence> correspondences;  // rows with depth, in file order
  std::vector<bool> is_true;                    // of them
  // Rows without depth: on their viewing rays at z = 1, along_m infinite.
  std::vector<Correspondence> without_depth;
  std::vector<bool> without_depth_is_true;

  // For peers that see the map's points: of the rows with depth at eta 100.  Empty when not known.
  std::vector<Vector2> true_pixels_px;
  std::vector<Vector3> true_points_map_m;
  std::vector<uint32_t> true_point_ids;

  double focalPx() const { return 0.5 * (camera.fx_px + camera.fy_px); }
};

// `eta100` is the same query with true points, or null.
PoseCase makePoseCase(const PoseQuery &query, uint32_t eta_percent, DepthSource source, const CaseNoise &noise,
                      const PoseQuery *eta100);
// One case a query; queries are found in `eta100` by name and index.
std::vector<PoseCase> makePoseCases(const PoseFile &file, DepthSource source, const CaseNoise &noise,
                                    const PoseFile &eta100);

// Rows with a depth beyond these take part as rows without.
constexpr double kNearestDepthM = 0.01, kFarthestDepthM = 5;

// The lifted keypoint at depth z, or on its viewing ray when z is out of bounds.
LiftedPoint liftPixel(const PinholeCamera &camera, const Vector2 &pixel_px, double z_m, const CaseNoise &noise);

}  // namespace sphc::host
