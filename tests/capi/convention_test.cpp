#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/bytes.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::Output;

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
const sphc_rigid kIdentity = {{1, 0, 0, 0}, {0, 0, 0}};
const sphc_convention kAll[] = {SPHC_CONVENTION_OPENXR,  SPHC_CONVENTION_UNITY,  SPHC_CONVENTION_ROS_OPTICAL,
                                SPHC_CONVENTION_ROS_FLU, SPHC_CONVENTION_COLMAP, SPHC_CONVENTION_TUM};

bool needsWorld(sphc_convention convention) {
  return convention != SPHC_CONVENTION_COLMAP && convention != SPHC_CONVENTION_TUM;
}

// A row of conventions.csv; what is empty there is absent.
struct Vector {
  std::string scene;
  sphc_convention convention;
  std::vector<double> up_map, world_from_map, camera_from_map, camera_pose, map_pose;
};

sphc_convention conventionNamed(const std::string &name) {
  for (const sphc_convention convention : kAll)
    if (sphc_convention_name(convention) == "SPHC_CONVENTION_" + name) return convention;
  return 0;
}

std::vector<double> numbersOf(std::istream &line, int count) {
  std::vector<double> numbers;
  std::string cell;
  for (int i = 0; i < count; ++i) {
    std::getline(line, cell, ',');
    if (!cell.empty()) numbers.push_back(std::stod(cell));
  }
  EXPECT_TRUE(numbers.empty() || numbers.size() == static_cast<size_t>(count));
  return numbers;
}

std::vector<Vector> vectors() {
  std::ifstream file(SPHC_CONVENTIONS);
  std::string text, name;
  std::getline(file, text);
  std::vector<Vector> all;
  while (std::getline(file, text)) {
    std::istringstream line(text);
    Vector one;
    std::getline(line, one.scene, ',');
    std::getline(line, name, ',');
    one.convention = conventionNamed(name);
    one.up_map = numbersOf(line, 3);
    one.world_from_map = numbersOf(line, 7);
    one.camera_from_map = numbersOf(line, 7);
    one.camera_pose = numbersOf(line, 7);
    one.map_pose = numbersOf(line, 7);
    all.push_back(one);
  }
  return all;
}

sphc_rigid rigidOf(const std::vector<double> &numbers) {
  sphc_rigid rigid = kIdentity;
  for (size_t i = 0; i < numbers.size(); ++i) (i < 4 ? rigid.q_wxyz[i] : rigid.t_m[i - 4]) = numbers[i];
  return rigid;
}

// The places of qw qx qy qz x y z in a pose.
std::vector<int> orderOf(sphc_convention convention) {
  if (convention == SPHC_CONVENTION_OPENXR) return {3, 0, 1, 2, 4, 5, 6};
  if (convention == SPHC_CONVENTION_COLMAP) return {0, 1, 2, 3, 4, 5, 6};
  return {6, 3, 4, 5, 0, 1, 2};
}

void expectNear(const sphc_rigid &is, const sphc_rigid &wanted, double tolerance) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(is.q_wxyz[i], wanted.q_wxyz[i], tolerance) << i;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(is.t_m[i], wanted.t_m[i], tolerance) << i;
}
void expectNear(const double pose[7], const std::vector<double> &wanted, double tolerance) {
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(pose[i], wanted[i], tolerance) << i;
}

TEST(CInterfaceConvention, VectorsHoldInBothDirections) {
  std::map<sphc_convention, int> seen;
  for (const Vector &v : vectors()) {
    SCOPED_TRACE(v.scene + ", " + sphc_convention_name(v.convention));
    ++seen[v.convention];
    const sphc_rigid world = rigidOf(v.world_from_map), camera = rigidOf(v.camera_from_map);
    const sphc_rigid *world_from_map = v.world_from_map.empty() ? nullptr : &world;
    sphc_message message = {};
    sphc_rigid made = {};
    double pose[7];
    if (!v.up_map.empty()) {
      ASSERT_EQ(sphc_convention_make_world(v.convention, v.up_map.data(), &made, &message), SPHC_OK);
      expectNear(made, world, 1e-12);
    }
    ASSERT_EQ(sphc_convention_write_camera(v.convention, world_from_map, &camera, pose, &message), SPHC_OK);
    expectNear(pose, v.camera_pose, 1e-12);
    ASSERT_EQ(sphc_convention_read_camera(v.convention, world_from_map, v.camera_pose.data(), &made, &message),
              SPHC_OK);
    expectNear(made, camera, 1e-12);
    ASSERT_EQ(sphc_convention_write_map(v.convention, &world, pose, &message), SPHC_OK);
    expectNear(pose, v.map_pose, 1e-12);
    ASSERT_EQ(sphc_convention_read_map(v.convention, v.map_pose.data(), &made, &message), SPHC_OK);
    expectNear(made, world, 1e-12);
    EXPECT_STREQ(message.text, "");
  }
  for (const sphc_convention convention : kAll) EXPECT_GE(seen[convention], 10);
}

// As Unity's own constructor of an XrPosef has it: z of the position, and x and y of the rotation, change their
// sign.
TEST(CInterfaceConvention, UnityIsOpenXrMirrored) {
  const int sign_in_unity[7] = {-1, -1, 1, 1, 1, 1, -1}, place[7] = {3, 4, 5, 6, 0, 1, 2};
  for (const Vector &v : vectors()) {
    if (v.convention != SPHC_CONVENTION_OPENXR) continue;
    const sphc_rigid world = rigidOf(v.world_from_map), camera = rigidOf(v.camera_from_map);
    double unity[7], openxr[7], camera_in_openxr[7];
    ASSERT_EQ(sphc_convention_write_map(SPHC_CONVENTION_UNITY, &world, unity, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_convention_write_map(SPHC_CONVENTION_OPENXR, &world, openxr, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_convention_write_camera(SPHC_CONVENTION_OPENXR, &world, &camera, camera_in_openxr, nullptr),
              SPHC_OK);
    double camera_in_unity[7];
    ASSERT_EQ(sphc_convention_write_camera(SPHC_CONVENTION_UNITY, &world, &camera, camera_in_unity, nullptr),
              SPHC_OK);
    // A half turn's quaternion may come out with the other sign.
    for (const auto &[theirs, mirrored] :
         {std::pair(openxr, unity), std::pair(camera_in_openxr, camera_in_unity)}) {
      double dot = 0;
      for (int i = 0; i < 4; ++i) dot += sign_in_unity[i] * theirs[i] * mirrored[place[i]];
      for (int i = 0; i < 7; ++i)
        EXPECT_NEAR(mirrored[place[i]], (i < 4 && dot < 0 ? -1 : 1) * sign_in_unity[i] * theirs[i], 1e-14) << i;
    }
  }
}

TEST(CInterfaceConvention, ColmapStatesWhatTheLocalizerAnswers) {
  const sphc_rigid camera_from_map = {{0.8, 0, 0.6, 0}, {1, -2, 3}};
  double pose[7];
  ASSERT_EQ(sphc_convention_write_camera(SPHC_CONVENTION_COLMAP, nullptr, &camera_from_map, pose, nullptr),
            SPHC_OK);
  expectNear(rigidOf(std::vector<double>(pose, pose + 7)), camera_from_map, 1e-15);
}

TEST(CInterfaceConvention, OdometryIsReadInItsOwnWorld) {  // which is no map
  const double looks_to_minus_z[7] = {0, 0, 0, 1, 2, 1.5, -3};
  sphc_rigid camera_from_odometry, odometry_from_camera;
  ASSERT_EQ(sphc_convention_read_camera(SPHC_CONVENTION_OPENXR, &kIdentity, looks_to_minus_z, &camera_from_odometry,
                                        nullptr),
            SPHC_OK);
  sphc_rigid_inverse(&camera_from_odometry, &odometry_from_camera);
  const double ahead[3] = {0, 0, 1};
  double seen[3];
  sphc_rigid_apply(&odometry_from_camera, ahead, seen);
  EXPECT_NEAR(seen[0], 2, 1e-15);
  EXPECT_NEAR(seen[1], 1.5, 1e-15);
  EXPECT_NEAR(seen[2], -4, 1e-15);
}

TEST(CInterfaceConvention, NoZeroHasASign) {  // which reads badly in a line of text
  const auto expectPlain = [](const double *numbers, int count) {
    for (int i = 0; i < count; ++i) EXPECT_FALSE(numbers[i] == 0 && std::signbit(numbers[i])) << i;
  };
  for (const Vector &v : vectors()) {
    SCOPED_TRACE(v.scene + ", " + sphc_convention_name(v.convention));
    const sphc_rigid world = rigidOf(v.world_from_map), camera = rigidOf(v.camera_from_map);
    double pose[7];
    ASSERT_EQ(sphc_convention_write_camera(v.convention, &world, &camera, pose, nullptr), SPHC_OK);
    expectPlain(pose, 7);
    ASSERT_EQ(sphc_convention_write_map(v.convention, &world, pose, nullptr), SPHC_OK);
    expectPlain(pose, 7);
    if (v.up_map.empty()) continue;
    sphc_rigid made;
    ASSERT_EQ(sphc_convention_make_world(v.convention, v.up_map.data(), &made, nullptr), SPHC_OK);
    expectPlain(made.q_wxyz, 4);
  }
}

TEST(CInterfaceConvention, SinglePrecisionIsEnoughToRead) {
  const double up_map[3] = {0.1, 0.9, -0.3};
  const sphc_rigid camera_from_map = {{0.5, -0.1, 0.7, 0.5}, {1.25, -2, 3}};  // of length 1
  for (const sphc_convention convention : kAll) {
    sphc_rigid world_from_map, back;
    double pose[7];
    ASSERT_EQ(sphc_convention_make_world(convention, up_map, &world_from_map, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_convention_write_camera(convention, &world_from_map, &camera_from_map, pose, nullptr), SPHC_OK);
    for (double &number : pose) number = static_cast<double>(static_cast<float>(number));
    ASSERT_EQ(sphc_convention_read_camera(convention, &world_from_map, pose, &back, nullptr), SPHC_OK);
    double length = 0;
    for (const double q : back.q_wxyz) length += q * q;
    EXPECT_NEAR(length, 1, 1e-15);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(back.q_wxyz[i], camera_from_map.q_wxyz[i], 1e-6);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back.t_m[i], camera_from_map.t_m[i], 1e-6);
  }
}

TEST(CInterfaceConvention, AnUnknownOneIsNoArgumentOfToday) {
  const double up_map[3] = {0, 0, 1}, numbers[7] = {0, 0, 0, 1, 0, 0, 0};
  for (const sphc_convention none : {0, -1, 7, std::numeric_limits<int32_t>::max()}) {
    sphc_message message = {};
    Output<sphc_rigid> rigid;
    Output<double[7]> pose;
    EXPECT_EQ(sphc_convention_make_world(none, up_map, rigid.get(), &message), SPHC_E_UNSUPPORTED);
    expectMentions(message.text, "is none that");
    EXPECT_EQ(sphc_convention_write_camera(none, &kIdentity, &kIdentity, *pose.get(), nullptr), SPHC_E_UNSUPPORTED);
    EXPECT_EQ(sphc_convention_read_camera(none, &kIdentity, numbers, rigid.get(), nullptr), SPHC_E_UNSUPPORTED);
    EXPECT_EQ(sphc_convention_write_map(none, &kIdentity, *pose.get(), nullptr), SPHC_E_UNSUPPORTED);
    EXPECT_EQ(sphc_convention_read_map(none, numbers, rigid.get(), nullptr), SPHC_E_UNSUPPORTED);
    EXPECT_TRUE(rigid.untouched());
    EXPECT_TRUE(pose.untouched());
  }
}

// What may be wrong with a pose of ours, and what is said of it.
struct SpoiledRigid {
  sphc_rigid rigid;
  int place;  // the number that is wrong, of w x y z and the translation; 0: the quaternion's length
  std::string words;
};
const SpoiledRigid kSpoiled[] = {
    {{{0, 0, 0, 0}, {0, 0, 0}}, 0, "has length 0; it must be 1"},
    {{{1.002, 0, 0, 0}, {0, 0, 0}}, 0, "has length 1.002; it must be 1"},
    {{{0.998, 0, 0, 0}, {0, 0, 0}}, 0, "has length 0.998; it must be 1"},
    {{{1, 0, kNan, 0}, {0, 0, 0}}, 0, "has length nan; it must be 1"},
    {{{1, 0, 0, -kInf}, {0, 0, 0}}, 0, "has length inf; it must be 1"},
    {{{1, 0, 0, 0}, {0, kNan, 0}}, 5, "is nan; it must lie in"},
    {{{1, 0, 0, 0}, {0, 0, kInf}}, 6, "is inf; it must lie in"},
    {{{1, 0, 0, 0}, {-1.1e9, 0, 0}}, 4, "is -1100000000; it must lie in -1000000000 to 1000000000"},
};

TEST(CInterfaceConvention, BadTransformsAreRefused) {
  for (const sphc_convention convention : kAll)
    for (const SpoiledRigid &spoiled : kSpoiled) {
      sphc_message message = {};
      Output<double[7]> pose;
      const bool of_length = spoiled.place == 0;
      const auto expectSaid = [&](const std::string &what) {
        expectMentions(message.text, (what + " " + spoiled.words).c_str());
      };
      const std::string field = of_length ? ".q_wxyz" : ".t_m[" + std::to_string(spoiled.place - 4) + "]";
      EXPECT_EQ(sphc_convention_write_camera(convention, &kIdentity, &spoiled.rigid, *pose.get(), &message),
                SPHC_E_ARGUMENT);
      expectSaid("camera_from_map" + field);
      EXPECT_EQ(sphc_convention_write_camera(convention, &spoiled.rigid, &kIdentity, *pose.get(), &message),
                SPHC_E_ARGUMENT);
      expectSaid("world_from_map" + field);
      EXPECT_EQ(sphc_convention_write_map(convention, &spoiled.rigid, *pose.get(), &message), SPHC_E_ARGUMENT);
      expectSaid("world_from_map" + field);
      EXPECT_TRUE(pose.untouched());

      const double good[7] = {0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5};  // in every order
      Output<sphc_rigid> rigid;
      EXPECT_EQ(sphc_convention_read_camera(convention, &spoiled.rigid, good, rigid.get(), &message),
                SPHC_E_ARGUMENT);
      expectSaid("world_from_map" + field);
      double numbers[7];
      const std::vector<int> order = orderOf(convention);
      for (int i = 0; i < 7; ++i) numbers[order[i]] = i < 4 ? spoiled.rigid.q_wxyz[i] : spoiled.rigid.t_m[i - 4];
      const std::string in_pose =
          of_length ? "the quaternion of pose" : "pose[" + std::to_string(order[spoiled.place]) + "]";
      EXPECT_EQ(sphc_convention_read_camera(convention, &kIdentity, numbers, rigid.get(), &message),
                SPHC_E_ARGUMENT);
      expectSaid(in_pose);
      EXPECT_EQ(sphc_convention_read_map(convention, numbers, rigid.get(), &message), SPHC_E_ARGUMENT);
      expectSaid(in_pose);
      EXPECT_TRUE(rigid.untouched());
    }
}

// By its place in the caller's own numbers.
TEST(CInterfaceConvention, ABadNumberOfAPoseIsNamed) {
  for (const sphc_convention convention : kAll) {
    const int first = convention == SPHC_CONVENTION_OPENXR || convention == SPHC_CONVENTION_COLMAP ? 4 : 0;
    double numbers[7] = {0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5};  // good in every order
    numbers[first + 2] = kNan;
    sphc_rigid rigid;
    sphc_message message = {};
    EXPECT_EQ(sphc_convention_read_map(convention, numbers, &rigid, &message), SPHC_E_ARGUMENT);
    expectMentions(message.text, ("pose[" + std::to_string(first + 2) + "] is nan").c_str());
  }
}

TEST(CInterfaceConvention, LimitsAreTaken) {
  const sphc_rigid far = {{1 + 0.99 * SPHC_CONVENTION_MAX_LENGTH_ERROR, 0, 0, 0},
                          {SPHC_CONVENTION_MAX_OFFSET_M, -SPHC_CONVENTION_MAX_OFFSET_M, 0}};
  double pose[7];
  for (const sphc_convention convention : kAll) {
    EXPECT_EQ(sphc_convention_write_map(convention, &far, pose, nullptr), SPHC_OK);
    EXPECT_EQ(sphc_convention_write_camera(convention, &far, &far, pose, nullptr), SPHC_OK);
    for (const double number : pose) EXPECT_TRUE(std::isfinite(number));
  }
}

TEST(CInterfaceConvention, NumbersInAnotherOrderAreToldTheirOwn) {
  const double ros[7] = {1, 2, 3, 0, 0, 0, 1};
  sphc_rigid rigid;
  sphc_message message = {};
  EXPECT_EQ(sphc_convention_read_map(SPHC_CONVENTION_OPENXR, ros, &rigid, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "(order qx qy qz qw x y z");
  EXPECT_EQ(sphc_convention_read_map(SPHC_CONVENTION_COLMAP, ros, &rigid, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "(order qw qx qy qz x y z");
  const double openxr[7] = {0, 0, 0, 1, 1, 2, 3};
  EXPECT_EQ(sphc_convention_read_map(SPHC_CONVENTION_UNITY, openxr, &rigid, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "(order x y z qx qy qz qw");
}

TEST(CInterfaceConvention, AVerticalIsNotForgotten) {
  const double good[7] = {0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5};
  for (const sphc_convention convention : kAll) {
    Output<double[7]> pose;
    Output<sphc_rigid> camera;
    sphc_message message = {};
    const sphc_status status = needsWorld(convention) ? SPHC_E_ARGUMENT : SPHC_OK;
    EXPECT_EQ(sphc_convention_write_camera(convention, nullptr, &kIdentity, *pose.get(), &message), status);
    if (status != SPHC_OK) expectMentions(message.text, "sphc_convention_make_world");
    EXPECT_EQ(sphc_convention_read_camera(convention, nullptr, good, camera.get(), &message), status);
    EXPECT_EQ(pose.untouched(), needsWorld(convention));
    EXPECT_EQ(camera.untouched(), needsWorld(convention));
    EXPECT_EQ(sphc_convention_write_map(convention, nullptr, *pose.get(), &message), SPHC_E_ARGUMENT);
    expectMentions(message.text, "world_from_map is null");
  }
}

TEST(CInterfaceConvention, NullIsRefused) {
  const double good[7] = {0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5};
  for (const sphc_convention convention : kAll) {
    sphc_rigid rigid;
    double pose[7];
    sphc_message message = {};
    EXPECT_EQ(sphc_convention_write_camera(convention, &kIdentity, nullptr, pose, &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, "camera_from_map is null; give one");
    EXPECT_EQ(sphc_convention_write_camera(convention, &kIdentity, &kIdentity, nullptr, &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, "pose is null; give one");
    EXPECT_EQ(sphc_convention_read_camera(convention, &kIdentity, nullptr, &rigid, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_read_camera(convention, &kIdentity, good, nullptr, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_write_map(convention, &kIdentity, nullptr, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_read_map(convention, nullptr, &rigid, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_read_map(convention, good, nullptr, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_make_world(convention, good, nullptr, &message), SPHC_E_ARGUMENT);
    EXPECT_EQ(sphc_convention_make_world(convention, nullptr, &rigid, &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, "up_map is null; give one");
    EXPECT_EQ(sphc_convention_make_world(convention, nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  }
}

TEST(CInterfaceConvention, UpIsADirection) {
  const double bad[][3] = {{0, 0, 0}, {kNan, 0, 1}, {0, -kInf, 0}, {0, 1, kNan}};
  for (const auto &up_map : bad) {
    Output<sphc_rigid> world_from_map;
    sphc_message message = {};
    EXPECT_EQ(sphc_convention_make_world(SPHC_CONVENTION_UNITY, up_map, world_from_map.get(), &message),
              SPHC_E_ARGUMENT);
    expectMentions(message.text, "it must be finite and not 0");
    EXPECT_TRUE(world_from_map.untouched());
  }
}

TEST(CInterfaceConvention, AnOutputMayBeAnInput) {
  const double up_map[3] = {0.2, -0.7, 0.1};
  const sphc_rigid camera_from_map = {{0.1, -0.7, 0.5, 0.5}, {1, -2, 3}};
  for (const sphc_convention convention : kAll) {
    sphc_rigid world, camera;
    double pose[7];
    ASSERT_EQ(sphc_convention_make_world(convention, up_map, &world, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_convention_write_camera(convention, &world, &camera_from_map, pose, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_convention_read_camera(convention, &world, pose, &camera, nullptr), SPHC_OK);
    sphc_rigid same = world;
    ASSERT_EQ(sphc_convention_read_camera(convention, &same, pose, &same, nullptr), SPHC_OK);
    expectNear(same, camera, 0);
  }
}

TEST(CInterfaceConvention, WrapperCarriesTheMessage) {
  sphc_rigid world_from_map = {}, camera_from_map = {};
  std::array<double, 7> pose = {};
  ASSERT_TRUE(spherecloud::makeWorld(SPHC_CONVENTION_UNITY, {0, 0, 1}, &world_from_map).ok());
  const sphc_rigid looks_along_x = {{0.5, 0.5, -0.5, 0.5}, {0, 1, 0}};
  ASSERT_TRUE(spherecloud::writeCamera(SPHC_CONVENTION_UNITY, &world_from_map, looks_along_x, &pose).ok());
  EXPECT_NEAR(pose[4], std::sqrt(0.5), 1e-15);
  ASSERT_TRUE(spherecloud::readCamera(SPHC_CONVENTION_UNITY, &world_from_map, pose, &camera_from_map).ok());
  expectNear(camera_from_map, looks_along_x, 1e-15);
  ASSERT_TRUE(spherecloud::writeMap(SPHC_CONVENTION_UNITY, world_from_map, &pose).ok());
  ASSERT_TRUE(spherecloud::readMap(SPHC_CONVENTION_UNITY, pose, &camera_from_map).ok());
  expectNear(camera_from_map, world_from_map, 1e-15);
  const spherecloud::Status refused =
      spherecloud::writeCamera(SPHC_CONVENTION_ROS_FLU, nullptr, looks_along_x, &pose);
  EXPECT_TRUE(refused.failed());
  expectMentions(refused.text(), "world_from_map is null");
}

}  // namespace
