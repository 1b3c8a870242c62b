// A headset's days in fast motion: rooms, cables, releases, broken frames and callers that make mistakes.
#pragma once
#include "runtime/base/random.h"
#include "spherecloud/spherecloud_capture.h"
#include "tests/soak/checks.h"
#include "tests/soak/world.h"
#include "tests/support/stepping_clock.h"

namespace sphc::soak {

// Calls under a sealed heap; a promise that is not kept ends the program.
class Day {
 public:
  Day(const World *world, uint64_t seed);
  ~Day();
  Day(const Day &) = delete;
  Day &operator=(const Day &) = delete;

  // Until so many frames were answered, from init to fini again and again.
  void play(uint64_t frames);
  const Totals &totals() const { return totals_; }
  // For a test that the checks see it: one byte behind the localizer's state, or 1 m beside every pose.
  void breakGuard();
  void breakPoses() { added_m_ = 1; }

 private:
  struct Shot {
    uint32_t room, place;
    int64_t time_ns;
  };
  bool chance(double share) { return random_.uniform() < share; }
  void begin();
  void end();
  void tick();
  void walk();
  void unplug();
  void changeMaps();
  void setMap(uint32_t room);
  void captureBoth();
  void push(sphc_stream stream);
  void popAll();
  void frame(const Shot &color, const Shot &depth);
  void breakFrame(sphc_localizer_frame *frame);
  void addPrior(const Shot &shot, sphc_localizer_frame *frame);
  sphc_status answer(const sphc_localizer_frame &frame);
  sphc_status answerInHalves(const sphc_localizer_frame &frame);
  void judge(const Shot &shot, const sphc_localizer_frame &frame, sphc_status status, bool is_broken);
  void reset();
  void ask();
  void refusedCall();
  void checkGuards() const;

  const World &world_;
  Random random_;
  test::SteppingClock clock_{1000};
  sphc_localizer_config config_ = soakConfig();
  Totals totals_;
  static constexpr uint64_t kFramesOfADay = 1500;  // from init to fini
  uint64_t day_ends_ = kFramesOfADay;
  double added_m_ = 0;

  test::GuardedMemory state_, scratch_, features_memory_, pairer_memory_, mapper_memory_;
  sphc_localizer *localizer_ = nullptr;
  sphc_features *features_ = nullptr;
  sphc_pairer *pairer_ = nullptr;
  sphc_clock_mapper *mapper_ = nullptr;
  uint32_t release_[kMappedRooms] = {};
  bool has_map_[kMappedRooms] = {};

  uint32_t room_ = 0, place_ = 0;
  bool forward_ = true;
  int64_t source_ns_ = 0, host_ns_ = 0, last_ns_ = INT64_MIN;
  uint32_t sequence_ = 0, contradictions_ = 0;
  Shot shots_[64] = {};  // of captures on loan to the pairer, by their token
  uint64_t token_ = 0;

  // What frames borrow.
  std::vector<uint8_t> gray_;
  std::vector<uint16_t> depth_mm_;
  Guarded<sphc_localizer_prior> prior_;
  Guarded<sphc_localizer_result> result_;
  Guarded<sphc_localizer_prediction> prediction_;
  Guarded<sphc_localizer_hypothesis[SPHC_HYPOTHESES_MAX]> hypotheses_;
  Guarded<sphc_localizer_observation[64]> observations_;
};

}  // namespace sphc::soak
