#include "lab/compare/systems.h"

#include <memory>

#include "lab/baselines/pose_problems.h"
#include "lab/common/interleave.h"
#include "lab/pose/ours.h"

namespace sphc::host {
namespace {

constexpr uint64_t kCloudSeed = 20190616;
constexpr double kLineGatePx = 1.5, kPointGatePx = 4;

Vector2 keypointOf(const PinholeCamera &camera, const Vector2 &pixel_px) {
  return {(pixel_px.x() - camera.cx_px) / camera.fx_px, (pixel_px.y() - camera.cy_px) / camera.fy_px};
}

// In time of this thread, so that a run of half a second and one of a tenth of a millisecond are measured alike on
// a busy machine.
PoseAnswer timed(const PoseProblem &problem, double gate_px, uint64_t seed) {
  RobustPoseOptions options;
  options.gate_px = gate_px;
  const double begin = threadCpuSeconds();
  const RobustPose found = findPose(problem, options, seed);
  return {found.camera_from_map, found.iterations,  found.hypotheses,
          found.inliers,         found.inliers > 0, threadCpuSeconds() - begin};
}

PoseVariant pointSystem() {
  return {"point cloud", true,
          [](const PoseCase &c, uint64_t seed) {
            std::vector<PointPoseMatch> matches;
            for (size_t i = 0; i < c.true_pixels_px.size(); ++i)
              matches.push_back({keypointOf(c.camera, c.true_pixels_px[i]), c.true_points_map_m[i]});
            return timed(PointPoseProblem(std::move(matches), c.focalPx()), kPointGatePx, seed);
          },
          ""};
}

PoseVariant lineSystem(LineCloud cloud, const CompareInput &input) {
  const auto shared = std::make_shared<const LineCloud>(std::move(cloud));
  return {shared->name, true,
          [shared, places = input.place_of_id](const PoseCase &c, uint64_t seed) {
            std::vector<LineMatch> matches;
            for (size_t i = 0; i < c.true_pixels_px.size(); ++i) {
              const uint32_t line = shared->line_of_point[places.at(c.true_point_ids[i])];
              matches.push_back({keypointOf(c.camera, c.true_pixels_px[i]), shared->lines[line],
                                 shared->group_of_line.empty() ? 0 : shared->group_of_line[line]});
            }
            return timed(LinePoseProblem(std::move(matches), c.focalPx()), kLineGatePx, seed);
          },
          ""};
}

// One of the library's estimators on the directions of a sphere cloud.
PoseVariant sphereSystem(const std::string &estimator, const std::string &name, std::vector<PoseCase> cases) {
  const auto shared = std::make_shared<const std::vector<PoseCase>>(std::move(cases));
  for (const PoseVariant &variant : ourVariants()) {
    if (variant.name != estimator) continue;
    return {name, false,
            [shared, run = variant.run](const PoseCase &c, uint64_t seed) {
              const double begin = threadCpuSeconds();
              PoseAnswer answer = run(shared->at(c.index), seed);
              answer.seconds = threadCpuSeconds() - begin;
              return answer;
            },
            ""};
  }
  return {name, false, nullptr, "the bench has no estimator named " + estimator};
}

}  // namespace

std::string sphereName(uint32_t eta_percent) { return "sphere cloud, eta " + std::to_string(eta_percent) + " %"; }

std::vector<LineCloud> lineCloudsOf(const std::vector<Vector3> &points_m) {
  return {uniformLineCloud(points_m, kCloudSeed), pairedLineCloud(points_m, kCloudSeed),
          pairedLineCloudPlus(points_m, kCloudSeed), rayCloud(points_m, kCloudSeed)};
}

std::vector<PoseCase> compareCases(const CompareInput &input, DepthSource source) {
  return makePoseCases(input.true_points, source, noiseFor(source), input.true_points);
}

std::vector<PoseVariant> compareSystems(const CompareInput &input, DepthSource source) {
  std::vector<PoseVariant> systems = {pointSystem()};
  for (LineCloud &cloud : lineCloudsOf(input.points_m)) systems.push_back(lineSystem(std::move(cloud), input));
  for (const ComparedSphere &sphere : input.spheres) {
    const std::vector<PoseCase> cases = makePoseCases(sphere.queries, source, noiseFor(source), {});
    const std::string name = sphereName(sphere.queries.eta_percent);
    systems.push_back(sphereSystem("ours", name, cases));
    systems.push_back(sphereSystem("paper", name + ", paper's estimator", cases));
  }
  return systems;
}

}  // namespace sphc::host
