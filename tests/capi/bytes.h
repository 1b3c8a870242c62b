// Did a call leave its outputs alone?
#pragma once
#include <gtest/gtest.h>

#include <cstring>

#include "spherecloud/spherecloud.h"

namespace sphc::test {

// An output filled with a pattern; `untouched` as long as every byte still has it.
template <typename T>
class Output {
 public:
  Output() { std::memset(&value_, 0x5A, sizeof value_); }
  T *get() { return &value_; }
  T *operator->() { return &value_; }
  bool untouched() const {
    T pattern;
    std::memset(&pattern, 0x5A, sizeof pattern);
    return std::memcmp(&value_, &pattern, sizeof value_) == 0;
  }

 private:
  T value_;
};

inline void expectMentions(const char *text, const char *words) {
  EXPECT_NE(std::strstr(text, words), nullptr) << "'" << text << "' does not mention '" << words << "'";
}

}  // namespace sphc::test
