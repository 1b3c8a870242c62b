// Edges of an image, and how far from them a pixel is.
#pragma once
#include <cstdint>
#include <vector>

namespace sphc::host {

// Canny's edges of a grey image; 1 or 0 each.  Of a `sensitivity` of 2, say, those of half the contrast too.
std::vector<uint8_t> imageEdges(const std::vector<uint8_t> &gray, uint32_t width, uint32_t height,
                                double sensitivity = 1);
// Distance from every pixel to the nearest edge pixel of `edges`, pixels.
std::vector<float> distancesToEdges(const std::vector<uint8_t> &edges, uint32_t width, uint32_t height);

}  // namespace sphc::host
