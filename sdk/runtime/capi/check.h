// Checks that several functions of the C interface have in common.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

constexpr double kLeastSigma = 1e-6;  // smaller ones would square to nothing

// Must a field lie in [low, high]?  `owner` is what its name begins with.
bool inRange(const char *owner, const char *name, double value, double low, double high, sphc_message *message);
// A transform between sensors of one rig.
bool checkMount(const char *name, const sphc_rigid &mount, sphc_message *message);
// Of an array's element: says which, in front of what was found.
sphc_status refuseElement(uint32_t i, sphc_status status, const sphc_message &found, sphc_message *message);
// The format that a depth image must have, and the field of the config that says so; 0 for colour or grey.
struct DepthWanted {
  sphc_format format = 0;
  const char *field = "";
};
// Does an image fit its camera?  `name` is that of the image.
sphc_status checkImage(const char *name, const sphc_image &image, const sphc_camera &camera,
                       const DepthWanted &wanted, sphc_message *message);
// The answer of a function that ends in _memory.
sphc_status giveMemory(const sphc_memory &need, sphc_memory *memory, sphc_message *message);
// Is memory there, aligned and large enough?  `what` names it in the message.
sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message);
// What the library writes to must not be read as something else.
struct MemoryRange {
  const char *name;
  const void *begin;
  size_t bytes;
};
sphc_status checkApart(const MemoryRange &written, const MemoryRange &other, sphc_message *message);

}  // namespace sphc
