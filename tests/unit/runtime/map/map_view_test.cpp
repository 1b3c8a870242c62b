#include "runtime/map/map_view.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"

namespace sphc {
namespace {

using Bytes = std::vector<uint8_t>;
using test::put32;
using test::put64;

constexpr uint32_t kPoints = 20;
constexpr size_t kFirstEntry = 64, kSecondEntry = 96, kDirections = 256;
constexpr uint32_t kRunSection = 2, kGroupSection = 4;

// Where a section's bytes begin.
size_t placeOf(const Bytes &file, uint32_t section) {
  return static_cast<size_t>(test::get64(file, kFirstEntry + 32 * section + 8));
}

// Opens a copy that ends exactly where the file does, so that a sanitizer sees a step too far.
sphc_status open(const Bytes &file, std::string *text = nullptr) {
  sphc_message message = {};
  MapView view;
  const std::unique_ptr<uint64_t[]> memory(new uint64_t[file.size() / 8 + 1]);
  uint8_t *copy = reinterpret_cast<uint8_t *>(memory.get());
  if (!file.empty()) std::memcpy(copy, file.data(), file.size());
  const sphc_status status = MapView::open(copy, file.size(), kExtractorId, &view, &message);
  if (status == SPHC_OK) {
    for (uint32_t i = 0; i < view.pointCount(); ++i) (void)view.direction(i);
    for (uint32_t g = 0; g < view.groupCount(); ++g) EXPECT_LE(view.group(g).end, view.cellCount());
    for (uint32_t c = 0; c < view.cellCount(); ++c) EXPECT_LE(view.cell(c).end, view.pointCount());
  }
  if (status != SPHC_OK) {  // a caller of the C interface is told the same
    alignas(8) unsigned char state[SPHC_MAP_BYTES_MAX];
    sphc_message told = {};
    sphc_map *map = nullptr;
    EXPECT_EQ(sphc_map_init(state, sizeof state, copy, file.size(), &map, &told), status);
    EXPECT_STREQ(told.text, message.text);
  }
  if (text) *text = message.text;
  return status;
}

TEST(MapView, ReadsWhatWasWritten) {
  const Bytes file = test::randomMap(kPoints, 1);
  MapView view;
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  EXPECT_EQ(view.pointCount(), kPoints);
  EXPECT_EQ(view.descriptors().size(), kPoints);
  EXPECT_EQ(view.header().map_id[0], 0xA0);
  // in place: no copy
  EXPECT_EQ(static_cast<const void *>(&view.header()), file.data());
  EXPECT_EQ(static_cast<const void *>(view.groupCentroids().end()), file.data() + file.size());
  EXPECT_EQ(static_cast<const void *>(view.descriptors().data()), file.data() + placeOf(file, 1));
  EXPECT_EQ(&view.descriptor(7), &view.descriptors()[7]);
}

TEST(MapView, TellsItsBand) {
  Bytes file = test::randomMap(kPoints, 1);
  MapView view;
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  EXPECT_EQ(view.band(), SPHC_BAND_VISIBLE);  // as in files of before there were bands
  test::setBand(&file, SPHC_BAND_INFRARED);
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  EXPECT_EQ(view.band(), SPHC_BAND_INFRARED);
  EXPECT_EQ(view.header().version, 2u);
}

TEST(MapView, EveryTruncationIsRefused) {
  const Bytes file = test::randomMap(kPoints, 2);
  for (size_t length = 0; length < file.size(); ++length) {
    std::string text;
    const sphc_status status = open(Bytes(file.begin(), file.begin() + static_cast<ptrdiff_t>(length)), &text);
    ASSERT_EQ(status, SPHC_E_MAP_FORMAT) << length;
    ASSERT_FALSE(text.empty());
  }
}

TEST(MapView, EveryTruncationWithAForgedSizeIsRefused) {
  const Bytes file = test::randomMap(kPoints, 3);
  for (size_t length = 64; length < file.size(); ++length) {
    Bytes cut(file.begin(), file.begin() + static_cast<ptrdiff_t>(length));
    put64(&cut, 16, length);
    test::signHeader(&cut);
    ASSERT_EQ(open(cut), SPHC_E_MAP_FORMAT) << length << ": what is not there has no checksum";
  }
}

TEST(MapView, EveryFlippedBitIsRefused) {
  Bytes file = test::randomMap(16, 4);
  for (size_t at = 0; at < file.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      file[at] = static_cast<uint8_t>(file[at] ^ (1 << bit));
      ASSERT_LT(open(file), 0) << "byte " << at << " bit " << bit;
      file[at] = static_cast<uint8_t>(file[at] ^ (1 << bit));
    }
  }
  EXPECT_EQ(open(file), SPHC_OK);
}

void setOffset(Bytes *file, uint32_t section, size_t element, uint32_t value) {
  put32(file, placeOf(*file, section) + 4 * element, value);
  test::signSection(file, section);
}

// The opposite direction of a point: it lies in another sector.
void turnAround(Bytes *file, size_t point) {
  const size_t at = kDirections + 4 * point;
  const uint32_t packed = test::get32(*file, at), u = packed & 0xFFFF, v = packed >> 16;
  put32(file, at, (u < 32768 ? 65535 : 1) | ((v < 32768 ? 65535u : 1u) << 16));
  test::signSection(file, 0);
}

struct Corruption {
  const char *name;
  void (*spoil)(Bytes *file);
  sphc_status status;
  const char *words;
};

// Checksums are made right again, so that each reaches its own check.
const Corruption kCorruptions[] = {
    {"signature", [](Bytes *f) { (*f)[0] = 'S'; }, SPHC_E_MAP_FORMAT, "signature"},
    {"text mode", [](Bytes *f) { (*f)[5] = '\n'; }, SPHC_E_MAP_FORMAT, "signature"},
    {"newer", [](Bytes *f) { put32(f, 8, 3), test::signHeader(f); }, SPHC_E_MAP_VERSION, "version 3"},
    {"older", [](Bytes *f) { put32(f, 8, 1), test::signHeader(f); }, SPHC_E_MAP_VERSION, "version 1"},
    {"unknown band", [](Bytes *f) { test::setBand(f, 2); }, SPHC_E_MAP_VERSION, "band 2"},
    {"band of all bits", [](Bytes *f) { test::setBand(f, 0xFFFF); }, SPHC_E_MAP_VERSION, "band 65535"},
    {"extractor", [](Bytes *f) { put32(f, 12, 77), test::signHeader(f); }, SPHC_E_MAP_EXTRACTOR, "extractor 77"},
    {"oversized", [](Bytes *f) { f->push_back(0); }, SPHC_E_MAP_FORMAT, "were given"},
    {"oversized, signed",
     [](Bytes *f) {
       f->push_back(0);
       put64(f, 16, f->size());
       test::signHeader(f);
     },
     SPHC_E_MAP_FORMAT, "after its last section"},
    {"huge size", [](Bytes *f) { put64(f, 16, ~0ull), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "bytes"},
    {"no sections", [](Bytes *f) { put32(f, 28, 0); }, SPHC_E_MAP_FORMAT, "section count 0"},
    {"one section less", [](Bytes *f) { put32(f, 28, 5); }, SPHC_E_MAP_FORMAT, "section count 5"},
    {"one section more", [](Bytes *f) { put32(f, 28, 7); }, SPHC_E_MAP_FORMAT, "section count 7"},
    {"countless sections", [](Bytes *f) { put32(f, 28, 0x08000000); }, SPHC_E_MAP_FORMAT, "section count"},
    {"header checksum", [](Bytes *f) { (*f)[40] ^= 1; }, SPHC_E_MAP_CHECKSUM, "header"},
    {"table checksum", [](Bytes *f) { (*f)[kFirstEntry + 24] ^= 1; }, SPHC_E_MAP_CHECKSUM, "table"},
    {"no cells", [](Bytes *f) { put32(f, 48, 0), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "index of 0 cells"},
    {"many cells", [](Bytes *f) { put32(f, 48, 4097), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "4097 cells"},
    {"one cell more", [](Bytes *f) { put32(f, 48, 6), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "section 2"},
    {"no groups", [](Bytes *f) { put32(f, 52, 0), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "in 0 groups"},
    {"more groups than cells", [](Bytes *f) { put32(f, 52, 6), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "in 6 groups"},
    {"many groups", [](Bytes *f) { put32(f, 48, 999), put32(f, 52, 257), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "in 257 groups"},
    {"one group more", [](Bytes *f) { put32(f, 52, 3), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "section 4"},
    {"no sectors", [](Bytes *f) { put32(f, 56, 0), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "side 0"},
    {"odd sectors", [](Bytes *f) { put32(f, 56, 3), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "side 3"},
    {"many sectors", [](Bytes *f) { put32(f, 56, 64), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "side 64"},
    {"finer sectors", [](Bytes *f) { put32(f, 56, 8), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "section 2"},
    {"too few points", [](Bytes *f) { put32(f, 24, 15), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "15 points; allowed"},
    {"too many points", [](Bytes *f) { put32(f, 24, (1u << 24) + 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "16777217 points; allowed"},
    {"one point more", [](Bytes *f) { put32(f, 24, kPoints + 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"unknown type", [](Bytes *f) { put32(f, kFirstEntry, 9), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "type 9"},
    {"type twice", [](Bytes *f) { put32(f, kSecondEntry, 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "type 1"},
    {"element size", [](Bytes *f) { put32(f, kFirstEntry + 4, 8), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"offset", [](Bytes *f) { put64(f, kSecondEntry + 8, 320), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 1"},
    {"wild offset", [](Bytes *f) { put64(f, kSecondEntry + 8, ~63ull), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 1"},
    {"section bytes", [](Bytes *f) { put64(f, kFirstEntry + 16, 4), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"reserved entry", [](Bytes *f) { put32(f, kFirstEntry + 28, 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"padding", [](Bytes *f) { (*f)[kDirections + 4 * kPoints] = 1; }, SPHC_E_MAP_FORMAT, "padding"},
    {"last padding byte", [](Bytes *f) { (*f)[383] = 1; }, SPHC_E_MAP_FORMAT, "padding"},
    {"directions", [](Bytes *f) { (*f)[kDirections + 2] ^= 4; }, SPHC_E_MAP_CHECKSUM, "section 0"},
    {"descriptors", [](Bytes *f) { (*f)[placeOf(*f, 1)] ^= 4; }, SPHC_E_MAP_CHECKSUM, "section 1"},
    {"group centroids", [](Bytes *f) { f->back() ^= 4; }, SPHC_E_MAP_CHECKSUM, "section 5"},
    {"no direction",
     [](Bytes *f) {
       (*f)[kDirections + 4 * 7] = (*f)[kDirections + 4 * 7 + 1] = 0;
       test::signSection(f, 0);
     },
     SPHC_E_MAP_FORMAT, "direction 7"},
    {"no direction, other half",
     [](Bytes *f) {
       (*f)[kDirections + 4 * 8 + 2] = (*f)[kDirections + 4 * 8 + 3] = 0;
       test::signSection(f, 0);
     },
     SPHC_E_MAP_FORMAT, "direction 8"},
    {"first run not at 0", [](Bytes *f) { setOffset(f, kRunSection, 0, 1); }, SPHC_E_MAP_FORMAT, "run 0"},
    {"falling runs", [](Bytes *f) { setOffset(f, kRunSection, 40, kPoints), setOffset(f, kRunSection, 41, 3); },
     SPHC_E_MAP_FORMAT, "run 41"},
    {"a run beyond the points", [](Bytes *f) { setOffset(f, kRunSection, 40, kPoints + 1); }, SPHC_E_MAP_FORMAT,
     "run 40"},
    {"a wild run", [](Bytes *f) { setOffset(f, kRunSection, 40, UINT32_MAX); }, SPHC_E_MAP_FORMAT, "run 40"},
    {"points that no run lists", [](Bytes *f) { setOffset(f, kRunSection, 80, kPoints - 1); }, SPHC_E_MAP_FORMAT,
     "run 80"},
    {"first group not at 0", [](Bytes *f) { setOffset(f, kGroupSection, 0, 1); }, SPHC_E_MAP_FORMAT, "group 0"},
    {"a group beyond the cells", [](Bytes *f) { setOffset(f, kGroupSection, 1, 6); }, SPHC_E_MAP_FORMAT, "group 1"},
    {"cells that no group lists", [](Bytes *f) { setOffset(f, kGroupSection, 2, 4); }, SPHC_E_MAP_FORMAT,
     "group 2"},
    {"another sector", [](Bytes *f) { turnAround(f, 3); }, SPHC_E_MAP_FORMAT, "point 3"},
};

TEST(MapView, EachCorruptionHasItsOwnError) {
  for (const Corruption &corruption : kCorruptions) {
    Bytes file = test::randomMap(kPoints, 5);
    corruption.spoil(&file);
    std::string text;
    EXPECT_EQ(open(file, &text), corruption.status) << corruption.name << ": " << text;
    EXPECT_NE(text.find(corruption.words), std::string::npos) << corruption.name << ": " << text;
  }
}

TEST(MapView, FailureLeavesTheViewAsItWas) {
  const Bytes good = test::randomMap(kPoints, 7);
  Bytes bad = good;
  bad.back() ^= 1;
  MapView view;
  ASSERT_EQ(MapView::open(good.data(), good.size(), kExtractorId, &view, nullptr), SPHC_OK);
  EXPECT_EQ(MapView::open(bad.data(), bad.size(), kExtractorId, &view, nullptr), SPHC_E_MAP_CHECKSUM);
  EXPECT_EQ(static_cast<const void *>(&view.header()), good.data());
}

}  // namespace
}  // namespace sphc
