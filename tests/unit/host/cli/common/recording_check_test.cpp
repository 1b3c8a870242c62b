#include "host/cli/common/recording_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>

#include "host/recording/calibration_json.h"
#include "tests/contract/tiny_recording.h"
#include "tests/support/ros_bag.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class RecordingCheckTest : public testing::Test {
 protected:
  void SetUp() override { contract::writeTinyRecording(walk(), kFrames); }
  std::string walk() const { return folder_ / "walk"; }
  Findings ofImages() const { return findingsOfImages(recording::RecordingReader(walk())); }
  Findings ofPoses() const {
    recording::RecordingReader reader(walk());
    return findingsOfPoses(&reader, {}, {});
  }
  void exchange(const std::string &a, const std::string &b) const {
    std::filesystem::rename(walk() + "/" + a, walk() + "/other");
    std::filesystem::rename(walk() + "/" + b, walk() + "/" + a);
    std::filesystem::rename(walk() + "/other", walk() + "/" + b);
  }
  // As if it were for images twice as large.
  static void scale(sphc_camera *camera) {
    camera->width *= 2;
    camera->height *= 2;
    for (size_t i = 0; i < 4; ++i) camera->params[i] *= 2;
  }

  static constexpr uint32_t kFrames = 12;
  test::TempFolder folder_;
};

TEST_F(RecordingCheckTest, SoundImagesAreNotTalkedOf) { EXPECT_THAT(ofImages(), IsEmpty()); }

TEST_F(RecordingCheckTest, SwappedImagesAreNamed) {
  exchange("rgb.txt", "depth.txt");
  const Findings swapped = ofImages();
  ASSERT_EQ(swapped.size(), 1u);
  EXPECT_EQ(swapped[0].grade, Finding::Grade::kWrong);
  EXPECT_THAT(swapped[0].text, HasSubstr("colour and depth are swapped: depth/000000.png is a depth image"));
  EXPECT_THAT(swapped[0].text, HasSubstr("exchange the two lists"));
}

TEST_F(RecordingCheckTest, ACalibrationOfAnotherSizeIsNamed) {
  const std::string file = walk() + "/calibration.json";
  sphc_rig rig = recording::readCalibration(file);
  scale(&rig.color_camera);
  recording::writeCalibration(file, rig);
  const Findings color = ofImages();
  ASSERT_EQ(color.size(), 1u);
  EXPECT_EQ(color[0].what, "colour images");
  EXPECT_THAT(color[0].text,
              HasSubstr("not one fits the calibration, which is for images of another size or kind: "));
  EXPECT_THAT(color[0].text, HasSubstr("is 48 x 32, the calibration's color_camera 96 x 64; use"));
  scale(&rig.depth_camera);
  recording::writeCalibration(file, rig);
  EXPECT_EQ(ofImages().size(), 2u);
}

TEST_F(RecordingCheckTest, ImagesThatAreDamagedAreNoMatterOfTheCalibration) {
  for (const auto &image : std::filesystem::directory_iterator(walk() + "/rgb"))
    std::filesystem::resize_file(image.path(), 60);
  EXPECT_THAT(ofImages(), IsEmpty());
}

TEST_F(RecordingCheckTest, PosesAreJudgedWhereTheyAre) {
  EXPECT_THAT(ofPoses().at(0).what, "poses");
  folder_.write("walk/groundtruth.txt", "5 0 0 0 0 0 0 1\n6 0 0 1 0 0 0 1\n");
  EXPECT_THAT(ofPoses().at(0).text, HasSubstr("none of 2 poses is of the time of a frame"));
  folder_.write("walk/groundtruth.txt", "1305031102.175304123 0 0 0 0 0 0 1\n1305031102.185304123 0 0 1 0 0 0 1\n");
  EXPECT_THAT(ofPoses().at(0).text, HasSubstr("2 of 12 frames have a pose"));
  std::filesystem::remove(walk() + "/groundtruth.txt");
  const Findings none = ofPoses();
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(none[0].grade, Finding::Grade::kDoubtful);
  EXPECT_THAT(none[0].text, HasSubstr("there are none, and build needs them; spherecloud map finds them"));
}

// Odometry that nothing joins to the camera.
TEST_F(RecordingCheckTest, WhyABagHasNoPosesIsSaid) {
  const sphc_rigid same = {{1, 0, 0, 0}, {0, 0, 0}};
  const std::string type = "sensor_msgs/msg/";
  test::RosBag bag;
  for (const auto &[topic, encoding, bytes] :
       {std::tuple("/cam/color/", "mono8", 1u), {"/cam/depth/", "16UC1", 2u}}) {
    bag.add(topic + std::string("camera_info"), type + "CameraInfo", 1,
            test::rosCameraInfo("camera", 16, 16, "plumb_bob", {}, {10, 10, 7.5, 7.5}));
    bag.add(topic + std::string("image"), type + "Image", 1,
            test::rosImage(1, "camera", 16, 16, encoding, test::Bytes(16 * 16 * bytes)));
  }
  bag.add("/odom", "nav_msgs/msg/Odometry", 1, test::rosOdometry(1, {"odom", "base_link", same}));
  folder_.write("bag.mcap", bag.bytes(test::RosBag::Chunks::kStored));
  recording::RecordingReader reader(folder_ / "bag.mcap");
  const Findings findings = findingsOfPoses(&reader, {}, {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].grade, Finding::Grade::kDoubtful);
  EXPECT_THAT(findings[0].text, HasSubstr("moves base_link, and no transform joins that to camera, the colour"));
}

}  // namespace
}  // namespace sphc::host
