#include "host/import/pose_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"

namespace sphc::host {
namespace {

constexpr uint32_t kFirstSequence = 100;
using Telling = std::function<Rigid(const Rigid &truth)>;
using TellingOfFrame = std::function<Rigid(uint32_t frame, const Rigid &truth)>;

// A walk past still points, by poses that are told so.
PoseScaleCheck checkOf(const TellingOfFrame &tell, double step_m, uint32_t frames) {
  Random random(1);
  const Camera camera(test::pinhole(320, 240, 250));
  std::vector<Vector3> places_m;
  std::vector<Descriptor> looks;
  for (int i = 0; i < 400; ++i) {
    places_m.push_back(
        {test::uniformIn(&random, -3, 4), test::uniformIn(&random, -1.5, 1.5), test::uniformIn(&random, 1.5, 4)});
    looks.push_back(test::randomDescriptor(&random));
  }
  PoseScaleCheck check;
  check.begin(camera, frames);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const Matrix3 turned = rotationFromVector({0.006 * frame, 0.01 * frame, 0.008 * frame});
    const Rigid truth = {turned, step_m * frame * Vector3(1, 0.7, 1.5)}, told = tell(frame, truth);
    std::vector<Observation> seen;
    for (size_t i = 0; i < places_m.size(); ++i) {
      const Vector3 point_m = truth.inverse() * places_m[i];
      Observation o = {};
      if (point_m.z() < 0.1 || !camera.project(point_m, &o.pixel_px)) continue;
      if (o.pixel_px.x() < 0 || o.pixel_px.y() < 0 || o.pixel_px.x() >= 320 || o.pixel_px.y() >= 240) continue;
      o.image_px = o.pixel_px;
      o.position_m = told * point_m;
      o.depth_m = point_m.z();
      o.descriptor = looks[i];
      seen.push_back(o);
    }
    check.add(kFirstSequence + frame, told, seen);
  }
  return check;
}

// What it says of poses that are all told so.
PoseScale scaleTold(const Telling &tell, double step_m = 0.05) {
  constexpr uint32_t kFrames = 30;
  return checkOf([&tell](uint32_t, const Rigid &truth) { return tell(truth); }, step_m, kFrames).result();
}

// The same where poses are told so from the middle on.
std::vector<PoseScalePart> partsOfSpoiledHalf(const Telling &tell) {
  constexpr uint32_t kFrames = 80;
  const auto from_middle = [&tell](uint32_t frame, const Rigid &truth) {
    return frame < kFrames / 2 ? truth : tell(truth);
  };
  return checkOf(from_middle, 0.02, kFrames).parts();
}

// Poses whose shifts are `poses` times the true ones.
PoseScale scaleOf(double poses, double step_m = 0.05) {
  return scaleTold(
      [poses](const Rigid &truth) {
        return Rigid{truth.rotation, poses * truth.translation_m};
      },
      step_m);
}

TEST(PoseScale, OfSoundPosesIsOne) {
  const PoseScale scale = scaleOf(1);
  EXPECT_GT(scale.matches, 500u);
  EXPECT_GT(scale.agree, 0.9 * scale.matches);
  EXPECT_EQ(scale.agree, scale.agree_most);
  EXPECT_NEAR(scale.multiple, 1, 0.07);
}

TEST(PoseScale, OfAnotherUnitIsFound) {
  for (const double poses : {0.3048, 0.5, 2.0, 5.0}) {
    const PoseScale scale = scaleOf(poses);
    EXPECT_NEAR(poses * scale.multiple, 1, 0.2) << poses;
    EXPECT_GT(scale.agree_most, 0.9 * scale.matches) << poses;
    EXPECT_LT(scale.agree, 0.3 * scale.agree_most) << poses;
  }
}

TEST(PoseScale, OfInverseAndMirroredPosesTheMistakeIsFound) {
  const auto mirrored = [](double x, double y, double z, bool turns) {
    return [axes = Matrix3(Vector3(x, y, z).asDiagonal()), turns](const Rigid &truth) {
      const Matrix3 rotation = turns ? Matrix3(axes * truth.rotation * axes) : truth.rotation;
      return Rigid{rotation, axes * truth.translation_m};
    };
  };
  const struct {
    Telling tell;
    const char *mistake;
  } cases[] = {
      {[](const Rigid &truth) { return truth.inverse(); }, "camera_from_world"},
      {mirrored(1, -1, -1, true), "right, up, back"},
      {mirrored(1, -1, 1, true), "Unity's: negate y of the positions, and x and z of the quaternions"},
      {mirrored(1, 1, -1, true), "negate z of the positions, and x and y of the quaternions"},
      {mirrored(-1, 1, 1, true), "negate x of the positions, and y and z of the quaternions"},
      {mirrored(-1, 1, 1, false), "negate their x"},
      {mirrored(1, -1, 1, false), "negate their y"},
      {mirrored(1, 1, -1, false), "negate their z"},
  };
  for (const auto &each : cases) {
    const PoseScale scale = scaleTold(each.tell);
    EXPECT_THAT(scale.mistake, testing::HasSubstr(each.mistake));
    EXPECT_GT(scale.agree_corrected, 0.9 * scale.matches) << each.mistake;
    EXPECT_LT(scale.agree_most, 0.5 * scale.agree_corrected) << each.mistake;
  }
}

TEST(PoseScale, APartIsAskedByItself) {
  const auto mirrored = [axes = Matrix3(Vector3(1, -1, 1).asDiagonal())](const Rigid &truth) {
    return Rigid{axes * truth.rotation * axes, axes * truth.translation_m};
  };
  const auto twice = [](const Rigid &truth) { return Rigid{truth.rotation, 2 * truth.translation_m}; };
  for (const Telling &tell :
       {Telling(mirrored), Telling(twice), Telling([](const Rigid &t) { return t.inverse(); })}) {
    const std::vector<PoseScalePart> parts = partsOfSpoiledHalf(tell);
    ASSERT_GE(parts.size(), 4u);
    EXPECT_EQ(parts.front().first_sequence, kFirstSequence);
    EXPECT_EQ(parts.back().last_sequence, kFirstSequence + 79);
    for (size_t i = 1; i < parts.size(); ++i) EXPECT_EQ(parts[i].first_sequence, parts[i - 1].last_sequence + 1);
    for (const PoseScalePart &part : parts) {
      const PoseScale &scale = part.scale;
      if (part.last_sequence < kFirstSequence + 40) {
        EXPECT_GT(scale.agree, 0.9 * scale.matches);
      } else if (part.first_sequence >= kFirstSequence + 40) {
        EXPECT_LT(scale.agree, 0.5 * std::max(scale.agree_most, scale.agree_corrected));
      }
    }
  }
}

TEST(PoseScale, PartsAreOfOneRecording) {
  PoseScaleCheck check;
  for (uint32_t recording = 0; recording < 2; ++recording) {
    check.begin(Camera(test::pinhole(320, 240, 250)), 1);
    check.add(recording, {}, {});
  }
  const std::vector<PoseScalePart> parts = check.parts();
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].recording, 1u);
  EXPECT_EQ(parts[1].first_sequence, 1u);
}

TEST(PoseScale, ACameraThatRestsTellsNothing) { EXPECT_EQ(scaleOf(1, 0.0001).matches, 0u); }

}  // namespace
}  // namespace sphc::host
