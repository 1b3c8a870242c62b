// The frames of a recording less those that cannot be read, as a command that measures takes them.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "host/frames/recording.h"

namespace sphc::host {

using Unreadable = std::function<void(const std::string &why)>;

// Gives `use` each frame that can be read, and `unreadable` why another cannot.  Throws std::runtime_error where
// none can.
inline void forReadableFrames(recording::RecordingReader *reader, const Unreadable &unreadable,
                              const std::function<void(uint32_t index, sphc_localizer_frame frame)> &use) {
  bool any = false;
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    std::string why;
    const std::optional<sphc_localizer_frame> frame = reader->tryRead(i, &why);
    frame ? use(i, *frame) : unreadable(why);
    any |= frame.has_value();
  }
  if (!any) host::refuseUnreadable();
}

}  // namespace sphc::host
