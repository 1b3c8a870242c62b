// The player of a recording: it is asked for one frame at a time.
//
// OpenNI2 asks the file for a frame on each wait that finds none, and a stream keeps one frame alone.  Two waits
// where the first was slow bring two frames, and the first of a stream is lost.  So this asks once, and waits for
// OpenNI2 to tell that the frame is there.
#pragma once

#include <OniCAPI.h>

#include "listeners.h"
#include "streams.h"
#include "wakeup.h"

namespace sphc::openni2 {

class Player {
 public:
  Player() = default;
  Player(const Player &) = delete;
  Player &operator=(const Player &) = delete;

  // Null: no such stream.  Nothing was started before.  False: OpenNI2 refuses.
  bool start(const OniStreamHandle (&streams)[kStreams]);
  // Before the streams are destroyed.
  void close() { listeners_.removeAll(); }

  // True when a frame is there.  Asks for one unless it did, or one is.
  bool await(int64_t until_ns);
  // The stream of a frame that is there, which is read by this.
  int take();

 private:
  static void ONI_CALLBACK_TYPE onNewFrame(OniStreamHandle handle, void *player);
  void askForFrame();
  int firstThere() const;

  Listeners listeners_;
  Wakeup wakeup_;  // for all that follows
  OniStreamHandle streams_[kStreams] = {};
  bool asked_ = false;  // and nothing came yet
  bool is_there_[kStreams] = {};
};

}  // namespace sphc::openni2
