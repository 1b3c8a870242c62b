// Warnings of which there may be one for every frame.
#pragma once
#include <cstdint>
#include <string>
#include <utility>

#include "host/base/counted.h"
#include "host/cli/common/console.h"

namespace sphc::host {

class FewWarnings {
 public:
  // "BEFORE N more THINGs BEHIND" is said at the end, of those that were not said.
  FewWarnings(const Console &console, std::string before, std::string thing, std::string behind)
      : console_(console), before_(std::move(before)), thing_(std::move(thing)), behind_(std::move(behind)) {}
  ~FewWarnings() {
    if (count_ > kMost) console_.warn(before_ + counted(count_ - kMost, "more " + thing_) + behind_);
  }
  FewWarnings(const FewWarnings &) = delete;
  FewWarnings &operator=(const FewWarnings &) = delete;

  // Says the first ten.
  void add(const std::string &why) {
    if (count_++ < kMost) console_.warn(before_ + why);
  }

 private:
  static constexpr uint32_t kMost = 10;
  const Console &console_;
  std::string before_, thing_, behind_;
  uint32_t count_ = 0;
};

}  // namespace sphc::host
