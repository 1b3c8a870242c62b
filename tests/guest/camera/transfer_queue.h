// What the host has asked for of the bulk endpoint and not got yet, in order.
#pragma once

#include <array>
#include <cstdint>

namespace sphc::guest {

struct Transfer {
  uint64_t id;
  uint32_t room_bytes;
};

class TransferQueue {
 public:
  bool empty() const { return count_ == 0; }
  const Transfer &front() const { return transfers_[0]; }
  bool push(const Transfer &transfer) {
    if (count_ == transfers_.size()) return false;
    transfers_[count_++] = transfer;
    return true;
  }
  void pop() { erase(0); }
  // The host takes a wish back; false: it was answered already.
  bool cancel(uint64_t id) {
    for (size_t i = 0; i < count_; ++i) {
      if (transfers_[i].id != id) continue;
      erase(i);
      return true;
    }
    return false;
  }

 private:
  void erase(size_t at) {
    for (--count_; at < count_; ++at) transfers_[at] = transfers_[at + 1];
  }

  std::array<Transfer, 64> transfers_{};
  size_t count_ = 0;
};

}  // namespace sphc::guest
