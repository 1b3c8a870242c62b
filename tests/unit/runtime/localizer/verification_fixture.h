// Verification in the test room, for tests of its steps.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "runtime/localizer/tuning.h"
#include "runtime/localizer/verification.h"
#include "tests/support/pose_world.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc::test {

class VerificationTest : public testing::Test {
 protected:
  explicit VerificationTest(std::vector<SceneMap> maps) : parts_(std::move(maps)) {}
  VerificationTest() = default;

  PoseTask task() {
    PoseTask task;
    task.question = parts_.askAll();
    task.query.depth = parts_.config.depth_prior;
    task.query.seed = 1;
    task.solid_angle_sr = 4 * kPi;
    task.cones_rad = {tuning::kConesOfSearchedPose, 2};
    return task;
  }
  // Sees the room and matches the first keypoints everywhere.
  PoseTask seen(uint32_t viewpoint, uint32_t room = 0, uint32_t keypoints = UINT32_MAX) {
    parts_.see(viewpoint, room);
    const PoseTask task = this->task();
    found().begin(0);
    parts_.search.matchEverywhere(task.question, std::min(keypoints, parts_.front.keypointCount()), {},
                                  &found().matched, &parts_.work);
    return task;
  }
  void verify(const PoseTask &task) {
    Verification(&parts_.search, &parts_.estimator, &parts_.repetition, &parts_.fusion, min_inliers_, tracks_,
                 &parts_.work, &ranking_)
        .findPose(task, &found(), &parts_.rival);
  }
  double errorM(uint32_t viewpoint) {
    return translationErrorM(found().estimate.camera_from_map, parts_.cameraFromMap(viewpoint));
  }
  Hypothesis &found() { return parts_.found; }

  uint32_t min_inliers_ = 10;
  bool tracks_ = false;
  Ranking ranking_;
  RoomParts parts_;
};

}  // namespace sphc::test
