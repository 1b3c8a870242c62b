#include "runtime/stages/features/extractor.h"

#include "runtime/stages/features/orientation.h"

namespace sphc {
namespace {

constexpr uint32_t kMostKeypoints = 65536;
constexpr float kPixelCenter = 0.5f;  // array index 0 is the pixel centred at 0.5

}  // namespace

bool FeatureExtractor::accepts(const FeatureConfig &config) {
  const auto side = [](int32_t n) { return n >= kMinImageSide && n <= kMaxImageSide; };
  return side(config.width) && side(config.height) && config.max_keypoints >= 1 &&
         config.max_keypoints <= kMostKeypoints && config.contrast_threshold >= 0.0f && config.edge_ratio >= 1.0f &&
         config.edge_ratio <= 1e6f && config.first_octave >= -1 && config.first_octave <= 0 &&
         config.max_octaves >= 1 && config.cell_quota >= 1.0f && config.cell_quota <= 1000.0f &&
         config.max_orientations >= 1 && config.max_orientations <= 2;
}

void FeatureExtractor::layout(const FeatureConfig &config, Arena &state, Arena &scratch, FeatureExtractor *out) {
  ScaleSpace::layout(config, state, scratch, out ? &out->space_ : nullptr);
  ExtremaFinder::layout(config, scratch, out ? &out->finder_ : nullptr);
  CandidateList::layout(config, scratch, out ? &out->candidates_ : nullptr);
  GaussianTable::layout(state, out ? &out->gaussian_ : nullptr);
  Describer::layout(state, out ? &out->describer_ : nullptr);
  if (out) out->config_ = config;
}

void FeatureExtractor::init(const FeatureKernels &kernels) {
  kernels_ = &kernels;
  space_.init(kernels);
  gaussian_.init();
  describer_.init();
}

uint32_t FeatureExtractor::extract(GrayView gray, Span<Keypoint> keypoints, Span<Descriptor> descriptors) {
  SPHC_ASSERT(gray.width == config_.width && gray.height == config_.height);
  candidates_.clear();
  for (int32_t o = 0; o < space_.octaves(); ++o) sweepOctave(o, gray);
  const Span<Candidate> chosen = candidates_.choose(config_);
  uint32_t count = 0;
  for (const Candidate &candidate : chosen) {
    if (count == config_.max_keypoints) break;
    count +=
        describe(candidate, config_.max_keypoints - count, keypoints.data() + count, descriptors.data() + count);
  }
  return count;
}

void FeatureExtractor::sweepOctave(int32_t octave, GrayView gray) {
  space_.beginOctave(octave, gray);
  finder_.beginOctave(octave, space_.width(octave), space_.height(octave));
  const int32_t steps = space_.stepCount();
  for (int32_t y = 0; y < steps; y += kRowsAtOnce) {
    space_.step(y);
    for (int32_t i = 0; i < kRowsAtOnce; ++i) finder_.step(*kernels_, space_, y + i, &candidates_);
  }
}

uint32_t FeatureExtractor::describe(const Candidate &candidate, uint32_t room, Keypoint *keypoints,
                                    Descriptor *descriptors) {
  const Plane &level = space_.kept(candidate.octave, candidate.level);
  const int32_t width = space_.width(candidate.octave), height = space_.height(candidate.octave);
  const float sigma = sigmaOfLayer(candidate.layer), size = space_.pixelSize(candidate.octave);
  const int32_t limit = room > 1 ? config_.max_orientations : 1;
  float angles[2];
  const int32_t count =
      findOrientations(*kernels_, level, width, height, candidate.x, candidate.y, sigma, gaussian_, limit, angles);
  for (int32_t i = 0; i < count; ++i) {
    describer_.describe(*kernels_, level, width, height, candidate.x, candidate.y, sigma, angles[i],
                        &descriptors[i]);
    keypoints[i] = {candidate.x * size + kPixelCenter, candidate.y * size + kPixelCenter, sigma * size, angles[i],
                    candidate.response};
  }
  return static_cast<uint32_t>(count);
}

}  // namespace sphc
