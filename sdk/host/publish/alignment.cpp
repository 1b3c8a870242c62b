#include "host/publish/alignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/base/random.h"
#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

constexpr double kRatio = 0.85;          // of the nearest to the second nearest descriptor
constexpr double kReachM = 0.06;         // pairs that agree lie so near to each other, and 3 sigma
constexpr double kMostScale = 1.2;       // models are metric, but their makers err
constexpr double kShortestEdgeM = 0.15;  // of a triangle that says how things are turned
constexpr size_t kLeastSupport = 15;     // pairs; chance gives a handful
constexpr size_t kMostAlignments = 6;
constexpr double kEdgeWindow = 0.1;  // of logarithms of ratios
constexpr int kSamples = 20000, kRefinements = 5;

double reach(const PointPair &pair) { return kReachM + 3 * pair.sigma_m; }

// Do the triangles of three pairs have the same shape?
bool isCongruent(const PointPair *triple[3]) {
  for (int i = 0; i < 3; ++i) {
    const PointPair &a = *triple[i], &b = *triple[(i + 1) % 3];
    const double model = (a.model_m - b.model_m).norm(), place = (a.place_m - b.place_m).norm();
    if (model < kShortestEdgeM || place < kShortestEdgeM) return false;
    if (std::abs(model - place) > reach(a) + reach(b) + (kMostScale - 1) * place) return false;
  }
  return true;
}

// Least squares (Umeyama 1991); false when the scale is not one of a metric model.
bool fit(const std::vector<const PointPair *> &pairs, Similarity *place_from_model) {
  Eigen::Matrix3Xd model(3, pairs.size()), place(3, pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    model.col(static_cast<Eigen::Index>(i)) = pairs[i]->model_m;
    place.col(static_cast<Eigen::Index>(i)) = pairs[i]->place_m;
  }
  const Eigen::Matrix4d transform = Eigen::umeyama(model, place, true);
  const Matrix3 scaled = transform.topLeftCorner<3, 3>();
  const double scale = std::cbrt(scaled.determinant());
  if (!(scale > 1 / kMostScale && scale < kMostScale)) return false;
  *place_from_model = {scale, scaled / scale, transform.topRightCorner<3, 1>()};
  return true;
}

bool agrees(const PointPair &pair, const Similarity &place_from_model) {
  return (place_from_model * pair.model_m - pair.place_m).norm() < reach(pair);
}

std::vector<const PointPair *> supporters(const std::vector<PointPair> &pairs, const Similarity &place_from_model) {
  std::vector<const PointPair *> agreeing;
  for (const PointPair &pair : pairs)
    if (agrees(pair, place_from_model)) agreeing.push_back(&pair);
  return agreeing;
}

// Samples that find, with a probability of 99.9 %, a triple among so many supporters.
double samplesFor(size_t support, size_t pairs) {
  const double share = static_cast<double>(support) / static_cast<double>(pairs), triple = share * share * share;
  return triple >= 1 ? 1 : std::log(0.001) / std::log1p(-triple);
}

size_t alignOnce(const std::vector<PointPair> &pairs, Similarity *best) {
  Random random(pairs.size());
  size_t best_support = 0;
  double wanted = kSamples;
  for (int i = 0; i < kSamples && i < wanted; ++i) {
    const PointPair *triple[3];
    for (const PointPair *&pair : triple) pair = &pairs[random.below(static_cast<uint32_t>(pairs.size()))];
    Similarity candidate;
    if (!isCongruent(triple) || !fit({triple, triple + 3}, &candidate)) continue;
    const size_t support = supporters(pairs, candidate).size();
    if (support <= best_support) continue;
    best_support = support;
    *best = candidate;
    wanted = samplesFor(support, pairs.size());
  }
  for (int i = 0; i < kRefinements && best_support >= 3; ++i) {
    Similarity refined;
    if (!fit(supporters(pairs, *best), &refined)) break;
    const size_t support = supporters(pairs, refined).size();
    if (support < best_support) break;
    best_support = support;
    *best = refined;
  }
  return best_support;
}

// The logarithms of ratios of edges between random pairs.
std::vector<double> edgeRatios(const std::vector<PointPair> &pairs) {
  Random random(pairs.size());
  std::vector<double> ratios;
  for (int i = 0; i < kSamples && !pairs.empty(); ++i) {
    const PointPair &a = pairs[random.below(static_cast<uint32_t>(pairs.size()))];
    const PointPair &b = pairs[random.below(static_cast<uint32_t>(pairs.size()))];
    const double model = (a.model_m - b.model_m).norm(), place = (a.place_m - b.place_m).norm();
    if (model > 0 && place > kShortestEdgeM) ratios.push_back(std::log(place / model));
  }
  return ratios;
}

}  // namespace

double otherScale(const std::vector<PointPair> &pairs) {
  std::vector<double> ratios = edgeRatios(pairs);
  std::sort(ratios.begin(), ratios.end());
  double scale = 1;
  size_t most = 0;
  for (size_t begin = 0, end = 0; begin < ratios.size(); ++begin) {
    while (end < ratios.size() && ratios[end] < ratios[begin] + kEdgeWindow) ++end;
    if (end - begin <= most) continue;
    most = end - begin;
    scale = std::exp(ratios[begin + most / 2]);
  }
  return scale > 1 / kMostScale && scale < kMostScale ? 1 : scale;
}

std::vector<PointPair> pairByDescriptor(const std::vector<ModelPoint> &place, const std::vector<ModelPoint> &model,
                                        size_t count) {
  std::vector<Descriptor> table, queries;
  std::vector<size_t> chosen;
  for (const ModelPoint &point : place) table.push_back(point.descriptor);
  count = std::min(count, model.size());
  for (size_t k = 0; k < count; ++k) {
    chosen.push_back(k * model.size() / count);
    queries.push_back(model[chosen.back()].descriptor);
  }
  std::vector<NearestTwo> nearest(count, {UINT32_MAX, UINT32_MAX, 0});
  std::vector<uint32_t> everyone(count);
  std::iota(everyone.begin(), everyone.end(), 0u);
  searchRange({table.data(), table.size()}, 0, static_cast<uint32_t>(table.size()), {queries.data(), count},
              {everyone.data(), count}, {nearest.data(), count});
  std::vector<PointPair> pairs;
  for (size_t k = 0; k < count; ++k) {
    if (!(nearest[k].best2 < kRatio * kRatio * nearest[k].second2)) continue;
    const ModelPoint &own = model[chosen[k]], &known = place[nearest[k].best_index];
    pairs.push_back({own.position_m, known.position_m, std::hypot(own.sigma_m, known.sigma_m)});
  }
  return pairs;
}

std::vector<Similarity> alignments(std::vector<PointPair> pairs) {
  std::vector<Similarity> found;
  while (pairs.size() >= kLeastSupport && found.size() < kMostAlignments) {
    Similarity place_from_model;
    if (alignOnce(pairs, &place_from_model) < kLeastSupport) break;
    found.push_back(place_from_model);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const PointPair &pair) { return agrees(pair, place_from_model); }),
                pairs.end());
  }
  return found;
}

}  // namespace sphc::host
