// A sphere cloud of the test room, made by the runtime's own stages.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/stages/align/sparse.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/scene.h"

namespace sphc::test {

struct WorldPoint {
  Vector3 position_m;
  Descriptor descriptor;
};

// Lifts and describes the keypoints of images whose depth is registered to colour.
class ViewDescriber {
 public:
  ViewDescriber(const sphc_camera &camera, uint32_t keypoints);
  ViewDescriber(const ViewDescriber &) = delete;
  ViewDescriber &operator=(const ViewDescriber &) = delete;

  void describe(const SceneImages &images, const Rigid &camera_from_world, std::vector<WorldPoint> *points);

 private:
  FeatureConfig config_;
  std::vector<uint8_t> state_memory_, scratch_memory_;
  FeatureExtractor extractor_;
  SparseAligner aligner_;
  std::vector<Keypoint> found_;
  std::vector<Descriptor> descriptors_;
};

// A share `eta` of the points keeps its direction, the others get a random one.
std::vector<MapPoint> sphereCloud(const std::vector<WorldPoint> &points, const Vector3 &centre_in_world_m,
                                  double eta);

struct SceneMap {
  std::vector<uint8_t> file;
  Vector3 centre_in_world_m;
};

// Keypoints of viewpoints 0 to `views` - 1 with their exact directions, a share `eta` of them.
SceneMap makeSceneMap(const sphc_camera &camera, uint32_t keypoints, uint32_t views, double eta, uint32_t room = 0);

}  // namespace sphc::test
