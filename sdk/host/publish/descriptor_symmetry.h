// What a descriptor would be had the world been another: a move of its bytes alone, so nothing tells that it was
// made.
#pragma once
#include "runtime/types/keypoint.h"

namespace sphc::host {

// The descriptor of a patch's negative.  Rows, columns and bins are those of the feature stage: 4 x 4 cells of 8
// orientations relative to the keypoint's own.
Descriptor negative(const Descriptor &descriptor);

}  // namespace sphc::host
