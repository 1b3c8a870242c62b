#include "host/import/colmap_import.h"

#include <Eigen/LU>
#include <cmath>
#include <set>
#include <stdexcept>

#include "host/import/colmap_descriptors.h"
#include "host/import/colmap_model.h"
#include "host/import/colmap_world.h"
#include "host/import/descriptors.h"
#include "host/import/near_duplicates.h"
#include "host/import/upright.h"
#include "runtime/geometry/camera.h"

namespace sphc::host {
namespace {

constexpr double kColmapPixelSigma = 1.0;
constexpr double kReachM = 100;  // from the cameras that saw it; what lies beyond tells a direction, no place

// Of a triangulated point, by the pixels that saw it; metres.
double sigmaOf(const ColmapModel &model, const ColmapPoint &point, double metres_per_unit) {
  Matrix3 information = Matrix3::Zero();
  for (const ColmapObservation &o : point.track) {
    const ColmapImage &image = model.images.at(o.image);
    const Vector3 in_camera = image.camera_from_model * point.position;
    const Vector3 view = image.camera_from_model.rotation.transpose() * in_camera.normalized();
    const Camera camera(model.cameras.at(image.camera));
    const double across = kColmapPixelSigma * camera.awayM(in_camera) / camera.focal();
    information += (Matrix3::Identity() - view * view.transpose()) / (across * across);
  }
  return metres_per_unit * std::sqrt(information.inverse().trace() / 3);
}

// A track may have two keypoints of one image.
uint32_t imagesThatSaw(const ColmapPoint &point) {
  std::set<uint32_t> images;
  for (const ColmapObservation &o : point.track) images.insert(o.image);
  return static_cast<uint32_t>(images.size());
}

// Images from one spot tell a direction alone.
bool hasPlace(const ColmapModel &model, const ColmapPoint &point, double metres_per_unit, double sigma_m) {
  for (const ColmapObservation &o : point.track) {
    const Vector3 in_camera = model.images.at(o.image).camera_from_model * point.position;
    const double distance_m = metres_per_unit * in_camera.norm();
    if (!(in_camera.z() > 0 && distance_m < kReachM && sigma_m < distance_m)) return false;
  }
  return true;
}

void setWorld(const ColmapModel &model, const ColmapImportOptions &options, ColmapImportSummary *summary) {
  const Vector3 down = options.gravity ? *options.gravity : downByCameras(model);
  if (down.norm() > 0) summary->world_from_model_axes = uprightAxes(down.normalized());
  ColmapScale scale;
  if (options.metres_per_unit)
    scale.metres_per_unit = *options.metres_per_unit;
  else
    scale = scaleByDepth(model, options.depth, options.calibration);
  summary->metres_per_unit = scale.metres_per_unit;
  summary->scale_spread = scale.spread;
}

const Descriptor &representative(const std::vector<Descriptor> &descriptors) {
  std::vector<const Descriptor *> seen;
  for (const Descriptor &d : descriptors) seen.push_back(&d);
  return *seen[medoidOf(seen)];
}

}  // namespace

PointModel importColmap(const ColmapImportOptions &options, const Progress &progress,
                        ColmapImportSummary *summary) {
  *summary = {};
  const ColmapModel model = parseColmapModel(readColmapFiles(options.model));
  summary->images = static_cast<uint32_t>(model.images.size());
  summary->points_of_model = static_cast<uint32_t>(model.points.size());
  setWorld(model, options, summary);
  const DescriptorsOfPoints descriptors = options.descriptors == ColmapDescriptors::kAgain
                                              ? describeAgain(model, options, progress)
                                              : describeFromDatabase(model, options.database);
  summary->points_described = static_cast<uint32_t>(descriptors.size());
  PointModel points;
  for (const auto &[id, seen] : descriptors) {
    const ColmapPoint &point = model.points.at(id);
    ModelPoint kept;
    kept.observations = imagesThatSaw(point);
    if (kept.observations < options.min_observations) continue;
    kept.sigma_m = sigmaOf(model, point, summary->metres_per_unit);
    if (!hasPlace(model, point, summary->metres_per_unit, kept.sigma_m)) continue;
    kept.position_m = summary->metres_per_unit * (summary->world_from_model_axes * point.position);
    kept.descriptor = representative(seen);
    points.points.push_back(kept);
  }
  PointModel result = withoutNearDuplicates(std::move(points), kModelNearDuplicates);
  summary->points_kept = static_cast<uint32_t>(result.points.size());
  return result;
}

}  // namespace sphc::host
