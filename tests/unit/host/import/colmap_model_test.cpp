#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"
#include "tests/unit/host/import/tiny_colmap.h"

namespace sphc::host {
namespace {

using test::binaryFiles;
using test::textFiles;
using test::tinyColmapModel;
using testing::HasSubstr;

std::string refusal(const ColmapFiles &files) {
  return test::refusal([&] { parseColmapModel(files); });
}

class EitherFormat : public testing::TestWithParam<ColmapFiles (*)(const ColmapModel &)> {};

TEST_P(EitherFormat, SaysWhatWasWritten) {
  const ColmapModel written = tinyColmapModel(3), read = parseColmapModel(GetParam()(written));
  ASSERT_EQ(read.cameras.size(), 1u);
  EXPECT_EQ(read.cameras.at(7).params[0], 60);
  ASSERT_EQ(read.images.size(), 3u);
  for (const auto &[id, image] : written.images) {
    EXPECT_EQ(read.images.at(id).name, image.name);
    EXPECT_EQ(read.images.at(id).camera_from_model.translation_m, image.camera_from_model.translation_m);
    EXPECT_EQ(read.images.at(id).keypoints_px, image.keypoints_px);
  }
  ASSERT_EQ(read.points.size(), 12u);
  for (const auto &[id, point] : written.points) {
    EXPECT_EQ(read.points.at(id).position, point.position);
    ASSERT_EQ(read.points.at(id).track.size(), 3u);
    EXPECT_EQ(read.points.at(id).track[2].keypoint, point.track[2].keypoint);
  }
}

TEST_P(EitherFormat, LinksThatLeadNowhereAreRefused) {
  ColmapModel model = tinyColmapModel(1);
  model.points[105].track[1].keypoint = 12;
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("point 105: was seen as keypoint 12 of image 2"));
  model = tinyColmapModel(1);
  model.points[105].track[1].image = 9;
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("of image 9"));
  model = tinyColmapModel(1);
  model.images[2].camera = 8;
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("image 2: is of camera 8"));
}

TEST_P(EitherFormat, NamesStayInTheFolderOfImages) {
  for (const char *name : {"../a.png", "/etc/a.png", "x/../../a.png"}) {
    ColmapModel model = tinyColmapModel(1);
    model.images[1].name = name;
    EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("not one inside the folder")) << name;
  }
}

TEST_P(EitherFormat, NumbersThatAreNoneAreRefused) {
  ColmapModel model = tinyColmapModel(1);
  model.points[100].position.x() = std::nan("");
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("absurdly far"));
  model = tinyColmapModel(1);
  model.images[1].keypoints_px[3].y() = std::nan("");
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("keypoint"));
  model = tinyColmapModel(1);
  model.cameras[7].params[0] = -60;
  EXPECT_THAT(refusal(GetParam()(model)), HasSubstr("another camera model"));
}

TEST_P(EitherFormat, AnEmptyModelIsRefused) { EXPECT_THAT(refusal(GetParam()({})), HasSubstr("is empty")); }

INSTANTIATE_TEST_SUITE_P(Format, EitherFormat, testing::Values(&binaryFiles, &textFiles));

TEST(ColmapBinary, EveryCutOffFileIsRefused) {
  const ColmapFiles whole = binaryFiles(tinyColmapModel(1));
  ASSERT_EQ(refusal(whole), "");
  for (std::string ColmapFiles::*file : {&ColmapFiles::cameras, &ColmapFiles::images, &ColmapFiles::points})
    for (size_t bytes = 0; bytes < (whole.*file).size(); ++bytes) {
      ColmapFiles cut = whole;
      (cut.*file).resize(bytes);
      EXPECT_NE(refusal(cut), "") << bytes;
    }
}

TEST(ColmapBinary, ALengthBeyondTheFileIsRefusedBeforeMemoryIsTaken) {
  ColmapFiles files = binaryFiles(tinyColmapModel(1));
  files.points.replace(0, 8, "\xff\xff\xff\xff\xff\xff\xff\x0f", 8);
  EXPECT_THAT(refusal(files), HasSubstr("more than the file can hold"));
}

TEST(ColmapBinary, ACameraModelThatTheInterfaceHasNoneForIsNamed) {
  ColmapFiles files = binaryFiles(tinyColmapModel(1));
  files.cameras[12] = 7;  // FOV
  EXPECT_THAT(refusal(files), HasSubstr("number 7; known here: SIMPLE_PINHOLE"));
}

TEST(ColmapText, AnImageWithoutKeypointsHasAnEmptyLine) {
  ColmapFiles files = textFiles(tinyColmapModel(1));
  files.images += "9 1 0 0 0 0 0 0 7 lone.png\n\n";
  EXPECT_TRUE(parseColmapModel(files).images.at(9).keypoints_px.empty());
}

TEST(ColmapText, TheDocumentedExampleIsRead) {  // of COLMAP's manual, cut to what it shows
  ColmapFiles files = {false, "# Camera list\n1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152\n",
                       "1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180141.JPG\n"
                       "2362.39 248.498 58396 1784.7 268.254 59027 1784.7 268.254 -1\n",
                       "63390 1.67241 0.292931 0.609726 115 121 122 1.33927 1 2\n"};
  const ColmapModel model = parseColmapModel(files);
  EXPECT_EQ(model.images.at(1).name, "P1180141.JPG");
  EXPECT_EQ(model.images.at(1).keypoints_px.size(), 3u);
  EXPECT_EQ(model.points.at(63390).track[0].keypoint, 2u);
}

}  // namespace
}  // namespace sphc::host
