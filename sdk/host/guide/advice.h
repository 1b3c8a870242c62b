// What a person is told who records a walk for a map.
#pragma once
#include <cstdint>
#include <optional>

#include "host/report/bit_words.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/hint.h"

namespace sphc::host {

using GuideAdvice = uint32_t;  // bits, the most urgent first

constexpr GuideAdvice kGoBack = 1;      // lost: what is seen has no place in the walk
constexpr GuideAdvice kMoreLight = 2;   // too dark
constexpr GuideAdvice kOtherRange = 4;  // no depth: too near, too far, glass
constexpr GuideAdvice kSlower = 8;      // blurred, or neighbouring frames show little in common
constexpr GuideAdvice kMoreTexture = 16;
constexpr GuideAdvice kLookAgain = 32;  // thin: few keypoints hold this place to the rest

// Each bit's name and what to do about it.
extern const std::array<BitWords, 6> kAdviceWords;

// Of one bit.
const BitWords &wordsOf(GuideAdvice bit);

GuideAdvice adviceOf(Hints hints);

// The frame shows what was seen long before.
struct ClosedLoop {
  uint32_t sequence_then = 0;
  int64_t time_then_ns = 0;
  Rigid now_from_then;    // of the two cameras
  bool is_begin = false;  // of the walk
  bool is_new = true;     // else the last one goes on
};

// What the guide says of one frame.
struct GuideStep {
  uint32_t sequence = 0;
  int64_t time_ns = 0;
  GuideAdvice advice = 0;
  double lost_s = 0;                          // with kGoBack: since the walk last was where it can go back to
  std::optional<ClosedLoop> loop;             // that this frame closed
  uint32_t places = 0, parts = 0, loops = 0;  // of the walk so far
};

}  // namespace sphc::host
