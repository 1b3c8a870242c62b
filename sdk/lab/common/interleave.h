// Several variants of the same work in turn, so that whatever slows the machine slows all alike.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/base/random.h"

namespace sphc::host {

constexpr double kSlowS = 0.05;  // of a run that takes longer once is enough

// Numbers 0 .. count - 1 in a random order.  Of variants, so that none always follows the same other one and finds
// the caches as that left them.
std::vector<size_t> shuffledOrder(size_t count, Random *random);

// Runs variant 0 .. count - 1 once in `repeat`; gives the seconds it took.
using TimedRun = std::function<double(size_t variant, uint32_t repeat)>;

// The median seconds of each variant over `repeats` rounds, each in a random order.  What is slow (kSlowS) runs
// once.
std::vector<double> interleave(size_t count, uint32_t repeats, Random *random, const TimedRun &run);

// Seconds of this thread on its core.
double threadCpuSeconds();

}  // namespace sphc::host
