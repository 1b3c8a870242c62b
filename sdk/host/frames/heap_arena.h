// Memory of a stage from the workstation's heap.
#pragma once
#include <vector>

#include "runtime/base/arena.h"

namespace sphc::host {

// What `size` has measured, aligned as a stage wants it; `memory` owns it.
Arena heapFor(const Arena &size, std::vector<uint8_t> *memory);

}  // namespace sphc::host
