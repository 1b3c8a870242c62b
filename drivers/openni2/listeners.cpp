#include "listeners.h"

namespace sphc::openni2 {

bool Listeners::add(OniStreamHandle stream, OniNewFrameCallback told, void *self) {
  Listener &listener = listeners_[count_];
  listener = {stream, nullptr};  // OpenNI2 registers nothing where the handle is not null
  if (oniStreamRegisterNewFrameCallback(stream, told, self, &listener.handle) != ONI_STATUS_OK) return false;
  ++count_;
  return true;
}

void Listeners::removeAll() {
  for (; count_ > 0; --count_) {
    const Listener &last = listeners_[count_ - 1];
    oniStreamUnregisterNewFrameCallback(last.stream, last.handle);
  }
}

}  // namespace sphc::openni2
