#include "host/audit/score/centre_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "host/audit/attack/virtual_camera.h"
#include "host/recording/recording_writer.h"
#include "runtime/base/elementary.h"
#include "runtime/geometry/rigid.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocalPx = 110, kRadiusM = 2;
constexpr double kDegree = kPi / 180;

// The inside of a ball around the world's origin; stripes by longitude, some 20 degrees wide.
int greyOf(const Vector3 &point_m) {
  return static_cast<int>(127 + 100 * std::sin(9 * std::atan2(point_m.x(), point_m.z())));
}

Rigid poseOf(int frame) {
  return {Eigen::AngleAxisd(frame * 12 * kDegree, Vector3::UnitY()).toRotationMatrix(), Vector3(0.1, 0, 0.2)};
}

// Where a ray from within the ball meets it.
Vector3 meet(const Vector3 &from_m, const Vector3 &ray) {
  const double b = from_m.dot(ray), a = ray.squaredNorm(), c = from_m.squaredNorm() - kRadiusM * kRadiusM;
  return from_m + (-b + std::sqrt(b * b - a * c)) / a * ray;
}

void writeFrame(int frame, sphc_recording_writer *writer) {
  std::vector<uint8_t> color;
  std::vector<uint16_t> depth;
  const Rigid world_from_camera = poseOf(frame);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const Vector3 ray((i % kWidth + 0.5 - kWidth / 2.0) / kFocalPx, (i / kWidth + 0.5 - kHeight / 2.0) / kFocalPx,
                      1);
    const Vector3 point = meet(world_from_camera.translation_m, world_from_camera.rotation * ray);
    color.insert(color.end(), 3, static_cast<uint8_t>(greyOf(point)));
    depth.push_back(static_cast<uint16_t>(std::lround(1000 * (world_from_camera.inverse() * point).z())));
  }
  const int64_t time_ns = 1000000000 + frame * 100000000ll;
  sphc_localizer_frame images = {};
  images.struct_size = sizeof images;
  images.sequence = static_cast<uint32_t>(frame);
  images.color_time_ns = images.depth_time_ns = time_ns;
  images.color = {color.data(), kWidth, kHeight, kWidth * 3, SPHC_FORMAT_BGR8};
  images.depth = {depth.data(), kWidth, kHeight, kWidth * 2, SPHC_FORMAT_DEPTH16};
  const sphc_rigid pose = rigidToC(world_from_camera);
  sphc_message message;
  ASSERT_EQ(sphc_recording_add_frame(writer, &images, &message), SPHC_OK) << message.text;
  ASSERT_EQ(sphc_recording_add_pose(writer, time_ns, &pose, &message), SPHC_OK) << message.text;
}

// Six frames that turn by 60 degrees.
class PanoramaFrom : public testing::Test {
 protected:
  void SetUp() override {
    sphc_rig calibration;
    sphc_rig_init(&calibration);
    calibration.color_camera = {
        SPHC_CAMERA_PINHOLE, kWidth, kHeight, 4, {kFocalPx, kFocalPx, kWidth / 2.0, kHeight / 2.0}};
    calibration.depth_camera = calibration.color_camera;
    calibration.color_from_depth = rigidToC({});
    calibration.depth_unit_m = 0.001;
    sphc_recording_writer *writer = nullptr;
    sphc_message message;
    ASSERT_EQ(sphc_recording_create((folder_ / "ball").c_str(), &calibration, &writer, &message), SPHC_OK);
    for (int frame = 0; frame < 6; ++frame) writeFrame(frame, writer);
    ASSERT_EQ(sphc_recording_close(&writer, &message), SPHC_OK);
    reader_ = std::make_unique<recording::RecordingReader>(folder_ / "ball");
  }

  test::TempFolder folder_;
  std::unique_ptr<recording::RecordingReader> reader_;
};

TEST_F(PanoramaFrom, PaintsWhatTheCentreWouldSee) {
  const Vector3 centre(-0.2, 0.1, 0.1);
  std::vector<uint32_t> told;
  const Panorama panorama = panoramaFrom(reader_.get(), centre, [&](uint32_t done, uint32_t total) {
    EXPECT_EQ(total, reader_->frameCount());
    told.push_back(done);
  });
  EXPECT_EQ(told.size(), reader_->frameCount());
  const Matrix3 camera_from_map = Eigen::AngleAxisd(-25 * kDegree, Vector3::UnitY()).toRotationMatrix();
  const TruthView view = panorama.view(camera_from_map);
  EXPECT_GT(view.seenShare(), 0.95);  // but for a strip above, which no frame saw
  double worst = 0, sum = 0;
  for (int y = 4; y < VirtualCamera::kSide; y += 8) {
    for (int x = 4; x < VirtualCamera::kSide; x += 8) {
      if (!view.seen.at<uint8_t>(y, x)) continue;
      const Vector3 ray = camera_from_map.transpose() * VirtualCamera::ray(Vector2(x + 0.5, y + 0.5));
      const double error = std::abs(static_cast<double>(view.grey.at<float>(y, x)) - greyOf(meet(centre, ray)));
      worst = std::max(worst, error);
      sum += error;
    }
  }
  EXPECT_LT(worst, 25);  // of 200, on stripes of 50 pixels: a pixel beside
  EXPECT_LT(sum / 256, 6);
}

TEST_F(PanoramaFrom, PosesAreApartAndKnown) {
  const Panorama panorama = panoramaFrom(reader_.get(), Vector3::Zero(), [](uint32_t, uint32_t) {});
  const std::vector<Matrix3> poses = choosePoses(reader_.get(), panorama, 20, 0.7);
  EXPECT_GE(poses.size(), 3u);  // at 0, 24 and 48 degrees
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_GE(panorama.view(poses[i]).seenShare(), 0.7);
    for (size_t k = 0; k < i; ++k) EXPECT_LE(poses[i].row(2).dot(poses[k].row(2)), std::cos(20 * kDegree) + 1e-12);
  }
}

}  // namespace
}  // namespace sphc::host
