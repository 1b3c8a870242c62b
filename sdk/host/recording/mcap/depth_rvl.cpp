#include "depth_rvl.h"

#include <algorithm>
#include <array>

namespace sphc::recording {

namespace {

// Numbers go as nibbles of three bits, low bits first; the fourth bit says that more follow.
struct Code {
  uint16_t nibbles;
  uint8_t count;
};

constexpr uint32_t kTableSize = 512;  // three nibbles
constexpr auto makeCodes() {
  std::array<Code, kTableSize> codes{};
  for (uint32_t value = 0; value < kTableSize; ++value) {
    uint32_t rest = value;
    Code &code = codes[value];
    do {
      const uint32_t more = rest > 7 ? 8 : 0;
      code.nibbles = static_cast<uint16_t>(code.nibbles << 4 | more | (rest & 7));
      ++code.count;
      rest >>= 3;
    } while (rest);
  }
  return codes;
}
constexpr std::array<Code, kTableSize> kCodes = makeCodes();

// Words of 32 bits, little-endian, their first nibble on top.
class NibbleWriter {
 public:
  explicit NibbleWriter(uint8_t *out) : start_(out), out_(out) {}

  void put(uint32_t value) {
    while (value >= kTableSize) {
      add(8 | (value & 7), 1);
      value >>= 3;
    }
    add(kCodes[value].nibbles, kCodes[value].count);
  }

  size_t finish() {
    if (count_) add(0, 8 - count_);
    return static_cast<size_t>(out_ - start_);
  }

 private:
  void add(uint32_t nibbles, uint32_t count) {
    word_ = word_ << (4 * count) | nibbles;
    count_ += count;
    if (count_ < 8) return;
    count_ -= 8;
    storeLittle(out_, static_cast<uint32_t>(word_ >> (4 * count_)));
    out_ += 4;
  }

  uint8_t *start_, *out_;
  uint64_t word_ = 0;
  uint32_t count_ = 0;  // nibbles waiting, fewer than 8
};

class NibbleReader {
 public:
  explicit NibbleReader(ByteView view) : next_(view.data), end_(view.data + view.size / 4 * 4) {}

  // False at the end, and when the number is over 32 bits.
  bool take(uint32_t &value) {
    value = 0;
    for (uint32_t shift = 0; shift < 32; shift += 3) {
      if (count_ == 0) {
        if (next_ == end_) return false;
        word_ = loadLittle<uint32_t>(next_);
        next_ += 4;
        count_ = 8;
      }
      const uint32_t nibble = word_ >> 28;
      word_ <<= 4;
      --count_;
      value |= (nibble & 7) << shift;
      if (nibble < 8) return true;
    }
    return false;
  }

 private:
  const uint8_t *next_, *end_;
  uint32_t word_ = 0, count_ = 0;
};

uint32_t zigzag(int32_t delta) { return static_cast<uint32_t>(delta) << 1 ^ static_cast<uint32_t>(delta >> 31); }
int32_t unzigzag(uint32_t value) { return static_cast<int32_t>(value >> 1) ^ -static_cast<int32_t>(value & 1); }

}  // namespace

size_t encodeRvl(const uint16_t *depth, size_t count, uint8_t *out) {
  NibbleWriter writer(out);
  const uint16_t *const end = depth + count;
  int32_t previous = 0;
  while (depth < end) {
    const uint16_t *const measured = std::find_if(depth, end, [](uint16_t d) { return d != 0; });
    const uint16_t *const hole = std::find(measured, end, uint16_t{0});
    writer.put(static_cast<uint32_t>(measured - depth));
    writer.put(static_cast<uint32_t>(hole - measured));
    for (depth = measured; depth < hole; ++depth) {
      writer.put(zigzag(*depth - previous));
      previous = *depth;
    }
  }
  return writer.finish();
}

bool decodeRvl(ByteView encoded, uint16_t *depth, size_t count) {
  NibbleReader reader(encoded);
  int32_t previous = 0;
  size_t done = 0;
  while (done < count) {
    uint32_t holes = 0, measured = 0;
    if (!reader.take(holes) || holes > count - done) return false;
    std::fill_n(depth + done, holes, uint16_t{0});
    done += holes;
    if (!reader.take(measured) || measured > count - done) return false;
    if (holes == 0 && measured == 0) return false;  // else a run of these would never end
    for (const size_t end = done + measured; done < end; ++done) {
      uint32_t delta = 0;
      if (!reader.take(delta) || delta > 2 * 65535) return false;
      previous += unzigzag(delta);
      if (previous < 1 || previous > 65535) return false;
      depth[done] = static_cast<uint16_t>(previous);
    }
  }
  return true;
}

}  // namespace sphc::recording
