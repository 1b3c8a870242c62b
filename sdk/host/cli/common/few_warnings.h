// Warnings of which there may be one for every frame.
#pragma once
#include <cstdint>
#include <string>

#include "host/cli/common/console.h"

namespace sphc::host {

class FewWarnings {
 public:
  explicit FewWarnings(const Console &console) : console_(console) {}
  // Says the first ten.
  void add(const std::string &text) {
    if (count_++ < kMost) console_.warn(text);
  }
  // How many were not said.
  uint32_t more() const { return count_ > kMost ? count_ - kMost : 0; }

 private:
  static constexpr uint32_t kMost = 10;
  const Console &console_;
  uint32_t count_ = 0;
};

}  // namespace sphc::host
