// What a keypoint of the mirror image would be described by.
#pragma once
#include "runtime/types/keypoint.h"

namespace sphc {

// A permutation of the bytes, so a mirrored descriptor looks like any other.  Mirrored twice it is the same again.
Descriptor mirrored(const Descriptor &descriptor);

}  // namespace sphc
