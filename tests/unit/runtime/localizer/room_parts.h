// What a localizer is composed of, each part open to a test: in the test room, and in memory of its own.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/capi/translate.h"
#include "runtime/localizer/verification.h"
#include "tests/support/arena_memory.h"
#include "tests/support/session.h"

namespace sphc::test {

class RoomParts {
 public:
  // A share `eta` of the points of each room's map is real.
  explicit RoomParts(double eta = 0.5, uint32_t rooms = 1) : RoomParts(roomMaps(eta, rooms)) {}
  explicit RoomParts(std::vector<SceneMap> maps)
      : maps_(std::move(maps)),
        config(localizerConfigFrom(sceneConfig())),
        memory_([this](Arena &arena, bool real) { layout(arena, real); }) {
    front.init(config);
    search.init(config);
    for (const SceneMap &map : maps_) {
      MapView view;
      EXPECT_EQ(MapView::open(map.file.data(), map.file.size(), kExtractorId, &view, nullptr), SPHC_OK);
      search.maps().set(search.maps().count(), view);
    }
  }
  RoomParts(const RoomParts &) = delete;
  RoomParts &operator=(const RoomParts &) = delete;

  // Makes a frame of this viewpoint the one that is asked about.  Its depth has a hole at the left, so that some
  // keypoints are rays.
  void see(uint32_t viewpoint, uint32_t room = 0) { see(*sceneFrame(sceneConfig(), viewpoint, room)); }
  // The upper half, or another share, as one viewpoint sees it, the lower one as another one does.
  // Of `columns` alone, shares of the width; the rest is blank.
  void seeHalves(uint32_t upper, uint32_t lower, double upper_share = 0.5,
                 const std::pair<double, double> &columns = {0, 1}) {
    const auto made = sceneFrame(sceneConfig(), upper), other = sceneFrame(sceneConfig(), lower);
    const auto copyLower = [&](const auto &from, auto *to) {
      const auto begin = static_cast<ptrdiff_t>(upper_share * static_cast<double>(from.size()));
      std::copy(from.begin() + begin, from.end(), to->begin() + begin);
    };
    copyLower(other->images.gray, &made->images.gray);
    copyLower(other->images.depth_mm, &made->images.depth_mm);
    const uint32_t width = made->frame.color.width;
    for (size_t i = 0; i < made->images.gray.size(); ++i) {
      const double x = (static_cast<double>(i % width) + 0.5) / width;
      if (x < columns.first || x > columns.second) made->images.gray[i] = 128;
    }
    see(*made);
  }
  // A wall 2 m ahead, whose upper `rows` have a piece of what the viewpoint sees over and over, `period_px` wide;
  // all copies but the middle one a little worse: brighter by less than `levels`.
  void seeRepeated(uint32_t viewpoint, uint32_t period_px, uint32_t rows = UINT32_MAX, uint32_t levels = 12) {
    const auto made = sceneFrame(sceneConfig(), viewpoint);
    const std::vector<uint8_t> seen = made->images.gray;
    const uint32_t width = made->frame.color.width, middle = width / period_px / 2;
    Random random(1);
    for (size_t i = 0; i < std::min(seen.size(), size_t{rows} * width); ++i) {
      const size_t x = i % width, row = i - x;
      const uint8_t level = seen[row + middle * period_px + x % period_px];
      const bool exact = x / period_px == middle;
      made->images.gray[i] = exact ? level : static_cast<uint8_t>(std::min(255u, level + random.below(levels)));
    }
    std::fill(made->images.depth_mm.begin(), made->images.depth_mm.end(), uint16_t{2000});
    see(*made);
  }
  void see(SceneFrame &made) {
    const auto width = static_cast<ptrdiff_t>(made.frame.depth.width);
    for (auto row = made.images.depth_mm.begin(); row != made.images.depth_mm.end(); row += width)
      std::fill_n(row, width / 8, uint16_t{0});
    const FrameInput frame = frameFrom(made.frame, MapSet());
    front.extract(frame.color, frame.further);
    lift(made.images.depth_mm);
  }
  // By the cameras of the config.
  void lift(const std::vector<uint16_t> &depth_mm) {
    const RigDepthCamera &camera = config.depth[0];
    FrameRig rig;
    rig.color_camera = config.color_camera;
    rig.depth.push({camera.camera, camera.color_from_depth});
    DepthImages images;
    images.push({depth_mm.data(), camera.camera.width(), camera.camera.height(), camera.camera.width()});
    front.lift(images, rig);
  }
  // The truth.
  Rigid cameraFromMap(uint32_t viewpoint, uint32_t room = 0) const {
    return sceneViewpoint(viewpoint) * Rigid{Matrix3::Identity(), maps_[room].centre_in_world_m};
  }
  Search::Question askAll(uint32_t map = 0) {
    return search.ask(front, map, front.keypointCount(), config.search.probes, &work);
  }
  // The angle between a match's map point and where the keypoint lies when the camera is there.
  double angleOff(const Correspondence &c, const Rigid &camera_from_map) const {
    const Vector3 expected = (camera_from_map.inverse() * c.lifted.point_m).normalized();
    return std::acos(std::min(1.0, expected.dot(c.direction.normalized())));
  }

 private:
  // Made once: that takes a third of a second each.
  static std::vector<SceneMap> roomMaps(double eta, uint32_t rooms) {
    static std::map<std::pair<double, uint32_t>, SceneMap> made;
    const sphc_localizer_config config = sceneConfig();
    std::vector<SceneMap> maps;
    for (uint32_t room = 0; room < rooms; ++room) {
      SceneMap &map = made[{eta, room}];
      if (map.file.empty()) map = makeSceneMap(config.rig.color_camera, config.max_keypoints, 3, eta, room);
      maps.push_back(map);
    }
    return maps;
  }
  void layout(Arena &arena, bool real) {
    Fusion::layout(config.max_keypoints, arena, real ? &fusion : nullptr);
    FrontEnd::layout(config, arena, arena, real ? &front : nullptr);
    Search::layout(config, arena, arena, real ? &search : nullptr);
    for (Hypothesis *hypothesis : {&found, &rival})
      MatchSet::layout(config.max_keypoints, arena, real ? &hypothesis->matched : nullptr);
    Repetition::layout(config.max_keypoints, config.parallel, arena, real ? &repetition : nullptr);
    EstimatorConfig of_estimator;
    of_estimator.capacity = 2 * config.max_keypoints;
    of_estimator.max_iterations = config.search.max_iterations;
    PoseEstimator::layout(of_estimator, arena, real ? &estimator : nullptr);
  }

  std::vector<SceneMap> maps_;

 public:
  LocalizerConfig config;
  FrontEnd front;
  Search search;
  PoseEstimator estimator;
  Repetition repetition;
  Fusion fusion;
  Hypothesis found, rival;
  Work work;

 private:
  ArenaMemory memory_;
};

}  // namespace sphc::test
