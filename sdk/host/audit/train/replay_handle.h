// A recording's handle that closes itself.
#pragma once
#include <memory>
#include <stdexcept>

#include "drivers/replay/replay.h"

namespace sphc::host {

struct ReplayCloser {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, ReplayCloser>;

// `calibration` and `config` may be null.  Throws std::runtime_error with what the driver says.
inline Replay openReplay(const char *path, const char *calibration, const sphc_replay_config *config) {
  sphc_replay *replay = nullptr;
  sphc_message why;
  if (sphc_replay_open(path, calibration, config, &replay, &why) != SPHC_OK) throw std::runtime_error(why.text);
  return Replay(replay);
}

}  // namespace sphc::host
