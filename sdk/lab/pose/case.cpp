#include "lab/pose/case.h"

#include <cmath>
#include <limits>

namespace sphc::host {
namespace {

double rowDepthOf(const PoseRow &row, DepthSource source) {
  return source == DepthSource::kTof ? row.z_tof_m : row.z_oracle_m;
}

bool isDepth(double z_m) { return z_m > kNearestDepthM && z_m <= kFarthestDepthM; }

const PoseQuery *findQuery(const PoseFile &file, const PoseQuery &query) {
  for (const PoseQuery &other : file.queries)
    if (other.index == query.index && other.name == query.name) return &other;
  return nullptr;
}

void addTruePoints(const PoseQuery &eta100, DepthSource source, PoseCase *pose_case) {
  for (size_t i = 0; i < eta100.rows.size(); ++i) {
    if (!isDepth(rowDepthOf(eta100.rows[i], source))) continue;
    pose_case->true_pixels_px.push_back(eta100.rows[i].pixel_px);
    pose_case->true_points_map_m.push_back(eta100.points_map_m[i]);
    pose_case->true_point_ids.push_back(eta100.rows[i].point_id);
  }
}

}  // namespace

const char *depthName(DepthSource source) { return source == DepthSource::kTof ? "tof" : "oracle"; }

CaseNoise noiseFor(DepthSource source) {
  CaseNoise noise;
  if (source == DepthSource::kOracle) noise.depth_sigma_m = 0.003, noise.depth_sigma_per_m2 = 0;
  return noise;
}

LiftedPoint liftPixel(const PinholeCamera &camera, const Vector2 &pixel_px, double z_m, const CaseNoise &noise) {
  const bool known = isDepth(z_m);
  const double z = known ? z_m : 1;
  const Vector3 ray((pixel_px.x() - camera.cx_px) / camera.fx_px, (pixel_px.y() - camera.cy_px) / camera.fy_px, 1);
  const double across =
      (known ? noise.pixel_sigma_px : noise.ray_sigma_px) * z / (0.5 * (camera.fx_px + camera.fy_px));
  const double along = (noise.depth_sigma_m + noise.depth_sigma_per_m2 * z * z) * ray.norm();
  return {z * ray, std::hypot(across, noise.map_sigma_m),
          known ? std::hypot(along, noise.map_sigma_m) : std::numeric_limits<double>::infinity()};
}

PoseCase makePoseCase(const PoseQuery &query, uint32_t eta_percent, DepthSource source, const CaseNoise &noise,
                      const PoseQuery *eta100) {
  PoseCase c;
  c.name = query.name;
  c.eta_percent = eta_percent;
  c.source = source;
  c.camera = query.camera;
  c.truth_camera_from_map = query.camera_from_map;
  for (const PoseRow &row : query.rows) {
    const double z = rowDepthOf(row, source);
    const Correspondence correspondence = {liftPixel(query.camera, row.pixel_px, z, noise), row.direction};
    if (isDepth(z)) {
      c.correspondences.push_back(correspondence);
      c.is_true.push_back(row.is_true);
    } else {
      c.without_depth.push_back(correspondence);
      c.without_depth_is_true.push_back(row.is_true);
    }
  }
  if (eta100 && eta100->points_map_m.size() == eta100->rows.size()) addTruePoints(*eta100, source, &c);
  return c;
}

std::vector<PoseCase> makePoseCases(const PoseFile &file, DepthSource source, const CaseNoise &noise,
                                    const PoseFile &eta100) {
  std::vector<PoseCase> cases;
  for (const PoseQuery &query : file.queries)
    cases.push_back(makePoseCase(query, file.eta_percent, source, noise, findQuery(eta100, query)));
  for (size_t i = 0; i < cases.size(); ++i) cases[i].index = static_cast<uint32_t>(i);
  return cases;
}

}  // namespace sphc::host
