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
constexpr size_t kFirstEntry = 64, kSecondEntry = 96;

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
  EXPECT_EQ(static_cast<const void *>(view.descriptors().end()), file.data() + file.size());
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
    ASSERT_LT(open(cut), 0) << length;
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
    {"newer", [](Bytes *f) { put32(f, 8, 2), test::signHeader(f); }, SPHC_E_MAP_VERSION, "version 2"},
    {"older", [](Bytes *f) { put32(f, 8, 0), test::signHeader(f); }, SPHC_E_MAP_VERSION, "version 0"},
    {"extractor", [](Bytes *f) { put32(f, 12, 77), test::signHeader(f); }, SPHC_E_MAP_EXTRACTOR, "extractor 77"},
    {"oversized", [](Bytes *f) { f->push_back(0); }, SPHC_E_MAP_FORMAT, "bytes"},
    {"oversized, signed",
     [](Bytes *f) {
       f->push_back(0);
       put64(f, 16, f->size());
       test::signHeader(f);
     },
     SPHC_E_MAP_FORMAT, "after its last section"},
    {"huge size", [](Bytes *f) { put64(f, 16, ~0ull), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "bytes"},
    {"no sections", [](Bytes *f) { put32(f, 28, 0); }, SPHC_E_MAP_FORMAT, "section count 0"},
    {"many sections", [](Bytes *f) { put32(f, 28, 17); }, SPHC_E_MAP_FORMAT, "section count 17"},
    {"countless sections", [](Bytes *f) { put32(f, 28, 0x08000000); }, SPHC_E_MAP_FORMAT, "section count"},
    {"header checksum", [](Bytes *f) { (*f)[40] ^= 1; }, SPHC_E_MAP_CHECKSUM, "header"},
    {"table checksum", [](Bytes *f) { (*f)[kFirstEntry + 24] ^= 1; }, SPHC_E_MAP_CHECKSUM, "table"},
    {"reserved header", [](Bytes *f) { (*f)[48] = 1, test::signHeader(f); }, SPHC_E_MAP_FORMAT, "reserved"},
    {"last reserved byte", [](Bytes *f) { (*f)[59] = 1, test::signHeader(f); }, SPHC_E_MAP_FORMAT, "reserved"},
    {"too few points", [](Bytes *f) { put32(f, 24, 15), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "15 points"},
    {"too many points", [](Bytes *f) { put32(f, 24, (1u << 24) + 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "16777217 points"},
    {"one point more", [](Bytes *f) { put32(f, 24, kPoints + 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"unknown type", [](Bytes *f) { put32(f, kFirstEntry, 9), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "type 9"},
    {"type twice", [](Bytes *f) { put32(f, kSecondEntry, 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT, "type 1"},
    {"element size", [](Bytes *f) { put32(f, kFirstEntry + 4, 8), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"offset", [](Bytes *f) { put64(f, kSecondEntry + 8, 192), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 1"},
    {"wild offset", [](Bytes *f) { put64(f, kSecondEntry + 8, ~63ull), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 1"},
    {"section bytes", [](Bytes *f) { put64(f, kFirstEntry + 16, 4), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"reserved entry", [](Bytes *f) { put32(f, kFirstEntry + 28, 1), test::signHeader(f); }, SPHC_E_MAP_FORMAT,
     "section 0"},
    {"padding", [](Bytes *f) { (*f)[128 + 4 * kPoints] = 1; }, SPHC_E_MAP_FORMAT, "padding"},
    {"last padding byte", [](Bytes *f) { (*f)[255] = 1; }, SPHC_E_MAP_FORMAT, "padding"},
    {"directions", [](Bytes *f) { (*f)[130] ^= 4; }, SPHC_E_MAP_CHECKSUM, "section 0"},
    {"descriptors", [](Bytes *f) { f->back() ^= 4; }, SPHC_E_MAP_CHECKSUM, "section 1"},
    {"no direction",
     [](Bytes *f) {
       (*f)[128 + 4 * 7] = (*f)[128 + 4 * 7 + 1] = 0;
       test::signSection(f, 0);
     },
     SPHC_E_MAP_FORMAT, "direction 7"},
    {"no direction, other half",
     [](Bytes *f) {
       (*f)[128 + 4 * 8 + 2] = (*f)[128 + 4 * 8 + 3] = 0;
       test::signSection(f, 0);
     },
     SPHC_E_MAP_FORMAT, "direction 8"},
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

// A third section that is otherwise perfect: a newer writer must raise the version to add one.
TEST(MapView, AnAdditionalSectionIsRefused) {
  const Bytes old = test::randomMap(16, 6);
  Bytes file(old.begin(), old.begin() + 128);
  file.resize(192);  // three entries end at 160
  file.insert(file.end(), old.begin() + 128, old.end());
  file.resize(file.size() + 64);
  put32(&file, 28, 3);
  put64(&file, 16, file.size());
  put64(&file, kFirstEntry + 8, 192);
  put64(&file, kSecondEntry + 8, 256);
  put32(&file, 128, 3);
  put32(&file, 132, 4);
  put64(&file, 136, file.size() - 64);
  put64(&file, 144, 64);
  test::signSection(&file, 2);
  std::string text;
  EXPECT_EQ(open(file, &text), SPHC_E_MAP_FORMAT);
  EXPECT_NE(text.find("unknown type 3"), std::string::npos) << text;
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
