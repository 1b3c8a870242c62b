// What a file is called while it is written, until it is whole: a name beside the target that nobody else has.
#pragma once
#include <cstdio>
#include <random>
#include <string>

namespace sphc::host {

constexpr size_t kPartEndingBytes = sizeof ".01234567.part" - 1;

inline std::string partName(const std::string &target) {
  std::random_device random;
  char ending[kPartEndingBytes + 1];
  std::snprintf(ending, sizeof ending, ".%08x.part", static_cast<unsigned>(random()));
  return target + ending;
}

}  // namespace sphc::host
