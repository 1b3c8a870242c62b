// How a frame contradicts itself, or what it was told.
#pragma once
#include <cstdint>

namespace sphc {

using Faults = uint32_t;  // bits

constexpr Faults kDepthRange = 1;            // measurements, but nearly none in the sensor's range
constexpr Faults kDepthConstant = 2;         // one measurement everywhere
constexpr Faults kDepthBent = 4;             // planes are bent: the values are no depths
constexpr Faults kDepthFrozen = 8;           // depth stays while the image moves
constexpr Faults kColorFrozen = 16;          // the image stays while depth moves
constexpr Faults kDepthColorDisagree = 32;   // edges of depth do not lie on edges of the image
constexpr Faults kDepthScale = 64;           // the pose moves more, or less, than odometry says
constexpr Faults kDepthBias = 128;           // what was learnt of the depth sensor is beyond what may be
constexpr Faults kVerticalDisagrees = 256;   // the vertical that was given is not the pose's
constexpr Faults kMirrored = 512;            // left and right are changed against the map
constexpr Faults kDistancesDisagree = 1024;  // points of the map lie elsewhere than they did
constexpr Faults kOdometryDisagrees = 2048;  // odometry moves otherwise than poses do
constexpr Faults kFocalDisagrees = 4096;     // the matches agree with another focal length

// With any of these there is nothing to make a pose from.
constexpr Faults kContradictions =
    kDepthRange | kDepthConstant | kDepthBent | kDepthFrozen | kColorFrozen | kDepthColorDisagree;
// With any of these there is a pose, and it is doubted.
constexpr Faults kDoubts = kDepthScale | kDepthBias | kFocalDisagrees;

}  // namespace sphc
