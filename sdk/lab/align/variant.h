// One way to bring depth to the colour image, among those that are measured.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lab/align/case.h"

namespace sphc::host {

struct AlignedFrame {
  double seconds = 0;           // of the aligning alone
  std::vector<uint16_t> depth;  // of the colour camera's size, in units of the case
  std::vector<uint8_t> mask;    // SPHC_ALIGNED_ values; empty: the variant tells none
};

using AlignFunction = std::function<void(const AlignFrame &, AlignedFrame *)>;

struct AlignVariant {
  std::string name;
  std::function<AlignFunction(const AlignCase &)> make;  // empty: absent
  std::string absent;                                    // then: why, and the cure
};

// Seconds that this thread has computed: what other programs take of the core does not count.
double threadSeconds();

extern const char kAlignOurs[], kAlignLoop[];
AlignVariant ourAligner();
AlignVariant plainLoop();
AlignVariant openCvAligner();

// Seconds that 800 keypoints take to be lifted, in a frame; the localizer's own stage.
struct SparseTime {
  double seconds = 0;
  uint32_t lifted = 0;
};
std::function<SparseTime(const AlignFrame &)> sparseLift(const AlignCase &, uint32_t keypoints);

}  // namespace sphc::host
