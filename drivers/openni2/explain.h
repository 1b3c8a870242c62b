// Failures in words.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstring>

#include "drivers/pixels/explain.h"

namespace sphc::openni2 {

using pixels::explain;

// Copies as much as fits, and terminates it.
template <size_t N>
void copyText(char (&target)[N], const char *source) {
  const size_t length = strnlen(source, N - 1);
  std::memcpy(target, source, length);
  target[length] = '\0';
}

}  // namespace sphc::openni2
