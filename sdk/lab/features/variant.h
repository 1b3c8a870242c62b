// One extractor among those that are measured.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/types/image_view.h"

namespace sphc::host {

struct FoundFeatures {
  std::vector<Vector2> pixels_px;    // centre of the top-left pixel is (0.5, 0.5)
  std::vector<uint8_t> descriptors;  // one after the other
  double seconds = 0;                // CPU time of the extractor alone
};

struct FeaturesVariant {
  std::string name;
  uint32_t descriptor_bytes = 0;
  bool binary = false;                                 // compared bit by bit; else by Euclidean distance
  std::function<FoundFeatures(const GrayView &)> run;  // empty: absent
  std::string absent;                                  // then: why, and the cure
};

// The library's own, for images of this size: SIMD and the scalar version.
std::vector<FeaturesVariant> ourFeatures(int32_t width, int32_t height);
// Those of others, as packages offer them; one that is not installed is absent, with the cure.
std::vector<FeaturesVariant> openCvFeatures();
FeaturesVariant colmapFeatures(const std::string &python);

// Other libraries' histograms as the bytes of RootSIFT, so that all are compared alike.
void appendRootSift(const float *histogram, std::vector<uint8_t> *descriptors);

extern const char kOpenCvSiftName[];

}  // namespace sphc::host
