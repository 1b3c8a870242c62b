// A text for the caller, cut to fit.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstdarg>
#include <cstdio>

namespace sphc::pixels {

// Gives `status` back, so that a failure is one line.  `message` may be null.
[[gnu::format(printf, 3, 4)]] inline sphc_status explain(sphc_message *message, sphc_status status,
                                                         const char *format, ...) {
  if (!message) return status;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message->text, sizeof message->text, format, arguments);
  va_end(arguments);
  return status;
}

}  // namespace sphc::pixels
