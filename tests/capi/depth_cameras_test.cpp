// A second depth camera of a rig, and calibrations of depth cameras that change, through the C interface.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "tests/capi/answers.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::Rigid;
using sphc::Vector3;
using sphc::test::expectMentions;
using sphc::test::observationsOf;
using sphc::test::SceneFrame;
using sphc::test::Session;

constexpr uint32_t kSeenFrom = 1;

// The room's cameras, but the first depth camera sees the middle alone; a second one sees all, from elsewhere.
struct DepthRig {
  DepthRig() {
    config.rig.depth_camera = sphc::test::pinhole(96, 72, 300);
    EXPECT_EQ(sphc_localizer_depth_camera_init(&second, sizeof second), SPHC_OK);
    second.camera = sphc::test::pinhole(240, 180, 170);
    second.color_from_depth = sphc::rigidToC({sphc::rotationFromVector({0, 0.1, 0}), Vector3(-0.06, 0.01, 0)});
    second.unit_m = config.rig.depth_unit_m;
    config.depth_cameras = &second;
    config.depth_camera_count = 1;
  }
  DepthRig(const DepthRig &) = delete;

  sphc_localizer_config config = sphc::test::sceneConfig();
  sphc_localizer_depth_camera second;
};

struct DepthFrame {
  // The second camera says `offset_m` more than is true, and measured so many viewpoints before the first.
  DepthFrame(const DepthRig &rig, uint32_t viewpoint, double offset_m = 0, double late_by = 0)
      : made(sphc::test::sceneFrame(rig.config, viewpoint)),
        second(sphc::test::renderScene(rig.config.rig.color_camera, rig.second.camera,
                                       sphc::test::sceneViewpoint(viewpoint - late_by),
                                       sphc::rigidFromC(rig.second.color_from_depth))) {
    for (uint16_t &mm : second.depth_mm)
      if (mm) mm = static_cast<uint16_t>(mm + 1000 * offset_m);
    EXPECT_EQ(sphc_localizer_depth_view_init(&view, sizeof view), SPHC_OK);
    const sphc_camera &camera = rig.second.camera;
    view.time_ns = made->frame.depth_time_ns;
    view.depth = {second.depth_mm.data(), camera.width, camera.height, 2 * camera.width, SPHC_FORMAT_DEPTH16};
    made->frame.depth_views = &view;
    made->frame.depth_view_count = 1;
  }
  DepthFrame(const DepthFrame &) = delete;
  sphc_localizer_frame &frame() { return made->frame; }

  std::unique_ptr<SceneFrame> made;
  sphc::test::SceneImages second;
  sphc_localizer_depth_view view;
};

sphc_localizer_result resultOf(Session *session, const sphc_localizer_frame &frame) {
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_GE(session->process(frame, &result), SPHC_OK) << sphc_localizer_message(session->localizer());
  return result;
}

TEST(DepthCameras, TheSecondLiftsWhatTheFirstDoesNotSee) {
  const DepthRig rig;
  DepthFrame made(rig, kSeenFrom);
  Session both(rig.config);
  const sphc_localizer_result with = resultOf(&both, made.frame());
  made.view.depth.data = nullptr;
  Session one(rig.config);
  const sphc_localizer_result without = resultOf(&one, made.frame());
  ASSERT_EQ(with.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_LT(both.errorM(with, kSeenFrom), 0.02);
  EXPECT_GT(with.lifted, 3 * without.lifted);
  EXPECT_GT(with.inliers, 2 * without.inliers);
}

TEST(DepthCameras, WithoutAnImageTheSecondIsAsIfItWereNotThere) {
  const DepthRig rig;
  DepthFrame made(rig, kSeenFrom);
  made.view.depth.data = nullptr;
  Session both(rig.config);
  const sphc_localizer_result with = resultOf(&both, made.frame());
  sphc_localizer_config alone = rig.config;
  alone.depth_cameras = nullptr;
  alone.depth_camera_count = 0;
  made.frame().depth_views = nullptr;
  made.frame().depth_view_count = 0;
  Session one(alone);
  const sphc_localizer_result without = resultOf(&one, made.frame());
  EXPECT_EQ(std::memcmp(&with, &without, sizeof with), 0);
}

// Mean difference of the depths of two sessions at the same keypoints, where the first depth camera is blind.
double differenceM(Session *a, Session *b) {
  const auto first = observationsOf(a), second = observationsOf(b);
  double sum = 0, count = 0;
  for (size_t i = 0; i < first.size() && i < second.size(); ++i) {
    const bool lifted = first[i].flags & second[i].flags & SPHC_OBSERVATION_LIFTED;
    const bool in_the_middle = first[i].x_px > 90 && first[i].x_px < 250;
    if (!lifted || in_the_middle) continue;
    sum += static_cast<double>(first[i].depth_m) - static_cast<double>(second[i].depth_m);
    ++count;
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

TEST(DepthCameras, HowTheSecondIsOffIsLearntWhereBothMeasure) {
  constexpr double kOffM = 0.03;
  DepthRig rig;
  rig.second.offset_sigma_m = 0.03;
  DepthRig believed;
  believed.second.offset_sigma_m = believed.second.slope_sigma = 0;
  const DepthRig exact;
  Session learning(rig.config), believing(believed.config), right(exact.config);
  double first_m = 0, last_m = 0, believed_m = 0;
  for (uint32_t i = 0; i < 6; ++i) {
    DepthFrame off(rig, i % 3, kOffM), good(exact, i % 3);
    resultOf(&learning, off.frame());
    resultOf(&believing, off.frame());
    resultOf(&right, good.frame());
    last_m = differenceM(&learning, &right);
    believed_m = differenceM(&believing, &right);
    if (i == 0) first_m = last_m;
  }
  EXPECT_LT(first_m, 0.8 * kOffM) << "within one frame";
  EXPECT_LT(last_m, 0.3 * kOffM);
  EXPECT_GT(last_m, -0.3 * kOffM);
  EXPECT_NEAR(believed_m, kOffM, 0.2 * kOffM) << "what is said to measure alike is believed";
}

// Rows are taken to one time by the depth of each keypoint, which is looked up once more for its place.
TEST(DepthCameras, ARollingShutterTeachesEachMeasurementOnce) {
  DepthRig rig;
  rig.second.offset_sigma_m = 0.03;
  DepthRig rolling;
  rolling.second.offset_sigma_m = 0.03;
  rolling.config.color_row_time_ns = 1;  // and nothing moves
  Session at_once(rig.config), by_rows(rolling.config);
  for (uint32_t i = 0; i < 3; ++i) {
    DepthFrame off(rig, i, 0.03);
    resultOf(&at_once, off.frame());
    resultOf(&by_rows, off.frame());
    EXPECT_NEAR(differenceM(&at_once, &by_rows), 0, 1e-6) << "frame " << i;
  }
}

TEST(DepthCameras, OdometryTakesALateSecondToTheTimeOfColour) {
  constexpr int64_t kStepNs = 33000000;
  DepthRig rig;
  rig.config.mode = SPHC_MODE_TRACKING;
  rig.second.offset_sigma_m = rig.second.slope_sigma = 0;  // how it is off must not make up for when it measured
  const auto errorWith = [&](bool is_told) {
    Session session(rig.config);
    double error_m = 0;
    for (uint32_t i = 1; i < 4; ++i) {
      DepthFrame made(rig, i, 0, 0.5);
      sphc_localizer_prior prior;
      sphc_localizer_prior_init(&prior, sizeof prior);
      prior.flags = SPHC_PRIOR_ODOMETRY;
      prior.odometry_from_camera = sphc::rigidToC(sphc::test::sceneViewpoint(i).inverse());
      prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 1e-3;
      made.frame().prior = &prior;
      made.frame().color_time_ns = made.frame().depth_time_ns = i * kStepNs;
      made.view.time_ns = i * kStepNs - (is_told ? kStepNs / 2 : 0);
      const sphc_localizer_result result = resultOf(&session, made.frame());
      if (result.outcome != SPHC_OUTCOME_LOCALIZED) return 1.0;
      error_m = session.errorM(result, i);
    }
    return error_m;
  };
  EXPECT_LT(errorWith(true), 0.01);
  EXPECT_GT(errorWith(false), 2 * errorWith(true));
}

TEST(DepthCameras, HalvesAnswerTheSame) {
  const DepthRig rig;
  DepthFrame made(rig, kSeenFrom);
  Session whole(rig.config), halves(rig.config);
  const sphc_localizer_result expected = resultOf(&whole, made.frame());
  sphc_memory need = {};
  ASSERT_EQ(sphc_features_memory(&rig.config, &need, nullptr), SPHC_OK);
  sphc::test::GuardedMemory memory(need.state_bytes, need.alignment);
  sphc_features *features = nullptr;
  ASSERT_EQ(sphc_features_init(memory.data(), memory.size(), &rig.config, &features, nullptr), SPHC_OK);
  // The first half does not look at depth, nor at what is said of it.
  sphc_localizer_frame of_color = made.frame();
  const sphc_camera none = {};
  of_color.depth_camera = &none;
  of_color.depth_view_count = 7;
  ASSERT_EQ(sphc_localizer_extract(halves.localizer(), &of_color, features), SPHC_OK);
  sphc_localizer_result answer = spherecloud::emptyResult();
  ASSERT_EQ(sphc_localizer_locate(halves.localizer(), &made.frame(), features, &answer), SPHC_OK);
  EXPECT_EQ(std::memcmp(&answer, &expected, sizeof answer), 0);
}

// Where heat has changed a depth camera, the frame says so.
TEST(DepthCameras, CalibrationOfAFrameReplacesTheConfigs) {
  const DepthRig rig;
  DepthRig vague;
  vague.config.rig.depth_camera.params[0] *= 1.5;
  vague.second.camera.params[2] += 20;
  vague.second.color_from_depth.t_m[1] += 0.2;
  DepthFrame made(rig, kSeenFrom);
  Session right(rig.config), wrong(vague.config), told(vague.config);
  const sphc_localizer_result expected = resultOf(&right, made.frame());
  EXPECT_NE(resultOf(&wrong, made.frame()).inliers, expected.inliers);
  made.frame().depth_camera = &rig.config.rig.depth_camera;
  made.view.camera = &rig.second.camera;
  made.view.color_from_depth = &rig.second.color_from_depth;
  const sphc_localizer_result result = resultOf(&told, made.frame());
  EXPECT_EQ(result.inliers, expected.inliers);
  EXPECT_EQ(
      std::memcmp(result.camera_from_map.t_m, expected.camera_from_map.t_m, sizeof expected.camera_from_map.t_m),
      0);
}

TEST(DepthCameras, FaintMeasurementsOfTheSecondAreIgnored) {
  DepthRig rig;
  rig.second.amplitude_min = 50;
  DepthFrame made(rig, kSeenFrom);
  const sphc_camera &camera = rig.second.camera;
  std::vector<uint8_t> amplitude(camera.width * camera.height, 200);
  made.view.amplitude = {amplitude.data(), camera.width, camera.height, camera.width, SPHC_FORMAT_GRAY8};
  Session bright(rig.config), faint(rig.config);
  const uint32_t all = resultOf(&bright, made.frame()).lifted;
  std::fill(amplitude.begin(), amplitude.end(), uint8_t{20});
  EXPECT_LT(3 * resultOf(&faint, made.frame()).lifted, all);
}

struct BadDepthConfig {
  const char *what;
  void (*spoil)(DepthRig *);
  sphc_status status;
  std::vector<const char *> says;
};

TEST(DepthCameras, ABadConfigIsRefusedWithItsCause) {
  static const double nan = std::numeric_limits<double>::quiet_NaN();
  const BadDepthConfig cases[] = {
      {"too many",
       [](DepthRig *r) { r->config.depth_camera_count = SPHC_DEPTH_CAMERAS_MAX; },
       SPHC_E_ARGUMENT,
       {"config.depth_camera_count is 2", "1 to 1"}},
      {"null",
       [](DepthRig *r) { r->config.depth_cameras = nullptr; },
       SPHC_E_ARGUMENT,
       {"config.depth_cameras is null"}},
      {"size", [](DepthRig *r) { r->second.struct_size = 4; }, SPHC_E_STRUCT_SIZE, {"config.depth_cameras"}},
      {"reserved", [](DepthRig *r) { r->second.reserved = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
      {"reserved of the config", [](DepthRig *r) { r->config.reserved5 = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
      {"camera", [](DepthRig *r) { r->second.camera.params[0] = nan; }, SPHC_E_ARGUMENT, {"i = 0", "[i].camera"}},
      {"mount",
       [](DepthRig *r) { r->second.color_from_depth.t_m[0] = nan; },
       SPHC_E_ARGUMENT,
       {"color_from_depth"}},
      {"unit", [](DepthRig *r) { r->second.unit_m = 0; }, SPHC_E_ARGUMENT, {"config.depth_cameras[i].unit_m is 0"}},
      {"range", [](DepthRig *r) { r->second.max_m = 0.2; }, SPHC_E_ARGUMENT, {"depth_cameras[i].max_m is 0.2"}},
      {"noise", [](DepthRig *r) { r->second.sigma_m = 0; }, SPHC_E_ARGUMENT, {"depth_cameras[i].sigma_m is 0"}},
      {"growth of noise", [](DepthRig *r) { r->second.sigma_per_m2 = nan; }, SPHC_E_ARGUMENT, {"sigma_per_m2"}},
      {"bias",
       [](DepthRig *r) { r->second.slope_sigma = 0; },
       SPHC_E_ARGUMENT,
       {"depth_cameras[i].slope_sigma", "both"}},
      {"amplitude",
       [](DepthRig *r) { r->second.amplitude_min = 70000; },
       SPHC_E_ARGUMENT,
       {"amplitude_min is 70000"}},
      {"format",
       [](DepthRig *r) { r->second.format = SPHC_FORMAT_GRAY8; },
       SPHC_E_ARGUMENT,
       {"depth_cameras[i].format is 1", "not of depth"}},
      {"width",
       [](DepthRig *r) {
         r->second.camera = sphc::test::pinhole(241, 180, 170);
         r->second.format = SPHC_FORMAT_DEPTH12P;
       },
       SPHC_E_ARGUMENT,
       {"share bytes", "241"}},
  };
  for (const BadDepthConfig &bad : cases) {
    SCOPED_TRACE(bad.what);
    DepthRig rig;
    bad.spoil(&rig);
    sphc_memory need = {};
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_memory(&rig.config, &need, &message), bad.status);
    for (const char *words : bad.says) expectMentions(message.text, words);
  }
}

struct BadDepthFrame {
  const char *what;
  void (*spoil)(DepthFrame *);
  sphc_status status;
  std::vector<const char *> says;
};

TEST(DepthCameras, ABadFrameIsRefusedWithItsCause) {
  static const sphc_camera other = sphc::test::pinhole(320, 240, 300);
  static const sphc_rigid bent = {{1, 1, 0, 0}, {0, 0, 0}};
  const BadDepthFrame cases[] = {
      {"none",
       [](DepthFrame *f) { f->frame().depth_views = nullptr, f->frame().depth_view_count = 0; },
       SPHC_E_ARGUMENT,
       {"frame.depth_view_count is 0", "config.depth_camera_count is 1"}},
      {"null", [](DepthFrame *f) { f->frame().depth_views = nullptr; }, SPHC_E_ARGUMENT, {"depth_views is null"}},
      {"size", [](DepthFrame *f) { f->view.struct_size = 0; }, SPHC_E_STRUCT_SIZE, {"struct_size"}},
      {"reserved", [](DepthFrame *f) { f->view.reserved = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
      {"reserved of the frame", [](DepthFrame *f) { f->frame().reserved4 = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
      {"image", [](DepthFrame *f) { f->view.depth.width = 96; }, SPHC_E_IMAGE, {"i = 0", "depth", "240"}},
      {"stride", [](DepthFrame *f) { f->view.depth.stride_bytes = 240; }, SPHC_E_IMAGE, {"stride of 240"}},
      {"format",
       [](DepthFrame *f) { f->view.depth.format = SPHC_FORMAT_RANGE16; },
       SPHC_E_IMAGE,
       {"as config.depth_cameras[i].format says"}},
      {"no amplitude",
       [](DepthFrame *) {},
       SPHC_E_IMAGE,
       {"amplitude image is missing", "config.depth_cameras[i].amplitude_min"}},
      {"camera", [](DepthFrame *f) { f->view.camera = &other; }, SPHC_E_ARGUMENT, {"depth_views[i].camera", "240"}},
      {"mount", [](DepthFrame *f) { f->view.color_from_depth = &bent; }, SPHC_E_ARGUMENT, {"color_from_depth"}},
      {"first camera",
       [](DepthFrame *f) { f->frame().depth_camera = &other; },
       SPHC_E_ARGUMENT,
       {"frame.depth_camera"}},
  };
  for (const BadDepthFrame &bad : cases) {
    SCOPED_TRACE(bad.what);
    DepthRig rig;
    if (std::strcmp(bad.what, "no amplitude") == 0) rig.second.amplitude_min = 10;
    Session session(rig.config);
    DepthFrame made(rig, kSeenFrom);
    bad.spoil(&made);
    sphc_localizer_result result = spherecloud::emptyResult();
    EXPECT_EQ(session.process(made.frame(), &result), bad.status);
    for (const char *words : bad.says) expectMentions(sphc_localizer_message(session.localizer()), words);
  }
}

TEST(DepthCameras, AnImageInsideTheLocalizersMemoryIsRefused) {
  const DepthRig rig;
  Session session(rig.config);
  DepthFrame made(rig, kSeenFrom);
  made.view.depth.data = session.scratch().data();
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_EQ(session.process(made.frame(), &result), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(session.localizer()), "scratch memory overlaps");
}

TEST(DepthCameras, BoundsOfMemoryHold) {
  for (const uint32_t side : {32u, 480u, 1024u}) {
    DepthRig rig;
    rig.second.camera = sphc::test::pinhole(side, side, 300);
    const uint32_t n = rig.config.max_keypoints;
    for (const bool in_place : {true, false}) {
      if (!in_place) rig.second.format = SPHC_FORMAT_RANGE16;
      sphc_memory need = {};
      ASSERT_EQ(sphc_localizer_memory(&rig.config, &need, nullptr), SPHC_OK);
      const uint64_t more = SPHC_LOCALIZER_DEPTH_CAMERA_BYTES_MAX(side, side) +
                            (in_place ? 0 : SPHC_LOCALIZER_DEPTH_BYTES_MAX(side, side));
      EXPECT_LE(need.state_bytes, SPHC_LOCALIZER_STATE_BYTES_MAX(n, rig.config.max_maps) + more);
      EXPECT_LE(need.scratch_bytes, SPHC_LOCALIZER_SCRATCH_BYTES_MAX(n, 320, 240) + more);
    }
  }
}

}  // namespace
