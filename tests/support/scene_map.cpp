#include "tests/support/scene_map.h"

#include "tests/support/arena_memory.h"
#include "tests/support/random_numbers.h"

namespace sphc::test {

ViewDescriber::ViewDescriber(const sphc_camera &camera, uint32_t keypoints)
    : aligner_(Camera{camera}, Camera{camera}, Rigid(), {0.001, 0.2, 6, 0.002, 0}),
      found_(keypoints),
      descriptors_(keypoints) {
  config_.width = static_cast<int32_t>(camera.width);
  config_.height = static_cast<int32_t>(camera.height);
  config_.max_keypoints = keypoints;
  Arena state_size, scratch_size;
  FeatureExtractor::layout(config_, state_size, scratch_size, nullptr);
  state_memory_.resize(state_size.used() + kArenaAlignment);
  scratch_memory_.resize(scratch_size.used() + kArenaAlignment);
  Arena state(alignedStart(&state_memory_)), scratch(alignedStart(&scratch_memory_));
  FeatureExtractor::layout(config_, state, scratch, &extractor_);
  extractor_.init();
}

void ViewDescriber::describe(const SceneImages &images, const Rigid &camera_from_world,
                             std::vector<WorldPoint> *points) {
  const GrayView gray = {images.gray.data(), config_.width, config_.height, config_.width};
  const ImageView<uint16_t> depth = {images.depth_mm.data(), config_.width, config_.height, config_.width};
  const uint32_t count =
      extractor_.extract(gray, {found_.data(), found_.size()}, {descriptors_.data(), found_.size()});
  for (uint32_t i = 0; i < count; ++i) {
    Vector3 point;
    double sigma = 0;
    if (aligner_.lift(depth, {static_cast<double>(found_[i].x_px), static_cast<double>(found_[i].y_px)}, &point,
                      &sigma))
      points->push_back({camera_from_world.inverse() * point, descriptors_[i]});
  }
}

std::vector<MapPoint> sphereCloud(const std::vector<WorldPoint> &points, const Vector3 &centre_in_world_m,
                                  double eta) {
  Random random(77);
  std::vector<MapPoint> cloud;
  for (const WorldPoint &p : points) {
    const Vector3 fake = randomDirection(&random);
    const bool real = random.uniform() < eta;
    cloud.push_back({real ? (p.position_m - centre_in_world_m).normalized() : fake, p.descriptor});
  }
  return cloud;
}

SceneMap makeSceneMap(const sphc_camera &camera, uint32_t keypoints, uint32_t views, double eta, uint32_t room) {
  ViewDescriber describer(camera, keypoints);
  std::vector<WorldPoint> points;
  for (uint32_t view = 0; view < views; ++view) {
    const Rigid camera_from_world = sceneViewpoint(view);
    describer.describe(renderScene(camera, camera, camera_from_world, Rigid(), room), camera_from_world, &points);
  }
  SceneMap map;
  map.centre_in_world_m = Vector3::Zero();
  for (const WorldPoint &p : points) map.centre_in_world_m += p.position_m / static_cast<double>(points.size());
  map.file = encodeMap(sphereCloud(points, map.centre_in_world_m, eta), kExtractorId);
  return map;
}

}  // namespace sphc::test
