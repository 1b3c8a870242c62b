#include "host/build/map_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

#include "runtime/map/map_view.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

std::string pathOf(const char *name) {
  return testing::TempDir() + "sphc_map_" + std::to_string(getpid()) + "_" + name;
}

SphereCloud randomCloud(size_t count) {
  Random random(4);
  SphereCloud cloud;
  for (size_t i = 0; i < count; ++i) {
    const Vector3 direction = test::randomDirection(&random);
    cloud.points.push_back({direction, test::randomDescriptor(&random)});
  }
  return cloud;
}

constexpr MapId kId = {0xA0, 0xA1, 0xA2, 0xA3, 0xA4, 0xA5, 0xA6, 0xA7,
                       0xA8, 0xA9, 0xAA, 0xAB, 0xAC, 0xAD, 0xAE, 0xAF};

TEST(MapWriter, WritesTheBytesOfTheFormat) {  // against the tests' own writer
  for (size_t count : {16u, 17u, 333u}) {
    const SphereCloud cloud = randomCloud(count);
    std::vector<test::MapPoint> points;
    for (const SpherePoint &p : cloud.points) points.push_back({p.direction, p.descriptor});
    EXPECT_EQ(encodeMap(cloud, kId), test::encodeMap(points, kExtractorId)) << count;
  }
}

TEST(MapWriter, TheReaderGetsBackWhatWasWritten) {
  const SphereCloud cloud = randomCloud(1000);
  const std::vector<uint8_t> file = encodeMap(cloud, kId);
  MapView view;
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  for (uint32_t i = 0; i < 1000; ++i) {
    const Direction d = view.direction(i);
    EXPECT_LT((Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)) -
               cloud.points[i].direction)
                  .norm(),
              7e-5);
    EXPECT_EQ(std::memcmp(&view.descriptors()[i], &cloud.points[i].descriptor, kDescriptorBytes), 0);
  }
}

// 132 bytes a point, and nothing else: no field in which a position, a colour or a count could hide.
TEST(MapWriter, NothingElseOfAPointIsInTheFile) {
  const size_t small = encodeMap(randomCloud(64), kId).size(),
               large = encodeMap(randomCloud(64 + 16 * 64), kId).size();
  EXPECT_EQ(large - small, 16u * 64 * (4 + 128));
}

TEST(MapWriter, FilesAppearWholeOrNotAtAll) {
  const std::string path = pathOf("whole");
  writeFile(path, {1, 2, 3});
  writeFile(path, {4, 5});
  std::ifstream in(path, std::ios::binary);
  EXPECT_EQ(in.get(), 4);
  EXPECT_EQ(in.get(), 5);
  EXPECT_EQ(in.get(), EOF);
  EXPECT_NE(access((path + ".part").c_str(), F_OK), 0);
  unlink(path.c_str());
  EXPECT_THROW(writeFile("/nonexistent-folder/map", {1}), std::runtime_error);
}

TEST(OwnerNote, RoundTrip) {
  const std::string path = pathOf("note");
  const OwnerNote note = {kId, {1.0 / 3, -2e-9, 1e5}, 1.0 / 3, "gaussian"};
  writeOwnerNote(path, note);
  const OwnerNote back = readOwnerNote(path);
  EXPECT_EQ(back.map_id, note.map_id);
  EXPECT_EQ(back.centre_in_world_m, note.centre_in_world_m);
  EXPECT_EQ(back.eta, note.eta);
  EXPECT_EQ(back.strategy, note.strategy);
  unlink(path.c_str());
}

TEST(OwnerNote, EachFaultIsExplained) {
  const std::string path = pathOf("bad_note");
  const char *good = R"("format": "spherecloud-owner-note", "version": 1, "eta": 0.3, "strategy": "gaussian")";
  for (const std::string &text :
       {std::string(), std::string("["), std::string("{}"), std::string(R"({"format": "other", "version": 1})"),
        "{" + std::string(good) + R"(, "map_id": "xyz", "centre_in_world_m": [1, 2, 3]})",
        "{" + std::string(good) + R"(, "map_id": "00112233445566778899aabbccddeeff", "centre_in_world_m": [1, 2]})",
        "{" + std::string(good) +
            R"(, "map_id": "00112233445566778899aabbccddeeff", "centre_in_world_m": [1, 2, "x"]})"}) {
    std::ofstream(path) << text;
    try {
      readOwnerNote(path);
      ADD_FAILURE() << "accepted " << text;
    } catch (const std::runtime_error &error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  }
  unlink(path.c_str());
  EXPECT_THROW(readOwnerNote(path), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
