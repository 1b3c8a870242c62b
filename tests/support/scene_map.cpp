#include "tests/support/scene_map.h"

#include "runtime/stages/align/sparse.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"

namespace sphc::test {
namespace {

void *alignedStart(std::vector<uint8_t> *memory) {
  const auto address = reinterpret_cast<uintptr_t>(memory->data());
  return memory->data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment;
}

struct WorldPoint {
  Vector3 position_m;
  Descriptor descriptor;
};

std::vector<WorldPoint> describeViews(const sphc_camera &camera, uint32_t keypoints, uint32_t views,
                                      uint32_t room) {
  FeatureConfig config;
  config.width = static_cast<int32_t>(camera.width);
  config.height = static_cast<int32_t>(camera.height);
  config.max_keypoints = keypoints;
  Arena state_size, scratch_size;
  FeatureExtractor::layout(config, state_size, scratch_size, nullptr);
  std::vector<uint8_t> state_memory(state_size.used() + 64), scratch_memory(scratch_size.used() + 64);
  Arena state(alignedStart(&state_memory)), scratch(alignedStart(&scratch_memory));
  FeatureExtractor extractor;
  FeatureExtractor::layout(config, state, scratch, &extractor);
  extractor.init();

  const Camera model{camera};
  const SparseAligner aligner(model, model, Rigid(), {0.001, 0.2, 6, 0.002, 0});
  std::vector<Keypoint> found(keypoints);
  std::vector<Descriptor> descriptors(keypoints);
  std::vector<WorldPoint> points;
  for (uint32_t view = 0; view < views; ++view) {
    const Rigid camera_from_world = sceneViewpoint(view);
    const SceneImages images = renderScene(camera, camera, camera_from_world, Rigid(), room);
    const GrayView gray = {images.gray.data(), config.width, config.height, config.width};
    const ImageView<uint16_t> depth = {images.depth_mm.data(), config.width, config.height, config.width};
    const uint32_t count = extractor.extract(gray, {found.data(), keypoints}, {descriptors.data(), keypoints});
    for (uint32_t i = 0; i < count; ++i) {
      Vector3 point;
      double sigma = 0;
      if (!aligner.lift(depth, {static_cast<double>(found[i].x_px), static_cast<double>(found[i].y_px)}, &point,
                        &sigma))
        continue;
      points.push_back({camera_from_world.inverse() * point, descriptors[i]});
    }
  }
  return points;
}

}  // namespace

SceneMap makeSceneMap(const sphc_camera &camera, uint32_t keypoints, uint32_t views, double eta, uint32_t room) {
  const std::vector<WorldPoint> points = describeViews(camera, keypoints, views, room);
  SceneMap map;
  map.centre_in_world_m = Vector3::Zero();
  for (const WorldPoint &p : points) map.centre_in_world_m += p.position_m / static_cast<double>(points.size());
  Random random(77);
  std::vector<MapPoint> cloud;
  for (const WorldPoint &p : points) {
    const Vector3 fake = randomDirection(&random);
    const bool real = random.uniform() < eta;
    cloud.push_back({real ? (p.position_m - map.centre_in_world_m).normalized() : fake, p.descriptor});
  }
  map.file = encodeMap(cloud, kExtractorId);
  return map;
}

}  // namespace sphc::test
