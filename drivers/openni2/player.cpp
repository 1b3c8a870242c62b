#include "player.h"

#include <algorithm>
#include <mutex>

#include "reader.h"

namespace sphc::openni2 {

namespace {

using Lock = std::lock_guard<Wakeup>;

}  // namespace

bool Player::start(const OniStreamHandle (&streams)[kStreams]) {
  {
    const Lock lock(wakeup_);
    std::copy(streams, streams + kStreams, streams_);
    asked_ = false;
    stream_ = kStreams;
  }
  for (int stream = 0; stream < kStreams; ++stream) {
    if (!streams[stream]) continue;
    if (oniStreamRegisterNewFrameCallback(streams[stream], onNewFrame, this, &listeners_[stream]) !=
        ONI_STATUS_OK) {
      listeners_[stream] = nullptr;
      return false;
    }
    if (oniStreamStart(streams[stream]) != ONI_STATUS_OK) return false;
  }
  return true;
}

void Player::close() {
  for (int stream = 0; stream < kStreams; ++stream) {
    if (listeners_[stream]) oniStreamUnregisterNewFrameCallback(streams_[stream], listeners_[stream]);
    listeners_[stream] = nullptr;
  }
}

bool Player::await(int64_t until_ns) {
  bool asks = false;
  {
    const Lock lock(wakeup_);
    asks = !asked_ && stream_ == kStreams;
    asked_ = asked_ || asks;
  }
  if (asks) onReader([this] { askForFrame(); });
  const Lock lock(wakeup_);
  while (stream_ == kStreams && monotonicNs() < until_ns) wakeup_.waitUntil(until_ns);
  return stream_ != kStreams;
}

int Player::take() {
  const Lock lock(wakeup_);
  const int stream = stream_;
  stream_ = kStreams;
  asked_ = false;
  return stream;
}

// A wait that was woken asks again.  The first one, for no stream, asks nothing and leaves no frame's wake-up
// behind for the second.
void Player::askForFrame() {
  OniStreamHandle handles[kStreams];
  int count = 0, index = 0;
  for (const OniStreamHandle stream : streams_)
    if (stream) handles[count++] = stream;
  oniWaitForAnyStream(handles, 0, &index, 0);
  oniWaitForAnyStream(handles, count, &index, 0);
}

// On a thread of OpenNI2, one a stream.
void ONI_CALLBACK_TYPE Player::onNewFrame(OniStreamHandle handle, void *player) {
  Player &self = *static_cast<Player *>(player);
  const Lock lock(self.wakeup_);
  self.stream_ = handle == self.streams_[kColor] ? kColor : kDepth;
  self.wakeup_.wake();
}

}  // namespace sphc::openni2
