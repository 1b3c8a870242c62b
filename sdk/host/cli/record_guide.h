// Guidance while cameras are recorded: `record --guide`.
#pragma once
#include <mutex>

#include "host/cli/common/console.h"
#include "host/guide/guide_thread.h"
#include "host/guide/guide_words.h"
#include "host/guide/look_pace.h"
#include "host/guide/walk_guide.h"
#include "host/live/rig.h"

namespace sphc::host {

class RecordGuide {
 public:
  // `may_wait`: frames wait in the cameras, so none is lost when the guide is behind.
  RecordGuide(const sphc_rig &calibration, const WalkGuide::Options &options, bool may_wait,
              const Console &console);

  // Never waits for the guide otherwise.
  void see(const CapturePair &pair);
  // For the line on the terminal.
  std::string text();
  // Ends it.
  nlohmann::ordered_json end(const Console &console);

 private:
  void look(const sphc_localizer_frame &frame, const Console &console);

  const bool may_wait_;
  LookPace pace_;
  uint32_t skipped_ = 0;  // frames that were due while it was busy
  WalkGuide guide_;       // of the thread
  GuideLine line_;        // the same
  std::mutex mutex_;
  std::string text_;
  GuideThread thread_;
};

}  // namespace sphc::host
