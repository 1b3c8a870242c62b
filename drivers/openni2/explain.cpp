#include "explain.h"

#include <cstdarg>
#include <cstdio>

namespace sphc::openni2 {

sphc_status explain(sphc_message *message, sphc_status status, const char *format, ...) {
  if (!message) return status;
  va_list values;
  va_start(values, format);
  std::vsnprintf(message->text, sizeof message->text, format, values);
  va_end(values);
  return status;
}

}  // namespace sphc::openni2
