// Further cameras of a rig through the C interface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tests/capi/answers.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::Rigid;
using sphc::Vector3;
using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::observationsOf;
using sphc::test::SceneFrame;
using sphc::test::Session;

constexpr uint32_t kViewpoint = 1;

sphc_localizer_camera cameraAt(const sphc_camera &camera, double turn_rad, const Vector3 &centre_m) {
  sphc_localizer_camera out;
  EXPECT_EQ(sphc_localizer_camera_init(&out, sizeof out), SPHC_OK);
  out.camera = camera;
  out.color_from_camera = sphc::rigidToC({sphc::rotationFromVector(turn_rad * Vector3::UnitY()), centre_m});
  return out;
}

// A rig of three cameras: the room's own, a larger one to the left and a smaller one to the right.
struct Rig {
  Rig() {
    cameras = {cameraAt(sphc::test::pinhole(400, 304, 300), -0.5, {-0.08, 0.01, -0.02}),
               cameraAt(sphc::test::pinhole(256, 208, 200), 0.4, {0.07, 0.0, -0.03})};
    config = sphc::test::sceneConfig();
    config.cameras = cameras.data();
    config.camera_count = static_cast<uint32_t>(cameras.size());
  }

  std::vector<sphc_localizer_camera> cameras;
  sphc_localizer_config config;
};

struct RigFrame {
  RigFrame(const Rig &rig, uint32_t viewpoint) : color(sphc::test::sceneFrame(rig.config, viewpoint)) {
    for (const sphc_localizer_camera &further : rig.cameras) {
      const Rigid color_from_camera = sphc::rigidFromC(further.color_from_camera);
      images.push_back(sphc::test::renderScene(further.camera, rig.config.rig.depth_camera,
                                               color_from_camera.inverse() * sphc::test::sceneViewpoint(viewpoint),
                                               Rigid()));
      sphc_localizer_view view;
      EXPECT_EQ(sphc_localizer_view_init(&view, sizeof view), SPHC_OK);
      view.time_ns = color->frame.color_time_ns;
      view.image = {images.back().gray.data(), further.camera.width, further.camera.height, further.camera.width,
                    SPHC_FORMAT_GRAY8};
      views.push_back(view);
    }
    frame = color->frame;
    frame.views = views.data();
    frame.view_count = static_cast<uint32_t>(views.size());
  }

  std::unique_ptr<SceneFrame> color;
  std::vector<sphc::test::SceneImages> images;
  std::vector<sphc_localizer_view> views;
  sphc_localizer_frame frame;
};

TEST(Cameras, AllOfThemLocalize) {
  const Rig rig;
  Session session(rig.config);
  const RigFrame made(rig, kViewpoint);
  sphc_localizer_result result = spherecloud::emptyResult();
  ASSERT_EQ(session.process(made.frame, &result), SPHC_OK);
  EXPECT_LT(session.errorM(result, kViewpoint), 0.02);
  uint32_t seen[3] = {}, lifted[3] = {}, inliers[3] = {};
  for (const sphc_localizer_observation &o : observationsOf(&session)) {
    ASSERT_LT(o.camera, 3u);
    ++seen[o.camera];
    lifted[o.camera] += (o.flags & SPHC_OBSERVATION_LIFTED) != 0;
    inliers[o.camera] += (o.flags & SPHC_OBSERVATION_INLIER) != 0;
    const sphc_camera &camera = o.camera ? rig.cameras[o.camera - 1].camera : rig.config.rig.color_camera;
    EXPECT_LT(o.x_px, static_cast<float>(camera.width));
    EXPECT_LT(o.y_px, static_cast<float>(camera.height));
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(seen[i], 50u) << "camera " << i;
    EXPECT_GT(inliers[i], 5u) << "camera " << i;
    EXPECT_GT(lifted[i], 20u) << "camera " << i;
  }
  EXPECT_LT(lifted[1] + lifted[2], seen[1] + seen[2]) << "they see nothing that the depth camera does not";
}

// The colour camera looks at nothing; the pose is its own all the same.
TEST(Cameras, TheOthersLocalizeWhereTheColourCameraIsBlind) {
  const Rig rig;
  Session session(rig.config);
  RigFrame made(rig, kViewpoint);
  std::fill(made.color->images.gray.begin(), made.color->images.gray.end(), uint8_t{90});
  sphc_localizer_result result = spherecloud::emptyResult();
  ASSERT_EQ(session.process(made.frame, &result), SPHC_OK);
  EXPECT_LT(session.errorM(result, kViewpoint), 0.03);
  for (const sphc_localizer_observation &o : observationsOf(&session)) EXPECT_NE(o.camera, 0u);
}

// Those of further cameras would be doubted for what is wrong with another's calibration.
TEST(Cameras, TheColourCameraAloneIsAskedForItsFocalLength) {
  const Rig seen;
  for (const bool is_color_wrong : {true, false}) {
    Rig stated;
    std::vector<sphc_camera *> wrong = {&stated.config.rig.color_camera, &stated.config.rig.depth_camera};
    if (!is_color_wrong) wrong = {&stated.cameras[0].camera, &stated.cameras[1].camera};
    for (sphc_camera *camera : wrong)
      for (int i = 0; i < 2; ++i) camera->params[i] *= 0.85;
    Session session(stated.config);
    const RigFrame made(seen, kViewpoint);
    sphc_localizer_result result = spherecloud::emptyResult();
    EXPECT_EQ(session.process(made.frame, &result), SPHC_OK);
    EXPECT_EQ(result.faults, is_color_wrong ? uint32_t{SPHC_FAULT_FOCAL_DISAGREES} : 0u);
    EXPECT_EQ(result.confidence <= 0.5, is_color_wrong) << result.confidence;
  }
}

TEST(Cameras, OneWithoutAnImageIsLeftOut) {
  const Rig rig;
  Session session(rig.config);
  RigFrame made(rig, kViewpoint);
  made.views[0].image.data = nullptr;
  sphc_localizer_result result = spherecloud::emptyResult();
  ASSERT_EQ(session.process(made.frame, &result), SPHC_OK);
  bool has_second = false;
  for (const sphc_localizer_observation &o : observationsOf(&session)) {
    EXPECT_NE(o.camera, 1u);
    has_second |= o.camera == 2;
  }
  EXPECT_TRUE(has_second);
}

TEST(Cameras, KeypointsComeStrongestFirst) {
  const Rig rig;
  const RigFrame made(rig, kViewpoint);
  Session session(rig.config);
  sphc_memory need = {};
  ASSERT_EQ(sphc_features_memory(&rig.config, &need, nullptr), SPHC_OK);
  GuardedMemory memory(need.state_bytes, need.alignment);
  sphc_features *features = nullptr;
  ASSERT_EQ(sphc_features_init(memory.data(), memory.size(), &rig.config, &features, nullptr), SPHC_OK);
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &made.frame, features), SPHC_OK);
  sphc_features_arrays arrays = {};
  arrays.struct_size = sizeof arrays;
  ASSERT_EQ(sphc_features_get(features, &arrays), SPHC_OK);
  bool mixed = false;
  for (uint32_t i = 1; i < arrays.count; ++i) {
    EXPECT_LE(arrays.keypoints[i].response, arrays.keypoints[i - 1].response);
    mixed |= arrays.cameras[i] < arrays.cameras[i - 1];
  }
  EXPECT_TRUE(mixed) << "those of one camera come behind those of another";
  EXPECT_TRUE(memory.guardsIntact());
}

// In two halves, and with features that were read out and set again: the same bytes.
TEST(Cameras, HalvesAnswerTheSame) {
  const Rig rig;
  const RigFrame made(rig, kViewpoint);
  Session whole(rig.config), halves(rig.config), set(rig.config);
  sphc_localizer_result expected = spherecloud::emptyResult(), answer = spherecloud::emptyResult(),
                        again = spherecloud::emptyResult();
  ASSERT_EQ(whole.process(made.frame, &expected), SPHC_OK);
  sphc_memory need = {};
  ASSERT_EQ(sphc_features_memory(&rig.config, &need, nullptr), SPHC_OK);
  GuardedMemory memory(need.state_bytes, need.alignment), other(need.state_bytes, need.alignment);
  sphc_features *features = nullptr, *copied = nullptr;
  ASSERT_EQ(sphc_features_init(memory.data(), memory.size(), &rig.config, &features, nullptr), SPHC_OK);
  ASSERT_EQ(sphc_features_init(other.data(), other.size(), &rig.config, &copied, nullptr), SPHC_OK);
  ASSERT_EQ(sphc_localizer_extract(halves.localizer(), &made.frame, features), SPHC_OK);
  ASSERT_EQ(sphc_localizer_locate(halves.localizer(), &made.frame, features, &answer), SPHC_OK);
  EXPECT_EQ(std::memcmp(&answer, &expected, sizeof answer), 0);

  sphc_features_arrays arrays = {};
  arrays.struct_size = sizeof arrays;
  ASSERT_EQ(sphc_features_get(features, &arrays), SPHC_OK);
  ASSERT_EQ(sphc_features_set(copied, &made.frame, &arrays), SPHC_OK) << sphc_features_message(copied);
  ASSERT_EQ(sphc_localizer_locate(set.localizer(), &made.frame, copied, &again), SPHC_OK);
  EXPECT_EQ(std::memcmp(&again, &expected, sizeof again), 0);

  std::vector<uint8_t> wrong(arrays.cameras, arrays.cameras + arrays.count);
  wrong[3] = 3;
  arrays.cameras = wrong.data();
  EXPECT_EQ(sphc_features_set(copied, &made.frame, &arrays), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(copied), "keypoint 3 is of a camera");
}

// The images may go once their features are found, and that of a late camera still makes the pose less sure.
TEST(Cameras, HalvesAnswerTheSameWhereTheImagesAreGone) {
  const Rig rig;
  RigFrame made(rig, kViewpoint);
  made.views[0].time_ns -= 133000000;
  Session whole(rig.config), halves(rig.config), set(rig.config);
  sphc_localizer_result expected = spherecloud::emptyResult(), answer = spherecloud::emptyResult(),
                        again = spherecloud::emptyResult();
  ASSERT_EQ(whole.process(made.frame, &expected), SPHC_OK);
  EXPECT_LT(expected.confidence, 0.5);
  spherecloud::Features features, copied;
  ASSERT_TRUE(spherecloud::Features::make(rig.config, &features).ok());
  ASSERT_TRUE(spherecloud::Features::make(rig.config, &copied).ok());
  ASSERT_EQ(sphc_localizer_extract(halves.localizer(), &made.frame, features.get()), SPHC_OK);
  sphc_features_arrays arrays = {};
  ASSERT_TRUE(features.arrays(&arrays).ok());
  ASSERT_TRUE(copied.set(made.frame, arrays).ok());
  made.frame.color = {};
  for (sphc_localizer_view &view : made.views) view.image = {};
  ASSERT_EQ(sphc_localizer_locate(halves.localizer(), &made.frame, features.get(), &answer), SPHC_OK);
  EXPECT_EQ(std::memcmp(&answer, &expected, sizeof answer), 0) << answer.confidence;
  ASSERT_EQ(sphc_localizer_locate(set.localizer(), &made.frame, copied.get(), &again), SPHC_OK);
  EXPECT_EQ(std::memcmp(&again, &expected, sizeof again), 0) << again.confidence;
}

// Where focus or heat has changed a camera, the frame says so.
TEST(Cameras, CalibrationOfAFrameReplacesTheConfigs) {
  const Rig rig;
  Rig vague = rig;
  vague.cameras[0].color_from_camera.t_m[0] += 0.3;
  vague.cameras[1].camera.params[0] *= 1.3;
  vague.config.cameras = vague.cameras.data();
  vague.config.rig.color_from_depth.t_m[1] += 0.2;
  RigFrame made(rig, kViewpoint);
  Session right(rig.config), wrong(vague.config);
  sphc_localizer_result expected = spherecloud::emptyResult(), result = spherecloud::emptyResult();
  ASSERT_EQ(right.process(made.frame, &expected), SPHC_OK);
  wrong.process(made.frame, &result);
  EXPECT_NE(std::memcmp(&result, &expected, sizeof result), 0);

  made.frame.color_camera = &rig.config.rig.color_camera;
  made.frame.color_from_depth = &rig.config.rig.color_from_depth;
  made.views[0].color_from_camera = &rig.cameras[0].color_from_camera;
  made.views[1].camera = &rig.cameras[1].camera;
  Session told(vague.config);
  ASSERT_EQ(told.process(made.frame, &result), SPHC_OK);
  EXPECT_EQ(
      std::memcmp(result.camera_from_map.t_m, expected.camera_from_map.t_m, sizeof expected.camera_from_map.t_m),
      0);
  EXPECT_EQ(result.inliers, expected.inliers);

  sphc_camera wider = rig.config.rig.color_camera;
  wider.params[0] *= 1.3;
  made.frame.color_camera = &wider;
  told.process(made.frame, &result);
  EXPECT_NE(result.inliers, expected.inliers);
}

// A further camera was exposed later, while odometry tells that the rig moved.
TEST(Cameras, OdometryTakesThemToTheTimeOfTheColourImage) {
  Rig rig;
  rig.config.mode = SPHC_MODE_TRACKING;
  const auto errorWith = [&](bool knows_time) {
    Session session(rig.config);
    double error_m = 0;
    for (uint32_t i = 0; i < 3; ++i) {
      RigFrame made(rig, i);
      const RigFrame late(rig, i + 1);  // half of the views are of the next viewpoint
      sphc_localizer_prior prior;
      sphc_localizer_prior_init(&prior, sizeof prior);
      prior.flags = SPHC_PRIOR_ODOMETRY;
      prior.odometry_from_camera = sphc::rigidToC(sphc::test::sceneViewpoint(i).inverse());
      prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 1e-3;
      made.frame.prior = &prior;
      made.frame.color_time_ns = made.frame.depth_time_ns = int64_t{33000000} * (i + 1);
      std::fill(made.color->images.gray.begin(), made.color->images.gray.end(), uint8_t{90});
      for (size_t k = 0; k < made.views.size(); ++k) {
        made.views[k].image = late.views[k].image;
        made.views[k].time_ns = made.frame.color_time_ns + (knows_time ? 33000000 : 0);
      }
      sphc_localizer_result result = spherecloud::emptyResult();
      if (session.process(made.frame, &result) != SPHC_OK) return 1.0;
      error_m = session.errorM(result, i);
    }
    return error_m;
  };
  EXPECT_LT(errorWith(true), 0.02);
  EXPECT_GT(errorWith(false), 2 * errorWith(true));
}

// Rows of a rolling shutter, each of its own moment; the middle one is of the viewpoint.
void rollRows(const sphc_localizer_config &config, uint32_t viewpoint, double viewpoints_a_row, SceneFrame *made) {
  constexpr uint32_t kRows = 8;  // drawn at once
  const sphc_camera &camera = config.rig.color_camera;
  for (uint32_t row = 0; row < camera.height; row += kRows) {
    const double at = viewpoint + (row + 0.5 * kRows - 0.5 * camera.height) * viewpoints_a_row;
    const sphc::test::SceneImages now =
        sphc::test::renderScene(camera, config.rig.depth_camera, sphc::test::sceneViewpoint(at),
                                sphc::rigidFromC(config.rig.color_from_depth));
    std::copy_n(now.gray.begin() + row * camera.width, kRows * camera.width,
                made->images.gray.begin() + row * camera.width);
  }
}

constexpr int64_t kRollingFrameNs = 33000000, kRollingRowNs = 100000;

// The last of three frames with odometry, or of four without, whose rows are taken for that far apart, by odometry
// or from pose to pose.
sphc_localizer_result lastOfRolling(int64_t row_time_ns, bool with_odometry, double *error_m) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.mode = SPHC_MODE_TRACKING;
  config.color_row_time_ns = row_time_ns;
  Session session(config);
  sphc_localizer_result result = spherecloud::emptyResult();
  const uint32_t frames = with_odometry ? 3 : 4;
  for (uint32_t i = 0; i < frames; ++i) {
    const auto made = sphc::test::sceneFrame(config, i);
    rollRows(config, i, static_cast<double>(kRollingRowNs) / kRollingFrameNs, made.get());
    sphc_localizer_prior prior;
    sphc_localizer_prior_init(&prior, sizeof prior);
    prior.flags = SPHC_PRIOR_ODOMETRY;
    prior.odometry_from_camera = sphc::rigidToC(sphc::test::sceneViewpoint(i).inverse());
    prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 1e-3;
    if (with_odometry) made->frame.prior = &prior;
    made->frame.color_time_ns = made->frame.depth_time_ns = kRollingFrameNs * (i + 1);
    EXPECT_EQ(session.process(made->frame, &result), SPHC_OK);
    *error_m = session.errorM(result, i);
  }
  return result;
}

double errorOfRolling(int64_t row_time_ns, bool with_odometry) {
  double error_m = 0;
  lastOfRolling(row_time_ns, with_odometry, &error_m);
  return error_m;
}

TEST(Cameras, RowsOfARollingShutterAreTakenToOneTimeByOdometry) {
  const double error_m = errorOfRolling(kRollingRowNs, true);
  EXPECT_LT(error_m, 0.004);
  EXPECT_GT(errorOfRolling(0, true), 2 * error_m);
  EXPECT_GT(errorOfRolling(-kRollingRowNs, true), 2 * error_m) << "the other way round";
}

TEST(Cameras, RowsOfARollingShutterAreTakenToOneTimeFromPoseToPose) {
  const double error_m = errorOfRolling(kRollingRowNs, false);
  EXPECT_LT(error_m, 0.004);
  EXPECT_GT(errorOfRolling(0, false), 2 * error_m);
}

// By what is not known of the rate.
TEST(Cameras, ARollingShutterMakesPosesLessSure) {
  const auto sigmas = [](int64_t row_time_ns, bool with_odometry) {
    double error_m = 0;
    const sphc_localizer_result result = lastOfRolling(row_time_ns, with_odometry, &error_m);
    return std::make_pair(std::sqrt(result.covariance[0]), std::sqrt(result.covariance[21]));
  };
  const auto untold = sigmas(0, false), told = sigmas(kRollingRowNs, false),
             by_odometry = sigmas(kRollingRowNs, true);
  EXPECT_GT(told.first, 1.2 * std::max(untold.first, by_odometry.first));
  EXPECT_GT(told.second, 1.2 * std::max(untold.second, by_odometry.second));
}

// The pose stays, and is less sure.
TEST(Cameras, ASingleFrameOfARollingShutterIsLessSure) {
  const auto answer = [](int64_t row_time_ns) {
    sphc_localizer_config config = sphc::test::sceneConfig();
    config.mode = SPHC_MODE_SINGLE;
    config.color_row_time_ns = row_time_ns;
    Session session(config);
    sphc_localizer_result result = spherecloud::emptyResult();
    EXPECT_EQ(session.process(sphc::test::sceneFrame(config, 0)->frame, &result), SPHC_OK);
    return result;
  };
  const sphc_localizer_result at_once = answer(0), rolling = answer(kRollingRowNs);
  EXPECT_EQ(std::memcmp(&rolling.camera_from_map, &at_once.camera_from_map, sizeof at_once.camera_from_map), 0);
  for (const int i : {0, 21}) EXPECT_GT(rolling.covariance[i], 2 * at_once.covariance[i]) << i;
  EXPECT_LT(rolling.confidence, at_once.confidence);
}

// Frames that nothing is known of between them: the first, and one after a gap that motion does not reach over.
TEST(Cameras, ARateOfLongAgoIsNoWorseThanNone) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.mode = SPHC_MODE_TRACKING;
  config.color_row_time_ns = kRollingRowNs;
  Session session(config);
  double first_sigma_m = 0;
  sphc_localizer_result result = spherecloud::emptyResult();
  int64_t time_ns = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    const auto made = sphc::test::sceneFrame(config, i);
    time_ns += i < 3 ? kRollingFrameNs : 900000000;
    made->frame.color_time_ns = made->frame.depth_time_ns = time_ns;
    EXPECT_EQ(session.process(made->frame, &result), SPHC_OK);
    if (i == 0) first_sigma_m = std::sqrt(result.covariance[21]);
  }
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_LT(std::sqrt(result.covariance[21]), 1.1 * first_sigma_m);
}

struct BadConfig {
  const char *what;
  void (*spoil)(Rig *);
  sphc_status status;
  std::vector<const char *> says;
};

TEST(Cameras, ABadConfigIsRefusedWithItsCause) {
  const BadConfig cases[] = {
      {"too many",
       [](Rig *r) { r->config.camera_count = SPHC_CAMERAS_MAX; },
       SPHC_E_ARGUMENT,
       {"config.camera_count is 8", "1 to 7"}},
      {"null", [](Rig *r) { r->config.cameras = nullptr; }, SPHC_E_ARGUMENT, {"config.cameras is null"}},
      {"none", [](Rig *r) { r->config.camera_count = 0; }, SPHC_E_ARGUMENT, {"config.camera_count is 0"}},
      {"size", [](Rig *r) { r->cameras[0].struct_size = 4; }, SPHC_E_STRUCT_SIZE, {"struct_size"}},
      {"sizes that differ",
       [](Rig *r) { r->cameras[1].struct_size += 8; },
       SPHC_E_STRUCT_SIZE,
       {"config.cameras[1].struct_size"}},
      {"reserved", [](Rig *r) { r->cameras[1].reserved = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
      {"camera",
       [](Rig *r) { r->cameras[1].camera.params[0] = std::numeric_limits<double>::quiet_NaN(); },
       SPHC_E_ARGUMENT,
       {"i = 1", "config.cameras[i].camera"}},
      {"quaternion",
       [](Rig *r) { r->cameras[0].color_from_camera.q_wxyz[0] = 2; },
       SPHC_E_ARGUMENT,
       {"i = 0", "config.cameras[i].color_from_camera.q_wxyz has length 2.0", "it must be 1"}},
      {"row time",
       [](Rig *r) { r->cameras[1].row_time_ns = 2 * SPHC_ROW_TIME_MAX_NS; },
       SPHC_E_ARGUMENT,
       {"i = 1", "row_time_ns"}},
      {"row time of colour",
       [](Rig *r) { r->config.color_row_time_ns = -2 * SPHC_ROW_TIME_MAX_NS; },
       SPHC_E_ARGUMENT,
       {"config.color_row_time_ns"}},
      {"translation",
       [](Rig *r) { r->cameras[0].color_from_camera.t_m[2] = std::numeric_limits<double>::quiet_NaN(); },
       SPHC_E_ARGUMENT,
       {"i = 0", "config.cameras[i].color_from_camera.t_m[2] is nan"}},
  };
  for (const BadConfig &bad : cases) {
    SCOPED_TRACE(bad.what);
    Rig rig;
    bad.spoil(&rig);
    sphc_memory need = {};
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_memory(&rig.config, &need, &message), bad.status);
    for (const char *words : bad.says) expectMentions(message.text, words);
    EXPECT_EQ(sphc_features_memory(&rig.config, &need, &message), bad.status);
  }
}

struct BadFrame {
  const char *what;
  void (*spoil)(RigFrame *);
  sphc_status status;
  std::vector<const char *> says;
};

TEST(Cameras, ABadFrameIsRefusedWithItsCause) {
  static sphc_camera wider = sphc::test::pinhole(404, 304, 300), higher = sphc::test::pinhole(400, 308, 300),
                     broken = sphc::test::pinhole(400, 304, -300);
  static sphc_rigid bent = {{1, 1, 0, 0}, {0, 0, 0}};
  const BadFrame cases[] = {
      {"too few",
       [](RigFrame *f) { f->frame.view_count = 1; },
       SPHC_E_ARGUMENT,
       {"frame.view_count is 1", "config.camera_count is 2"}},
      {"none",
       [](RigFrame *f) { f->frame.view_count = 0, f->frame.views = nullptr; },
       SPHC_E_ARGUMENT,
       {"frame.view_count is 0", "data null"}},
      {"null", [](RigFrame *f) { f->frame.views = nullptr; }, SPHC_E_ARGUMENT, {"frame.views is null"}},
      {"size", [](RigFrame *f) { f->views[0].struct_size = 0; }, SPHC_E_STRUCT_SIZE, {"struct_size"}},
      {"image",
       [](RigFrame *f) { f->views[1].image.width = 320; },
       SPHC_E_IMAGE,
       {"i = 1", "frame.views[i]", "256"}},
      {"format", [](RigFrame *f) { f->views[1].image.format = SPHC_FORMAT_DEPTH16; }, SPHC_E_IMAGE, {"i = 1"}},
      {"width", [](RigFrame *f) { f->views[0].camera = &wider; }, SPHC_E_ARGUMENT, {"i = 0", "404 x 304", "400"}},
      {"height", [](RigFrame *f) { f->views[0].camera = &higher; }, SPHC_E_ARGUMENT, {"i = 0", "400 x 308"}},
      {"camera", [](RigFrame *f) { f->views[0].camera = &broken; }, SPHC_E_ARGUMENT, {"i = 0", "camera.params"}},
      {"mount", [](RigFrame *f) { f->views[0].color_from_camera = &bent; }, SPHC_E_ARGUMENT, {"color_from_camera"}},
      {"colour mount",
       [](RigFrame *f) { f->frame.color_from_depth = &bent; },
       SPHC_E_ARGUMENT,
       {"frame.color_from_depth"}},
      {"reserved", [](RigFrame *f) { f->views[0].reserved = 1; }, SPHC_E_UNSUPPORTED, {"reserved"}},
  };
  const Rig rig;
  Session session(rig.config);
  for (const BadFrame &bad : cases) {
    SCOPED_TRACE(bad.what);
    RigFrame made(rig, kViewpoint);
    bad.spoil(&made);
    sphc_localizer_result result = spherecloud::emptyResult();
    EXPECT_EQ(session.process(made.frame, &result), bad.status);
    for (const char *words : bad.says) expectMentions(sphc_localizer_message(session.localizer()), words);
  }
  const RigFrame good(rig, kViewpoint);
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_EQ(session.process(good.frame, &result), SPHC_OK);
  EXPECT_TRUE(session.state().guardsIntact() && session.scratch().guardsIntact());
}

TEST(Cameras, AnImageInsideTheLocalizersMemoryIsRefused) {
  const Rig rig;
  Session session(rig.config);
  RigFrame made(rig, kViewpoint);
  made.views[1].image.data = session.scratch().data();
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_EQ(session.process(made.frame, &result), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(session.localizer()), "scratch memory overlaps the image of a view");
}

TEST(Cameras, FeaturesOfOtherImagesAreNotLocated) {
  const Rig rig;
  Rig higher, fewer;
  higher.cameras[1].camera = sphc::test::pinhole(256, 212, 200);
  fewer.cameras.pop_back();
  fewer.config.camera_count = 1;
  const RigFrame made(rig, kViewpoint);
  Session session(rig.config);
  for (const Rig *other : {&higher, &fewer}) {
    const RigFrame of_other(*other, kViewpoint);
    Session session_of_other(other->config);
    spherecloud::Features features;
    ASSERT_TRUE(spherecloud::Features::make(other->config, &features).ok());
    ASSERT_EQ(sphc_localizer_extract(session_of_other.localizer(), &of_other.frame, features.get()), SPHC_OK);
    sphc_localizer_result result = spherecloud::emptyResult();
    EXPECT_EQ(sphc_localizer_locate(session.localizer(), &made.frame, features.get(), &result), SPHC_E_ARGUMENT);
    expectMentions(sphc_localizer_message(session.localizer()), "make both with one config");
  }
}

// A newer header has fields behind those that are known, and so more bytes from a view to the next.
TEST(Cameras, ViewsOfANewerHeaderAreRead) {
  struct NewerView {
    sphc_localizer_view known;
    uint64_t added = 0;
  };
  const Rig rig;
  RigFrame made(rig, kViewpoint);
  Session before(rig.config), newer(rig.config);
  sphc_localizer_result expected = spherecloud::emptyResult(), result = spherecloud::emptyResult();
  ASSERT_EQ(before.process(made.frame, &expected), SPHC_OK);
  std::vector<NewerView> views(made.views.size());
  for (size_t i = 0; i < views.size(); ++i) {
    views[i].known = made.views[i];
    views[i].known.struct_size = sizeof(NewerView);
  }
  made.frame.views = &views[0].known;
  ASSERT_EQ(newer.process(made.frame, &result), SPHC_OK) << sphc_localizer_message(newer.localizer());
  EXPECT_EQ(std::memcmp(&result, &expected, sizeof result), 0);
}

TEST(Cameras, BoundsOfMemoryHold) {
  for (const uint32_t side : {32u, 480u, 1024u}) {
    Rig rig;
    rig.config.max_keypoints = side == 32 ? 64 : 4096;
    for (sphc_localizer_camera &camera : rig.cameras) camera.camera = sphc::test::pinhole(side, side, 300);
    sphc_memory need = {};
    ASSERT_EQ(sphc_localizer_memory(&rig.config, &need, nullptr), SPHC_OK);
    const uint32_t width = std::max(side, 320u), height = std::max(side, 240u), n = rig.config.max_keypoints;
    const uint64_t more = SPHC_LOCALIZER_CAMERAS_BYTES_MAX(n, width, height);
    EXPECT_LE(need.state_bytes, SPHC_LOCALIZER_STATE_BYTES_MAX(n, rig.config.max_maps) + more);
    EXPECT_LE(need.scratch_bytes, SPHC_LOCALIZER_SCRATCH_BYTES_MAX(n, width, height) + more);
    sphc_memory of_features = {};
    ASSERT_EQ(sphc_features_memory(&rig.config, &of_features, nullptr), SPHC_OK);
    EXPECT_LE(of_features.state_bytes, SPHC_FEATURES_BYTES_MAX(n, 320, 240));
  }
}

}  // namespace
