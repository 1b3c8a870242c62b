// Who is told of new frames of a device's streams.
#pragma once

#include <OniCAPI.h>

#include "streams.h"

namespace sphc::openni2 {

class Listeners {
 public:
  Listeners() = default;
  Listeners(const Listeners &) = delete;
  Listeners &operator=(const Listeners &) = delete;

  // `told` gets `self`, on a thread of OpenNI2, one a stream.  Once for a stream at most.  False: OpenNI2 refuses.
  bool add(OniStreamHandle stream, OniNewFrameCallback told, void *self);
  // Before the streams are destroyed.
  void removeAll();

 private:
  struct Listener {
    OniStreamHandle stream;
    OniCallbackHandle handle;
  };
  Listener listeners_[kStreams] = {};
  int count_ = 0;
};

}  // namespace sphc::openni2
