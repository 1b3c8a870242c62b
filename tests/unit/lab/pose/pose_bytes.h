// A small correspondence file in memory.
#pragma once
#include <cstring>
#include <string>
#include <vector>

#include "lab/pose/file.h"

namespace sphc::host::test {

class PoseBytes {
 public:
  std::vector<uint8_t> bytes;

  template <typename T>
  PoseBytes &add(T value) {
    const size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return *this;
  }
  PoseBytes &text(const std::string &text) {
    bytes.insert(bytes.end(), text.begin(), text.end());
    return *this;
  }
  // Overwrites what lies there.
  template <typename T>
  PoseBytes &put(size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return *this;
  }
  Span<const uint8_t> span() const { return {bytes.data(), bytes.size()}; }
};

// Where things lie in goodPoseFile().
constexpr size_t kAtVersion = 4, kAtQueries = 8, kAtEta = 12, kAtReserved = 20, kAtCentre = 24, kAtNameLength = 48,
                 kAtName = 52, kAtFocal = 58, kAtDistortion = 90, kAtWidth = 94, kAtRotation = 102,
                 kAtRowCount = 198, kAtRow = 202, kRowBytes = 64;

inline void addQuery(PoseBytes *b, const std::string &name, uint32_t index, uint32_t rows) {
  b->add<uint32_t>(static_cast<uint32_t>(name.size())).text(name).add(index);
  b->add(500.0).add(500.0).add(320.0).add(240.0);
  b->add<uint32_t>(0).add<uint32_t>(640).add<uint32_t>(480);
  for (int i = 0; i < 9; ++i) b->add(i % 4 == 0 ? 1.0 : 0.0);
  b->add(0.1).add(-0.2).add(2.0);
  b->add<uint32_t>(rows);
  for (uint32_t i = 0; i < rows; ++i) {
    b->add(320.0 + 50 * i).add(240.0);
    b->add(0.6).add(0.0).add(0.8);
    b->add(i == 1 ? 0.0 : 2.0).add(2.1);
    b->add<uint32_t>(i % 2).add<uint32_t>(i);
  }
}

// Two queries, "ab" with three rows and "xyz" with none.
inline PoseBytes goodPoseFile() {
  PoseBytes b;
  b.text("SPHC").add<uint32_t>(1).add<uint32_t>(2).add<uint32_t>(33).add<uint32_t>(7).add<uint32_t>(0);
  b.add(1.0).add(2.0).add(3.0);
  addQuery(&b, "ab", 7, 3);
  addQuery(&b, "xyz", 8, 0);
  return b;
}

}  // namespace sphc::host::test
