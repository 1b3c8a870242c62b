#include "runtime/stages/features/extractor.h"

#include <algorithm>
#include <new>

#include "runtime/stages/features/orientation.h"

namespace sphc {
namespace {

constexpr uint32_t kMostKeypoints = 65536;
constexpr float kPixelCenter = 0.5f;  // array index 0 is the pixel centred at 0.5

// Under a deadline.  Shares of the time: of all for the sweep; of that for the finest octave swept, three quarters
// of whose pixels it has.  What an octave costs that is skimmed, of sweeping it.
constexpr double kSweepShare = 0.8, kFinestShare = 0.85, kSkimmedCost = 0.15;
// After this share of its rows an octave must not have used more than this share of its time.
constexpr int32_t kProbedRows = 4;  // one in so many
constexpr double kMostForProbed = 0.35;
constexpr uint32_t kPixelGrain = 4096, kDescribeGrain = 16;  // between two looks at the clock
constexpr double kFewestKeypoints = 64;
// With 128 of the finest keypoints, where the next octave showed 650, half of the frames of redkitchen were lost.
// The pace may have been learnt from coarser octaves, whose pixels cost less.
constexpr double kEnoughKeypoints = 400, kCostOfFinest = 1.3;
// Of an octave that does not fit as a whole: what a band of it gets of the time that describing what was found
// leaves, and how high it is at least.
constexpr double kBandShare = 0.9;
constexpr int32_t kFewestBandRows = 32;
// Pieces overlap by about as many rows, so shorter ones save little.
constexpr int32_t kFewestPieceRows = 48;
constexpr int32_t kMostSkimmed =
    2;  // octaves: a few keypoints tell no pose, and those that are skimmed take time too

}  // namespace

bool FeatureExtractor::accepts(const FeatureConfig &config) {
  const auto side = [](int32_t n) { return n >= kMinImageSide && n <= kMaxImageSide; };
  return side(config.width) && side(config.height) && config.max_keypoints >= 1 &&
         config.max_keypoints <= kMostKeypoints && config.contrast_threshold >= 0.0f && config.edge_ratio >= 1.0f &&
         config.edge_ratio <= 1e6f && config.first_octave >= -1 && config.first_octave <= 0 &&
         config.max_octaves >= 1 && config.cell_quota >= 1.0f && config.cell_quota <= 1000.0f &&
         config.max_orientations >= 1 && config.max_orientations <= 2 && config.pieces >= 1 &&
         config.pieces <= Parallel::kMostPieces;
}

void FeatureExtractor::layout(const FeatureConfig &config, Arena &state, Arena &scratch, FeatureExtractor *out) {
  ScaleSpace::layout(config, scratch, out ? &out->space_ : nullptr);
  const Span<Piece> pieces = state.take<Piece>("features.pieces", config.pieces);
  // In two rows of a step nearly every sample may be an extremum, if few are.
  const size_t row = kRowsAtOnce * kSearchedLayers * static_cast<size_t>(firstOctaveSide(config, config.width));
  for (uint32_t i = 0; i < config.pieces; ++i) {
    Piece *piece = out ? new (pieces.data() + i) Piece() : nullptr;
    Sweep::layout(config, config.pieces > 1, scratch, piece ? &piece->sweep : nullptr);
    ExtremaFinder::layout(config, scratch, piece ? &piece->finder : nullptr);
    if (i > 0) CandidateList::layoutPiece(config, row, scratch, piece ? &piece->found : nullptr);
  }
  CandidateList::layout(config, scratch, out ? &out->candidates_ : nullptr);
  GaussianTable::layout(state, out ? &out->gaussian_ : nullptr);
  Describer::layout(state, out ? &out->describer_ : nullptr);
  if (!out) return;
  out->config_ = config;
  out->most_width_ = config.width;
  out->most_height_ = config.height;
  out->pieces_ = pieces;
}

void FeatureExtractor::init(const FeatureKernels &kernels, const Parallel &parallel) {
  kernels_ = &kernels;
  parallel_ = parallel;
  space_.init();
  gaussian_.init();
  describer_.init();
}

uint32_t FeatureExtractor::extract(GrayView gray, Span<Keypoint> keypoints, Span<Descriptor> descriptors,
                                   const Deadline &deadline) {
  setSize(gray);
  cut_ = false;
  sweep(gray, deadline);
  if (cut_ && deadline.passed()) return 0;
  const uint32_t wanted = std::min(static_cast<uint32_t>(keypoints.size()), config_.max_keypoints);
  const double fitting = keypoints_pace_.fitting(deadline, wanted);
  const uint32_t limit = std::min(static_cast<uint32_t>(std::max(fitting, kFewestKeypoints)), wanted);
  const Span<Candidate> chosen = candidates_.choose(config_, limit);
  cut_ = cut_ || (limit < wanted && chosen.size() == limit);
  const int64_t begin = deadline.clock.now();
  const uint32_t count = describeAll(chosen, limit, deadline, keypoints.data(), descriptors.data());
  if (deadline.isSet()) keypoints_pace_.learn(count, elapsedNs(begin, deadline.clock.now()));
  return count;
}

void FeatureExtractor::setSize(GrayView gray) {
  SPHC_ASSERT(gray.width <= most_width_ && gray.height <= most_height_);
  if (gray.width == config_.width && gray.height == config_.height) return;
  config_.width = gray.width;
  config_.height = gray.height;
  space_.setSize(config_);
}

// All octaves, or those from the finest on that fits, and a band of the next finer one.  What a sweep that falls
// behind has found is forgotten, for it would show the top of the image alone.
void FeatureExtractor::sweep(GrayView gray, const Deadline &deadline) {
  const int32_t coarsest = std::min(kMostSkimmed, space_.octaves() - 1);
  int32_t finest = finestWithin(deadline);
  while (!sweepFrom(finest, gray, deadline.afterShare(kSweepShare)) && finest < coarsest && !deadline.passed())
    ++finest;
  cut_ = cut_ || finest > 0;
  // The octave before the band's, which it is made from, must be this image's.
  if (finest > 0 && space_.octave() + 1 >= finest) sweepBand(finest - 1, gray, deadline);
}

int32_t FeatureExtractor::finestWithin(const Deadline &deadline) const {
  if (!deadline.isSet()) return 0;
  const int32_t coarsest = std::min(kMostSkimmed, space_.octaves() - 1);
  const double fitting = pixels_pace_.fitting(deadline.afterShare(kSweepShare), 1e18);
  double all = 0;
  for (int32_t o = 0; o < space_.octaves(); ++o) all += sweptPixels(o);
  // The finest of all is worth its time only where much of what it shows can be described too.
  const double enough = std::min(kEnoughKeypoints, static_cast<double>(config_.max_keypoints));
  const double needed_ns = kCostOfFinest * all * pixels_pace_.unitNs() + enough * keypoints_pace_.unitNs();
  const bool has_time_for_all = needed_ns < static_cast<double>(deadline.leftNs());
  int32_t finest = 0;
  double skimmed = 0;
  while (finest < coarsest && (all + kSkimmedCost * skimmed > fitting || (finest == 0 && !has_time_for_all))) {
    all -= sweptPixels(finest);
    skimmed += sweptPixels(finest++);
  }
  return finest;
}

// False where the finest of these octaves does not end in time.
bool FeatureExtractor::sweepFrom(int32_t finest, GrayView gray, const Deadline &deadline) {
  candidates_.clear();
  Watch watch(deadline, kPixelGrain);
  for (int32_t o = 0; o < finest; ++o)
    if (!skimOctave(o, gray, &watch)) return !(cut_ = true);
  const int64_t begin = deadline.clock.now();
  double pixels = 0;
  const bool in_time = sweepOctave(finest, gray, deadline.afterShare(kFinestShare), &pixels);
  bool all = in_time;
  for (int32_t o = finest + 1; o < space_.octaves() && all; ++o) all = sweepOctave(o, gray, deadline, &pixels);
  if (deadline.isSet()) pixels_pace_.learn(pixels, elapsedNs(begin, deadline.clock.now()));
  cut_ = cut_ || !all;
  return in_time;
}

bool FeatureExtractor::skimOctave(int32_t octave, GrayView gray, Watch *watch) {
  space_.beginOctave(octave, gray);
  Sweep &sweep = pieces_[0].sweep;
  sweep.begin(space_, {0, space_.height(octave)}, *kernels_);
  const int32_t steps = sweep.skimCount();
  for (int32_t y = 0; y < steps; y += kRowsAtOnce) {
    if (watch->passed(static_cast<uint32_t>(space_.width(octave)))) return false;
    sweep.skim(y);
  }
  return true;
}

// False where it does not end in time.  Adds the pixels done.
bool FeatureExtractor::sweepOctave(int32_t octave, GrayView gray, const Deadline &deadline, double *pixels) {
  const Limits limits = {deadline, deadline.afterShare(kMostForProbed)};
  return sweepRows(octave, {0, space_.height(octave)}, gray, limits, pixels);
}

// Of the octave before the finest that was swept, rows in the middle, where depth is likeliest: as many as fit
// beside describing what was found already.
void FeatureExtractor::sweepBand(int32_t octave, GrayView gray, const Deadline &deadline) {
  const auto found = static_cast<double>(std::min<size_t>(candidates_.size(), config_.max_keypoints));
  const auto left_ns = static_cast<double>(deadline.leftNs());
  const double spare_ns = left_ns - found * keypoints_pace_.unitNs();
  if (!(spare_ns > 0)) return;
  const Deadline own = deadline.afterShare(kBandShare * spare_ns / left_ns);
  const int32_t height = space_.height(octave);
  const double steps = pixels_pace_.fitting(own, sweptPixels(octave)) / space_.width(octave);
  const int32_t count = std::min(height, static_cast<int32_t>(steps) - stepsBeyond(octave, height));
  if (count < kFewestBandRows) return;
  double pixels = 0;
  const int64_t begin = deadline.clock.now();
  sweepRows(octave, {(height - count) / 2, count}, gray, {own, own}, &pixels);
  pixels_pace_.learn(pixels, elapsedNs(begin, deadline.clock.now()));
}

uint32_t FeatureExtractor::pieceCount(int32_t rows) const {
  const auto fitting = static_cast<uint32_t>(rows / kFewestPieceRows);
  return std::max(std::min(fitting, config_.pieces), uint32_t{1});
}

// What is found is listed by rows, whatever the pieces are.
bool FeatureExtractor::sweepRows(int32_t octave, Rows rows, GrayView gray, const Limits &limits, double *pixels) {
  space_.beginBand(octave, rows, gray);
  const uint32_t count = pieceCount(rows.count);
  parallel_.forEach(count, [&](uint32_t i) {
    const Part part = partOf(static_cast<size_t>(rows.count), count, i);
    beginPiece({static_cast<int32_t>(part.first), static_cast<int32_t>(part.size())}, &pieces_[i]);
    sweepPiece(limits, i == 0 ? &candidates_ : &pieces_[i].found, &pieces_[i]);
  });
  bool in_time = true;
  for (Piece &piece : pieces_.first(count)) {
    piece.found.moveTo(&candidates_);
    sweepPiece(limits, &candidates_, &piece);  // what is left where its list was full
    in_time = in_time && !piece.was_late;
    *pixels += static_cast<double>(space_.width(octave)) * (std::min(piece.y, piece.end) - piece.begin);
  }
  return in_time;
}

void FeatureExtractor::beginPiece(Rows rows, Piece *piece) {
  piece->sweep.begin(space_, rows, *kernels_);
  piece->begin = piece->y = piece->sweep.firstStep();
  piece->end = piece->sweep.endStep();
  piece->was_late = false;
}

// Until its end, or time is over, or its own list is full.
void FeatureExtractor::sweepPiece(const Limits &limits, CandidateList *found, Piece *piece) {
  const auto step_pixels = static_cast<uint32_t>(kRowsAtOnce * piece->sweep.width());
  const int32_t probed = piece->begin + (piece->end - piece->begin) / kProbedRows / kRowsAtOnce * kRowsAtOnce;
  Watch watch(limits.all, kPixelGrain);
  int32_t &y = piece->y;
  for (; y < piece->end && !piece->was_late; y += kRowsAtOnce) {
    if (found == &piece->found && !found->hasRoom(kSearchedLayers * step_pixels)) return;
    piece->was_late = watch.passed(step_pixels) || (y == probed && limits.probe.passed());
    if (piece->was_late) return;
    piece->sweep.step(y);
    for (int32_t i = 0; i < kRowsAtOnce; ++i) piece->finder.step(*kernels_, piece->sweep, y + i, found);
  }
}

// In pieces where each candidate gives one keypoint at most, so that each piece has its room.
uint32_t FeatureExtractor::describeAll(Span<const Candidate> chosen, uint32_t limit, const Deadline &deadline,
                                       Keypoint *keypoints, Descriptor *descriptors) {
  const uint32_t pieces = config_.max_orientations == 1 ? config_.pieces : 1;
  uint32_t counts[Parallel::kMostPieces] = {};
  bool cuts[Parallel::kMostPieces] = {};
  parallel_.forEach(pieces, [&](uint32_t i) {
    const Part part = partOf(chosen.size(), pieces, i);
    const uint32_t most = pieces > 1 ? static_cast<uint32_t>(part.size()) : limit;
    Watch watch(deadline, kDescribeGrain);
    for (size_t c = part.first; c < part.end && counts[i] < most && !cuts[i]; ++c) {
      cuts[i] = watch.passed(1);
      const size_t at = part.first + counts[i];
      if (!cuts[i]) counts[i] += describe(chosen[c], most - counts[i], keypoints + at, descriptors + at);
    }
  });
  uint32_t count = 0;
  for (uint32_t i = 0; i < pieces; ++i) {
    const size_t first = partOf(chosen.size(), pieces, i).first;
    if (first > count) {
      std::copy_n(keypoints + first, counts[i], keypoints + count);
      std::copy_n(descriptors + first, counts[i], descriptors + count);
    }
    count += counts[i];
    cut_ = cut_ || cuts[i];
  }
  return count;
}

uint32_t FeatureExtractor::describe(const Candidate &candidate, uint32_t room, Keypoint *keypoints,
                                    Descriptor *descriptors) const {
  const Plane &level = space_.kept(candidate.octave, candidate.level);
  const Rows rows = space_.rows(candidate.octave);
  const int32_t width = space_.width(candidate.octave);
  const float y = candidate.y - static_cast<float>(rows.first);
  const float sigma = sigmaOfLayer(candidate.layer), size = space_.pixelSize(candidate.octave);
  const int32_t limit = room > 1 ? config_.max_orientations : 1;
  float angles[2];
  const int32_t count =
      findOrientations(*kernels_, level, width, rows.count, candidate.x, y, sigma, gaussian_, limit, angles);
  for (int32_t i = 0; i < count; ++i) {
    describer_.describe(*kernels_, level, width, rows.count, candidate.x, y, sigma, angles[i], &descriptors[i]);
    keypoints[i] = {candidate.x * size + kPixelCenter, candidate.y * size + kPixelCenter, sigma * size, angles[i],
                    candidate.response};
  }
  return static_cast<uint32_t>(count);
}

}  // namespace sphc
