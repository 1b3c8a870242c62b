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
    std::fill(is_there_, is_there_ + kStreams, false);
  }
  for (const OniStreamHandle stream : streams)
    if (stream && !(listeners_.add(stream, onNewFrame, this) && oniStreamStart(stream) == ONI_STATUS_OK))
      return false;
  return true;
}

bool Player::await(int64_t until_ns) {
  bool asks = false;
  {
    const Lock lock(wakeup_);
    asks = !asked_ && firstThere() == kStreams;
    asked_ = asked_ || asks;
  }
  if (asks) onReader([this] { askForFrame(); });
  const Lock lock(wakeup_);
  while (firstThere() == kStreams && monotonicNs() < until_ns) wakeup_.waitUntil(until_ns);
  return firstThere() != kStreams;
}

int Player::take() {
  const Lock lock(wakeup_);
  const int stream = firstThere();
  is_there_[stream] = false;
  return stream;
}

// Under the lock; kStreams: none is.
int Player::firstThere() const {
  return static_cast<int>(std::find(is_there_, is_there_ + kStreams, true) - is_there_);
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
  self.is_there_[handle == self.streams_[kColor] ? kColor : kDepth] = true;
  self.asked_ = false;
  self.wakeup_.wake();
}

}  // namespace sphc::openni2
