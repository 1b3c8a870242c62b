#include "host/publish/map_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "runtime/map/map_view.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

std::string mapPath(const char *name) {
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

Vector3 vectorOf(const Direction &d) {
  return {static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)};
}

// A map as the tests' own writer takes it: points in the map's order, and its index.
struct Parts {
  std::vector<test::MapPoint> points;
  test::MapIndex index;
};

Parts partsOf(const MapView &view) {
  Parts parts;
  for (uint32_t i = 0; i < view.pointCount(); ++i)
    parts.points.push_back({vectorOf(view.direction(i)), view.descriptor(i)});
  test::MapIndex &index = parts.index;
  index.sector_side = view.sectorSide();
  const uint32_t sectors = view.sectorSide() * view.sectorSide();
  for (uint32_t c = 0; c < view.cellCount(); ++c) {
    index.centroids.push_back(view.centroids()[c]);
    for (uint32_t s = 0; s < sectors; ++s) index.runs.push_back(view.sectors(c, s, s).begin);
  }
  index.runs.push_back(view.pointCount());
  for (uint32_t g = 0; g < view.groupCount(); ++g) {
    index.group_centroids.push_back(view.groupCentroids()[g]);
    index.groups.push_back(view.group(g).begin);
  }
  index.groups.push_back(view.cellCount());
  return parts;
}

TEST(MapWriter, WritesTheBytesOfTheFormat) {  // against the tests' own writer
  for (size_t count : {16u, 17u, 333u}) {
    const std::vector<uint8_t> file = encodeMap(randomCloud(count), kId);
    MapView view;
    ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
    const Parts parts = partsOf(view);
    EXPECT_EQ(file, test::encodeMap(parts.points, parts.index, kExtractorId)) << count;
  }
}

TEST(MapWriter, WritesTheBand) {
  SphereCloud cloud = randomCloud(16);
  std::vector<uint8_t> visible = encodeMap(cloud, kId);
  cloud.band = SPHC_BAND_INFRARED;
  test::setBand(&visible, SPHC_BAND_INFRARED);
  EXPECT_EQ(encodeMap(cloud, kId), visible);
}

TEST(MapWriter, TheReaderGetsBackWhatWasWritten) {
  SphereCloud cloud = randomCloud(1000);
  const std::vector<uint8_t> file = encodeMap(cloud, kId);
  MapView view;
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  const auto before = [](const Descriptor &a, const Descriptor &b) {
    return std::memcmp(&a, &b, kDescriptorBytes) < 0;
  };
  std::sort(cloud.points.begin(), cloud.points.end(),
            [&](const SpherePoint &a, const SpherePoint &b) { return before(a.descriptor, b.descriptor); });
  std::vector<bool> found(cloud.points.size());
  for (uint32_t i = 0; i < view.pointCount(); ++i) {
    const auto at = std::lower_bound(cloud.points.begin(), cloud.points.end(), view.descriptor(i),
                                     [&](const SpherePoint &point, const Descriptor &descriptor) {
                                       return before(point.descriptor, descriptor);
                                     });
    ASSERT_EQ(std::memcmp(&at->descriptor, &view.descriptor(i), kDescriptorBytes), 0);
    EXPECT_LT((at->direction - vectorOf(view.direction(i))).norm(), 7e-5);
    found[static_cast<size_t>(at - cloud.points.begin())] = true;
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), true), 1000);  // each point once
}

// Of a point 132 bytes, and its part of the index: no field in which a position, a colour or a count could hide.
TEST(MapWriter, NothingElseOfAPointIsInTheFile) {
  for (size_t count : {64u, 1000u}) {
    const std::vector<uint8_t> file = encodeMap(randomCloud(count), kId);
    MapView view;
    ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
    const size_t cells = view.cellCount(), groups = view.groupCount(), side = view.sectorSide();
    const size_t parts =
        256 + (4 + 128) * count + 4 * (cells * side * side + 1) + 128 * cells + 4 * (groups + 1) + 128 * groups;
    EXPECT_GE(file.size(), parts);
    EXPECT_LT(file.size(), parts + 6 * 64);  // zero padding, which the reader checks
  }
}

TEST(MapWriter, AFullMapTakesAtMost160BytesAPoint) {
  const size_t count = 10000;
  EXPECT_LE(encodeMap(randomCloud(count), kId).size(), 160 * count);
}

TEST(OwnerNote, RoundTrip) {
  const std::string path = mapPath("note");
  const OwnerNote note = {kId, {1.0 / 3, -2e-9, 1e5}, 1.0 / 3, "gaussian"};
  writeOwnerNote(path, note);
  const OwnerNote back = readOwnerNote(path);
  EXPECT_EQ(back.map_id, note.map_id);
  EXPECT_EQ(back.centre_in_world_m, note.centre_in_world_m);
  EXPECT_EQ(back.eta, note.eta);
  EXPECT_EQ(back.strategy, note.strategy);
  struct stat facts = {};
  ASSERT_EQ(stat(path.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u) << "others may read where the centre is";
  unlink(path.c_str());
}

TEST(OwnerNote, EachFaultIsExplained) {
  const std::string path = mapPath("bad_note");
  const char *good = R"("format": "spherecloud-owner-note", "version": 1, "eta": 0.3, "strategy": "gaussian")";
  for (const std::string &text :
       {std::string(), std::string("["), std::string("{}"), std::string(R"({"format": "other", "version": 1})"),
        "{" + std::string(good) + R"(, "map_id": "xyz", "centre_in_world_m": [1, 2, 3]})",
        "{" + std::string(good) + R"(, "map_id": "00112233445566778899aabbccddeeff", "centre_in_world_m": [1, 2]})",
        "{" + std::string(good) +
            R"(, "map_id": "00112233445566778899aabbccddeeff", "centre_in_world_m": [1, 2, "x"]})"}) {
    std::ofstream(path) << text;
    EXPECT_THAT(test::refusal([&] { readOwnerNote(path); }), testing::HasSubstr(path)) << text;
  }
  unlink(path.c_str());
  EXPECT_THROW(readOwnerNote(path), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
