// Memory that shows whether it was overrun.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sphc::test {

// Of exactly the bytes asked for, with guard bytes on both sides.  `dirt` fills it: nothing may count on zeros.
class GuardedMemory {
 public:
  GuardedMemory() = default;
  GuardedMemory(uint64_t bytes, size_t alignment, uint8_t dirt = 0xEE)
      : storage_(static_cast<size_t>(bytes) + alignment + 2 * kGuard, kGuardByte),
        bytes_(static_cast<size_t>(bytes)) {
    const auto first = reinterpret_cast<uintptr_t>(storage_.data()) + kGuard;
    start_ = storage_.data() + kGuard + (alignment - first % alignment) % alignment;
    std::fill_n(start_, bytes_, dirt);
  }

  void *data() { return start_; }
  size_t size() const { return bytes_; }
  bool guardsIntact() const {
    const auto is_guard = [](uint8_t byte) { return byte == kGuardByte; };
    const uint8_t *const begin = storage_.data(), *const end = begin + storage_.size();
    return std::all_of(begin, static_cast<const uint8_t *>(start_), is_guard) &&
           std::all_of(static_cast<const uint8_t *>(start_) + bytes_, end, is_guard);
  }
  // The contents, for comparing.
  std::vector<uint8_t> copy() const { return {start_, start_ + bytes_}; }

 private:
  static constexpr size_t kGuard = 256;
  static constexpr uint8_t kGuardByte = 0xC5;

  std::vector<uint8_t> storage_;
  uint8_t *start_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace sphc::test
