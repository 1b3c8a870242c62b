// How well depth lies on the image: distance from the edges of the one to those of the other.
#pragma once
#include <cstdint>
#include <vector>

namespace sphc::host {

// Pixels of something near beside something at least 10 % farther, over a gap of at most `gap_px` pixels without
// depth; 1 or 0 each.
std::vector<uint8_t> depthEdges(const std::vector<uint16_t> &depth, uint32_t width, uint32_t height,
                                uint32_t gap_px);
// Distance from every edge pixel of `from` to the nearest of `to`, pixels; appended to `distances`.
void edgeDistances(const std::vector<uint8_t> &from, const std::vector<uint8_t> &to, uint32_t width,
                   uint32_t height, std::vector<double> *distances);

}  // namespace sphc::host
