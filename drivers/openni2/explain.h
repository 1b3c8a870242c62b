// Failures in words.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstring>

namespace sphc::openni2 {

// Prints into `message`, which may be null, cut to fit; gives `status` back.
[[gnu::format(printf, 3, 4)]] sphc_status explain(sphc_message *message, sphc_status status, const char *format,
                                                  ...);

// Copies as much as fits, and terminates it.
template <size_t N>
void copyText(char (&target)[N], const char *source) {
  const size_t length = strnlen(source, N - 1);
  std::memcpy(target, source, length);
  target[length] = '\0';
}

}  // namespace sphc::openni2
