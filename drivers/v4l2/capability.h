// What a node is, and which layouts it offers.
#pragma once

#include "node.h"

namespace sphc::v4l2 {

struct Capability {
  char card[32], bus[32], driver[16];  // always terminated
  bool is_capture;                     // else it is of metadata, a codec, an output ...
  bool is_multi_planar;
  bool can_stream;
};

// 0 or an errno.
int readCapability(const Node &node, Capability *capability);

struct OfferedFourccs {
  static constexpr uint32_t kMax = 256;
  uint32_t count;
  uint32_t fourccs[kMax];

  bool contains(uint32_t fourcc) const;
};

int readOfferedFourccs(const Node &node, OfferedFourccs *offered);

}  // namespace sphc::v4l2
