// A small map in a file.
#pragma once
#include <cstdint>
#include <string>

namespace sphc::host {

// A small valid map of made-up points.
void writeTinyMap(const std::string &path, uint32_t points);

}  // namespace sphc::host
