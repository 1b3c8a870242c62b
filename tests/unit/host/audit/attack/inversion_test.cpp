#include "host/audit/attack/inversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "host/audit/attack/virtual_camera.h"
#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

// As golden_points() of train/export.py.
SeenPoints goldenPoints() {
  SeenPoints seen;
  for (int i = 0; i < 400; ++i) {
    seen.pixels_px.emplace_back(i * 37 % 1280 / 10.0 + 0.02, i * 101 % 1270 / 10.0 + 0.03);
    Descriptor descriptor;
    for (int k = 0; k < 128; ++k) descriptor.bytes[k] = static_cast<uint8_t>((i * 7 + k * 13) % 120);
    seen.descriptors.push_back(descriptor);
    seen.weights.push_back(1);
  }
  return seen;
}

class Networks : public testing::TestWithParam<const char *> {};
INSTANTIATE_TEST_SUITE_P(All, Networks, testing::Values("mixed"),
                         [](const auto &tested) { return std::string(tested.param); });

TEST_P(Networks, PaintAsWhereTheyWereTrained) {
  std::ifstream file(std::string(SPHC_GOLDEN) + "/" + GetParam() + "_golden.csv");
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  const cv::Mat picture = Inverter(SPHC_NETWORKS, GetParam()).paint(goldenPoints());
  int compared = 0;
  for (int x, y; std::getline(file, line); ++compared) {
    char comma;
    double grey;
    ASSERT_TRUE(std::istringstream(line) >> x >> comma >> y >> comma >> grey) << line;
    EXPECT_NEAR(static_cast<double>(picture.at<float>(y, x)), grey, 1e-3) << "at " << x << ", " << y;
  }
  EXPECT_EQ(compared, 25);
}

TEST_P(Networks, DescriptorsAndPlacesMatter) {
  Inverter inverter(SPHC_NETWORKS, GetParam());
  const cv::Mat picture = inverter.paint(goldenPoints());
  SeenPoints others = goldenPoints();
  std::reverse(others.descriptors.begin(), others.descriptors.end());
  EXPECT_GT(cv::norm(picture, inverter.paint(others), cv::NORM_INF), 0.1);
  SeenPoints moved = goldenPoints();
  std::reverse(moved.pixels_px.begin(), moved.pixels_px.end());
  EXPECT_GT(cv::norm(picture, inverter.paint(moved), cv::NORM_INF), 0.1);
}

TEST_P(Networks, NeitherOrderNorScaleOfWeightsInASharedCellMatters) {
  Inverter inverter(SPHC_NETWORKS, GetParam());
  SeenPoints pair, swapped;
  const SeenPoints golden = goldenPoints();
  for (size_t i : {0, 1}) {
    pair.pixels_px.emplace_back(64.5, 64.5);
    pair.descriptors.push_back(golden.descriptors[i]);
    pair.weights.push_back(1);
  }
  swapped = pair;
  std::swap(swapped.descriptors[0], swapped.descriptors[1]);
  EXPECT_LT(cv::norm(inverter.paint(pair), inverter.paint(swapped), cv::NORM_INF), 1e-4);
}

TEST(Inverter, NothingSeenIsGrey) { EXPECT_EQ(cv::countNonZero(Inverter(SPHC_NETWORKS, "mixed").paint({})), 0); }

TEST(Inverter, AMissingNetworkIsNamed) {
  try {
    Inverter("/nowhere", "mixed");
    FAIL();
  } catch (const std::runtime_error &failure) {
    EXPECT_THAT(failure.what(), testing::HasSubstr("/nowhere/mixed.embedding.onnx"));
  }
}

TEST(See, KeepsWhatIsInViewAndBelieved) {
  Rigid camera_from_map;
  camera_from_map.rotation = Eigen::AngleAxisd(kPi / 2, Vector3::UnitY()).toRotationMatrix();
  // Looks along -x: ahead, behind, beyond the field of 50 degrees, not believed in.
  const std::vector<Vector3> directions = {{-1, 0, 0}, {1, 0, 0}, {-1, 0.5, 0}, {-1, 0, 0.1}};
  std::vector<Descriptor> descriptors(4);
  descriptors[0].bytes[5] = 77;
  const SeenPoints seen = see(directions, descriptors, {0.5f, 1, 1, 0}, camera_from_map);
  ASSERT_EQ(seen.pixels_px.size(), 1u);
  EXPECT_NEAR((seen.pixels_px[0] - Vector2(64, 64)).norm(), 0, 1e-9);
  EXPECT_EQ(seen.descriptors[0].bytes[5], 77);
  EXPECT_EQ(seen.weights[0], 0.5f);
  EXPECT_EQ(see(directions, descriptors, {}, camera_from_map).pixels_px.size(), 2u);
}

TEST(See, PositionsAreMovedDirectionsAreNot) {
  Rigid camera_from_map;
  camera_from_map.translation_m = Vector3(0, 0, 1);
  const SeenPoints seen = see({{0.2, 0, 1}}, std::vector<Descriptor>(1), {}, camera_from_map);
  ASSERT_EQ(seen.pixels_px.size(), 1u);
  EXPECT_NEAR(seen.pixels_px[0].x(), 64 + 0.1 * VirtualCamera::kFocalPx, 1e-9);
}

TEST(See, RefusesListsThatDoNotBelongTogether) {
  EXPECT_THROW(see({{0, 0, 1}}, {}, {}, {}), std::invalid_argument);
  EXPECT_THROW(see({{0, 0, 1}}, std::vector<Descriptor>(1), {1, 1}, {}), std::invalid_argument);
}

TEST(VirtualCamera, ItsFieldIsFiftyDegrees) {
  const double half = std::atan(VirtualCamera::kSide / 2 / VirtualCamera::kFocalPx);
  EXPECT_NEAR(2 * half * 180 / kPi, 50, 1e-4);
}

}  // namespace
}  // namespace sphc::host
