#include <cmath>

#include "host/cli/common/import_recording.h"
#include "host/cli/common/progress.h"
#include "host/publish/fakes/strategy.h"
#include "host/publish/sphere_cloud.h"
#include "lab/common/recording_name.h"
#include "lab/compare/input.h"
#include "lab/pose/case.h"
#include "lab/pose/described_frames.h"
#include "lab/pose/ratio_match.h"

namespace sphc::host {
namespace {

constexpr double kRatio = 0.8;

std::vector<Vector3> pointsAbout(const Vector3 &centre_m, const PointModel &model) {
  std::vector<Vector3> points_m;
  for (const ModelPoint &point : model.points) points_m.push_back(point.position_m - centre_m);
  return points_m;
}

// The published direction of every point.
std::vector<Assignment> assignmentsOf(const std::vector<Vector3> &points_m, const PointModel &model, double eta) {
  SecretRandom random{SecretKey{}};
  std::vector<size_t> order(points_m.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  shuffle(&order, &random);
  std::vector<SpherePoint> points;
  for (const size_t i : order) points.push_back({points_m[i].normalized(), model.points[i].descriptor});
  const auto real_count = static_cast<size_t>(eta * static_cast<double>(points.size()));
  const std::vector<Assignment> shuffled = gaussianFakes()->assignments(points, real_count, &random);
  std::vector<Assignment> assignments(points.size());
  for (size_t k = 0; k < order.size(); ++k) assignments[order[k]] = shuffled[k];
  return assignments;
}

PoseQuery matchedQuery(const DescribedFrame &frame, const std::vector<Descriptor> &map,
                       const std::vector<Vector3> &points_m, const Vector3 &centre_m) {
  PoseQuery query;
  query.name = frame.name;
  query.camera = frame.camera;
  const Rigid &from_world = frame.camera_from_world;
  query.camera_from_map = {from_world.rotation, from_world * centre_m};
  for (const RatioMatch &match : matchByRatio(frame.descriptors, map, kRatio)) {
    const Vector3 &point_m = points_m[match.point];
    query.rows.push_back({frame.pixels_px[match.query], point_m.normalized(), frame.depths_m[match.query],
                          (query.camera_from_map * point_m).z(), true, match.point});
    query.points_map_m.push_back(point_m);
  }
  return query;
}

ComparedSphere sphereOf(const CompareInput &input, const std::vector<Assignment> &assignments, double eta) {
  ComparedSphere sphere = {input.true_points, {}};
  for (const Assignment &assignment : assignments) sphere.directions.push_back(assignment.shown.direction);
  sphere.queries.eta_percent = static_cast<uint32_t>(std::lround(100 * eta));
  for (PoseQuery &query : sphere.queries.queries) {
    for (PoseRow &row : query.rows) {
      row.direction = assignments[row.point_id].shown.direction;
      row.is_true = assignments[row.point_id].real;
    }
  }
  return sphere;
}

}  // namespace

CompareInput recordCompareInput(const CompareRecordingOptions &options) {
  CompareInput input;
  input.name = recordingName(options.mapping.folder).stem().string();
  const PointModel model = importRecording(options.mapping, "mapping   ");
  const Vector3 centre_m = centreOf(model.points);
  input.points_m = pointsAbout(centre_m, model);
  std::vector<Descriptor> map;
  for (uint32_t i = 0; i < model.points.size(); ++i) {
    map.push_back(model.points[i].descriptor);
    input.place_of_id[i] = i;
  }
  const auto reader = openRecording(options.queries);
  const std::vector<DescribedFrame> frames = describeFrames(reader.get());
  ProgressBar bar("matching  ");
  for (uint32_t i = 0; i < frames.size(); ++i) {
    input.true_points.queries.push_back(matchedQuery(frames[i], map, input.points_m, centre_m));
    bar.show(i + 1, static_cast<uint32_t>(frames.size()));
  }
  input.true_points.eta_percent = 100;
  input.true_points.centre_world_m = centre_m;
  for (const double eta : options.etas)
    input.spheres.push_back(sphereOf(input, assignmentsOf(input.points_m, model, eta), eta));
  return input;
}

}  // namespace sphc::host
