#include "live_source.h"

#include <stdexcept>

#include "live_drivers.h"

namespace sphc::guest {

LiveSource openLive(const std::string &what, sphc_stream stream) {
  const size_t colon = what.find(':');
  const std::string driver = what.substr(0, colon), where = what.substr(colon + 1);
  if (driver == "v4l2") return openV4l2(where, stream);
#ifdef SPHC_GUEST_LIBCAMERA
  if (driver == "libcamera") return openLibcamera(where);
#endif
  throw std::runtime_error(what + ": no such driver");
}

}  // namespace sphc::guest
