// What a descriptor would be had the world been another: moves of its bytes alone, so nothing tells that they were
// made.
#pragma once
#include "runtime/types/keypoint.h"

namespace sphc::host {

// The descriptor of a patch's mirror image, and of its negative.  Rows, columns and bins are those of the feature
// stage: 4 x 4 cells of 8 orientations relative to the keypoint's own.
Descriptor mirrored(const Descriptor &descriptor);
Descriptor negative(const Descriptor &descriptor);

}  // namespace sphc::host
