#include "host/import/colmap_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "host/base/write_file.h"
#include "host/import/colmap_descriptors.h"
#include "host/import/colmap_world.h"
#include "host/import/upright.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/import/tiny_colmap.h"

namespace sphc::host {
namespace {

using test::binaryFiles;
using test::refusal;
using test::Schema;
using test::textFiles;
using test::tinyColmapModel;
using testing::HasSubstr;

// Depth images of the tiny model's wall, in millimetres.
void writeWall(const std::string &folder, double depth_m) {
  std::filesystem::create_directories(folder + "/sub");
  const cv::Mat wall(72, 96, CV_16UC1, cv::Scalar(1000 * depth_m));
  for (const char *name : {"/a.png", "/b.png", "/sub/c d.png"}) cv::imwrite(folder + name, wall);
}

class ColmapImport : public testing::Test {
 protected:
  ColmapImport() {
    test::writeColmapFiles(folder_.path().string(), binaryFiles(tinyColmapModel(kUnitsPerMetre)));
    test::writeColmapDatabase(folder_ / "database.db", tinyColmapModel(1), Schema::kNew);
    options_.model = folder_.path().string();
    options_.database = folder_ / "database.db";
    options_.descriptors = ColmapDescriptors::kDatabase;
  }
  PointModel import() { return importColmap(options_, nullptr, &summary_); }

  static constexpr double kUnitsPerMetre = 5;
  test::TempFolder folder_;
  ColmapImportOptions options_;
  ColmapImportSummary summary_;
};

TEST_F(ColmapImport, MetresByAKnownScaleAndUpByTheCameras) {
  options_.metres_per_unit = 1 / kUnitsPerMetre;
  const PointModel model = import();
  ASSERT_EQ(model.points.size(), 12u);
  EXPECT_EQ(summary_.images, 3u);
  for (const ModelPoint &point : model.points) {
    EXPECT_NEAR(point.position_m.y(), test::kTinyWallM, 1e-9);  // forward, since z is up now
    EXPECT_LE(std::abs(point.position_m.z()), 0.2 + 1e-9);
    EXPECT_EQ(point.observations, 3u);
    // About one pixel of 60 a radian, over a base of 0.2 m: a matter of decimetres, along the view.
    EXPECT_GT(point.sigma_m, 0.05);
    EXPECT_LT(point.sigma_m, 0.5);
  }
}

// At the side of a pinhole camera's image a pixel is less of an angle, so the same places are known better.
TEST_F(ColmapImport, APixelIsSoMuchOfAPointsSurroundingsAsItsDepthSays) {
  options_.metres_per_unit = 1 / kUnitsPerMetre;
  const PointModel straight = import();
  const Matrix3 turn = Eigen::AngleAxisd(0.9, Vector3::UnitY()).toRotationMatrix();
  ColmapModel model = tinyColmapModel(kUnitsPerMetre);
  double least = 1, most = 0;  // of the depths' shares that are left after the turn
  for (auto &[id, image] : model.images) {
    const Rigid before = image.camera_from_model;
    image.camera_from_model = {turn * before.rotation, turn * before.translation_m};
    for (const auto &[number, point] : model.points) {
      const double share = (image.camera_from_model * point.position).z() / (before * point.position).z();
      least = std::min(least, share);
      most = std::max(most, share);
    }
  }
  ASSERT_LT(most, 0.9);
  test::writeColmapFiles(folder_.path().string(), binaryFiles(model));
  const PointModel turned = import();
  ASSERT_EQ(turned.points.size(), straight.points.size());
  for (size_t i = 0; i < turned.points.size(); ++i) {
    EXPECT_GT(turned.points[i].sigma_m, least * straight.points[i].sigma_m);
    EXPECT_LT(turned.points[i].sigma_m, most * straight.points[i].sigma_m);
  }
}

// Of two keypoints of one image, or of images from one spot, nobody knows how far away it is.
TEST_F(ColmapImport, APointSeenFromOneSpotIsDropped) {
  ColmapModel model = tinyColmapModel(kUnitsPerMetre);
  for (auto &[id, image] : model.images)
    for (int i = 0; i < 2; ++i) image.keypoints_px.push_back(image.keypoints_px.front());
  model.images[4] = model.images[1];
  const Vector3 position = model.points[100].position;
  model.points[200] = {position, {{1, 12}, {1, 13}}};
  model.points[201] = {position, {{1, 12}, {4, 12}}};
  test::writeColmapFiles(folder_.path().string(), binaryFiles(model));
  std::filesystem::remove(folder_ / "database.db");
  test::writeColmapDatabase(folder_ / "database.db", model, Schema::kNew);
  options_.metres_per_unit = 1 / kUnitsPerMetre;
  for (uint32_t least : {1u, 2u}) {
    options_.min_observations = least;
    EXPECT_EQ(import().points.size(), 12u);
    EXPECT_EQ(summary_.points_described, 14u);
  }
}

TEST_F(ColmapImport, TwoKeypointsOfOneImageAreOneThatSawAPoint) {
  ColmapModel model = tinyColmapModel(kUnitsPerMetre);
  model.points[100].track.push_back(model.points[100].track.front());
  test::writeColmapFiles(folder_.path().string(), binaryFiles(model));
  options_.metres_per_unit = 1 / kUnitsPerMetre;
  options_.min_observations = 4;
  EXPECT_EQ(import().points.size(), 0u);
  options_.min_observations = 3;
  for (const ModelPoint &point : import().points) EXPECT_EQ(point.observations, 3u);
}

TEST_F(ColmapImport, MetresByDepthImages) {
  writeWall(folder_.path().string(), test::kTinyWallM);
  options_.depth = folder_.path().string();
  import();
  EXPECT_NEAR(summary_.metres_per_unit, 1 / kUnitsPerMetre, 1e-6);
  EXPECT_LT(summary_.scale_spread, 1e-6);
}

// As 7-Scenes has them: the colour images' own names are none of depth images.
TEST_F(ColmapImport, MetresByDepthImagesBesideColour) {
  ColmapModel model = tinyColmapModel(kUnitsPerMetre);
  std::filesystem::create_directories(folder_ / "sub");
  for (auto &[id, image] : model.images) {
    image.name.insert(image.name.rfind('.'), ".color");
    std::string depth = folder_ / image.name;
    cv::imwrite(depth, cv::Mat(72, 96, CV_8UC3, cv::Scalar(1, 2, 3)));
    cv::imwrite(depth.replace(depth.rfind("color"), 5, "depth"),
                cv::Mat(72, 96, CV_16UC1, cv::Scalar(1000 * test::kTinyWallM)));
  }
  test::writeColmapFiles(folder_.path().string(), binaryFiles(model));
  options_.depth = folder_.path().string();
  import();
  EXPECT_NEAR(summary_.metres_per_unit, 1 / kUnitsPerMetre, 1e-6);
}

TEST_F(ColmapImport, WithoutDepthAtThePointsTheMessageSaysHowImagesAreNamed) {
  options_.depth = folder_ / "nothing";
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("X.png for X.jpg"));
}

TEST_F(ColmapImport, AxesStayOnRequest) {
  options_.metres_per_unit = 1;
  options_.gravity = Vector3(Vector3::Zero());
  import();
  EXPECT_TRUE(summary_.world_from_model_axes.isIdentity());
}

TEST_F(ColmapImport, AFolderWithoutAModelSaysWhichToName) {
  options_.model = "/nonexistent";
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("sparse/0"));
}

TEST_F(ColmapImport, AMissingImageIsNamed) {
  options_.metres_per_unit = 1;
  options_.descriptors = ColmapDescriptors::kAgain;
  options_.images = folder_.path().string();
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png; name COLMAP's folder of images"));
  writeWall(folder_.path().string(), 1);
  cv::imwrite(folder_ / "a.png", cv::Mat(10, 10, CV_8UC1));
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("is 10 x 10, its camera 96 x 72"));
}

// Pixels that are damaged, other files than PNG and JPEG, and depth that is none: each with its cure.
TEST_F(ColmapImport, AnImageThatCannotBeDecodedIsNamed) {
  options_.metres_per_unit = 1;
  options_.descriptors = ColmapDescriptors::kAgain;
  options_.images = folder_.path().string();
  const std::string file = folder_ / "a.png";
  std::vector<uint8_t> bytes;
  cv::imencode(".bmp", cv::Mat(72, 96, CV_8UC1, cv::Scalar(90)), bytes);
  writeFile(file, bytes);
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png is neither PNG nor JPEG; convert it to one of them"));
  cv::imencode(".png", cv::Mat(72, 96, CV_8UC1, cv::Scalar(90)), bytes);
  bytes.resize(bytes.size() - 20);
  writeFile(file, bytes);
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png is cut short; "));
}

TEST_F(ColmapImport, DepthThatIsNoneIsNamed) {
  writeWall(folder_.path().string(), test::kTinyWallM);
  options_.depth = folder_.path().string();
  const std::string file = folder_ / "a.png", not_depth = "a.png is not one of 16 bits and 96 x 72; where depth";
  cv::imwrite(file, cv::Mat(72, 96, CV_8UC1, cv::Scalar(90)));
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr(not_depth));
  cv::imwrite(file, cv::Mat(70, 96, CV_16UC1, cv::Scalar(90)));
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr(not_depth));
  std::vector<uint8_t> bytes;
  cv::imencode(".tiff", cv::Mat(72, 96, CV_16UC1, cv::Scalar(90)), bytes);
  writeFile(file, bytes);
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png cannot be decoded: is no PNG"));
}

// A note of EXIF says how to turn the image for a person, and COLMAP's keypoints are of the image as it is.
TEST_F(ColmapImport, ATurnedImageIsReadAsItIs) {
  std::vector<uint8_t> jpeg;
  cv::imencode(".jpg", cv::Mat(72, 96, CV_8UC1, cv::Scalar(90)), jpeg);
  const std::string quarter_turn(
      "\xff\xe1\x00\x22"
      "Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  jpeg.insert(jpeg.begin() + 2, quarter_turn.begin(), quarter_turn.end());
  std::filesystem::create_directories(folder_ / "sub");
  for (const char *name : {"a.png", "b.png", "sub/c d.png"})
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char *>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
  ASSERT_EQ(cv::imread(folder_ / "a.png").cols, 72) << "of the test";
  options_.metres_per_unit = 1;
  options_.descriptors = ColmapDescriptors::kAgain;
  options_.images = folder_.path().string();
  EXPECT_EQ(import().points.size(), 0u) << "of a grey wall";
}

TEST_F(ColmapImport, APipeInThePlaceOfAnImageIsNotWaitedFor) {
  const std::string pipe = folder_ / "a.png";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  options_.depth = folder_.path().string();
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png is a device or a pipe"));
  options_.depth.clear();
  options_.metres_per_unit = 1;
  options_.descriptors = ColmapDescriptors::kAgain;
  options_.images = folder_.path().string();
  EXPECT_THAT(refusal([this] { import(); }), HasSubstr("a.png is a device or a pipe"));
}

class ColmapDatabase : public testing::TestWithParam<Schema> {};

TEST_P(ColmapDatabase, DescriptorsHaveOurOrientations) {
  const test::TempFolder folder;
  const ColmapModel model = tinyColmapModel(1);
  test::writeColmapDatabase(folder / "d.db", model, GetParam());
  const DescriptorsOfPoints found = describeFromDatabase(model, folder / "d.db");
  ASSERT_EQ(found.size(), 12u);
  const Descriptor &third = found.at(102)[1];  // keypoint 2: bytes 20 to 27 in each cell
  const int turned[] = {20, 27, 26, 25, 24, 23, 22, 21};
  for (size_t i = 0; i < kDescriptorBytes; ++i) EXPECT_EQ(third.bytes[i], turned[i % 8]);
}

TEST_P(ColmapDatabase, OfAnotherModelIsRefused) {
  const test::TempFolder folder;
  ColmapModel fewer = tinyColmapModel(1);
  fewer.images[2].keypoints_px.resize(5);
  test::writeColmapDatabase(folder / "fewer.db", fewer, GetParam());
  fewer.images.erase(2);
  test::writeColmapDatabase(folder / "none.db", fewer, GetParam());
  const auto read = [&folder](const char *name) {
    return refusal([&] { describeFromDatabase(tinyColmapModel(1), folder / name); });
  };
  EXPECT_THAT(read("fewer.db"), HasSubstr("fewer than its keypoints"));
  EXPECT_THAT(read("none.db"), HasSubstr("image 2: are not there"));
}

INSTANTIATE_TEST_SUITE_P(Schema, ColmapDatabase, testing::Values(Schema::kOld, Schema::kNew));

TEST(ColmapDatabaseTypes, LearnedDescriptorsAreRefused) {
  const test::TempFolder folder;
  test::writeColmapDatabase(folder / "d.db", tinyColmapModel(1), Schema::kNew, 1);
  EXPECT_THAT(refusal([&] { describeFromDatabase(tinyColmapModel(1), folder / "d.db"); }),
              HasSubstr("not SIFT; describe the images again"));
}

// Whose first page, with the names of its tables, is as it was.
TEST(ColmapDatabaseTypes, ADamagedOneIsNotTakenForAnotherModels) {
  const test::TempFolder folder;
  const std::string path = folder / "d.db";
  test::writeColmapDatabase(path, tinyColmapModel(1), Schema::kNew);
  const auto size = static_cast<std::streamsize>(std::filesystem::file_size(path));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(4096);
  file << std::string(static_cast<size_t>(size - 4096), '\xff') << std::flush;
  EXPECT_THAT(refusal([&] { describeFromDatabase(tinyColmapModel(1), path); }), HasSubstr("malformed"));
}

TEST(ColmapDatabaseTypes, OtherFilesAreRefused) {
  EXPECT_THAT(refusal([] { describeFromDatabase(tinyColmapModel(1), "/nonexistent.db"); }),
              HasSubstr("database.db"));
}

// Cameras that nod by up to half a radian and turn all around have their x axes level.
TEST(ColmapWorld, DownIsWhereNoXAxisPoints) {
  const Vector3 down = Vector3(1, 2, 3).normalized();
  const Matrix3 model_from_level = uprightAxes(down).transpose();  // -z to down
  ColmapModel model;
  for (uint32_t i = 0; i < 12; ++i) {
    const double yaw = 0.5 * i, nod = 0.5 * std::sin(2.0 * i);
    Matrix3 level_from_camera;  // x right, y down, z forward
    level_from_camera.col(0) = Vector3(std::cos(yaw), std::sin(yaw), 0);
    const Vector3 forward(-std::sin(yaw), std::cos(yaw), 0);
    level_from_camera.col(2) = std::cos(nod) * forward - std::sin(nod) * Vector3::UnitZ();
    level_from_camera.col(1) = level_from_camera.col(2).cross(level_from_camera.col(0));
    model.images[i].camera_from_model.rotation = (model_from_level * level_from_camera).transpose();
  }
  EXPECT_GT(downByCameras(model).dot(down), std::cos(0.01));  // how they nod leaves a quarter of a degree
  EXPECT_NEAR((uprightAxes(down) * down + Vector3::UnitZ()).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace sphc::host
