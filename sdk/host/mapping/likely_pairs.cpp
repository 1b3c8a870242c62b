#include "host/mapping/likely_pairs.h"

#include <algorithm>
#include <cmath>

#include "host/publish/descriptor_index.h"

namespace sphc::host {
namespace {

constexpr uint32_t kGaps[] = {1, 2, 3, 5, 8, 12, kMostGapInTime};
constexpr size_t kWordsOfFrame = 300;                      // strongest keypoints
constexpr size_t kLoopsOfFrame = 6, kOverlapsOfFrame = 8;  // at most
constexpr uint32_t kApart = 4;                             // partners of a frame are no neighbours of each other
constexpr uint32_t kNearInTime = 5;
constexpr size_t kEveryPoint = 4;  // is asked where the other frame sees it
constexpr double kLeastOverlap = 0.25, kOverlapOfNeighbours = 0.6;

struct Partner {
  double score;
  uint32_t frame;
};

// The best partners that are not beside one that was taken.
std::vector<uint32_t> spreadPartners(std::vector<Partner> partners, size_t most) {
  std::stable_sort(partners.begin(), partners.end(),
                   [](const Partner &x, const Partner &y) { return x.score > y.score; });
  std::vector<uint32_t> taken;
  for (const Partner &partner : partners) {
    if (taken.size() == most) break;
    const bool is_beside = std::any_of(taken.begin(), taken.end(), [&](uint32_t other) {
      return std::max(other, partner.frame) - std::min(other, partner.frame) < kApart;
    });
    if (!is_beside) taken.push_back(partner.frame);
  }
  return taken;
}

FramePair pairOf(uint32_t i, uint32_t j) { return {std::min(i, j), std::max(i, j)}; }

// How often each frame has each word.
std::vector<std::vector<double>> wordCounts(const std::vector<WalkFrame> &frames) {
  std::vector<Descriptor> descriptors;
  std::vector<uint32_t> frame_of;
  for (size_t rank = 0; rank < kWordsOfFrame; ++rank)  // so that any first part is a sample of all frames
    for (uint32_t f = 0; f < frames.size(); ++f) {
      if (rank >= frames[f].descriptors.size()) continue;
      descriptors.push_back(frames[f].descriptors[rank]);
      frame_of.push_back(f);
    }
  const DescriptorIndex index = makeIndex(descriptors, std::vector<PackedDirection>(descriptors.size(), {1, 1}));
  const size_t words = index.centroids.size(), runs_of_word = index.sector_side * index.sector_side;
  std::vector<std::vector<double>> counts(frames.size(), std::vector<double>(words));
  for (size_t word = 0; word < words; ++word)
    for (uint32_t at = index.runs[word * runs_of_word]; at < index.runs[(word + 1) * runs_of_word]; ++at)
      ++counts[frame_of[index.order[at]]][word];
  return counts;
}

// Rare words weigh more, and every frame the same.
void weigh(std::vector<std::vector<double>> *counts) {
  const size_t words = counts->front().size();
  for (size_t word = 0; word < words; ++word) {
    size_t with = 0;
    for (const auto &frame : *counts) with += frame[word] > 0;
    const double rare = with ? std::log(static_cast<double>(counts->size()) / static_cast<double>(with)) : 0;
    for (auto &frame : *counts) frame[word] *= rare;
  }
  for (auto &frame : *counts) {
    double squared = 0;
    for (double x : frame) squared += x * x;
    if (squared > 0)
      for (double &x : frame) x /= std::sqrt(squared);
  }
}

double product(const std::vector<double> &x, const std::vector<double> &y) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

// Borders of what the keypoints of all frames span, as rays.
struct RayBox {
  Vector2 low = Vector2::Constant(1e9), high = Vector2::Constant(-1e9);
  explicit RayBox(const std::vector<WalkFrame> &frames) {
    for (const WalkFrame &frame : frames)
      for (const SeenPoint &point : frame.points) {
        low = low.cwiseMin(point.ray);
        high = high.cwiseMax(point.ray);
      }
  }
  bool holds(const Vector3 &point_m) const {
    if (!(point_m.z() > 0.1)) return false;
    const Vector2 ray = point_m.head<2>() / point_m.z();
    return (ray.array() > low.array()).all() && (ray.array() < high.array()).all();
  }
};

// Share of the points of one frame that another sees, less where it looks another way.
double overlapOf(const WalkFrame &frame, const Rigid &other_from_frame, const RayBox &view) {
  size_t asked = 0, seen = 0;
  for (size_t i = 0; i < frame.points.size(); i += kEveryPoint) {
    if (!frame.points[i].hasDepth()) continue;
    ++asked;
    seen += view.holds(other_from_frame * frame.points[i].point_m());
  }
  const double same_way = std::max(0.0, other_from_frame.rotation(2, 2));
  return asked ? same_way * static_cast<double>(seen) / static_cast<double>(asked) : 0;
}

}  // namespace

bool isLoop(const std::vector<WalkFrame> &frames, const FramePair &pair) {
  return pair.gap() > kMostGapInTime || frames[pair.a].recording != frames[pair.b].recording;
}

std::vector<FramePair> pairsInTime(const std::vector<WalkFrame> &frames) {
  std::vector<FramePair> pairs;
  for (uint32_t b = 1; b < frames.size(); ++b)
    for (uint32_t gap : kGaps)
      if (gap <= b && !isLoop(frames, {b - gap, b})) pairs.push_back({b - gap, b});
  return pairs;
}

std::vector<FramePair> pairsByLook(const std::vector<WalkFrame> &frames) {
  std::vector<std::vector<double>> words = wordCounts(frames);
  weigh(&words);
  std::set<FramePair> pairs;
  for (uint32_t i = 0; i < frames.size(); ++i) {
    std::vector<Partner> within, across;
    for (uint32_t j = 0; j < frames.size(); ++j)
      if (isLoop(frames, pairOf(i, j)))
        (frames[i].recording == frames[j].recording ? within : across).push_back({product(words[i], words[j]), j});
    for (auto *partners : {&within, &across})
      for (uint32_t j : spreadPartners(std::move(*partners), kLoopsOfFrame)) pairs.insert(pairOf(i, j));
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<FramePair> pairsByOverlap(const std::vector<WalkFrame> &frames, const FramePoses &world_from_camera,
                                      const std::set<FramePair> &tried) {
  const RayBox view(frames);
  std::set<FramePair> pairs;
  for (uint32_t i = 0; i < frames.size(); ++i) {
    if (!world_from_camera[i]) continue;
    std::vector<Partner> within, across;
    for (uint32_t j = 0; j < frames.size(); ++j) {
      const FramePair pair = pairOf(i, j);
      const bool is_loop = isLoop(frames, pair);
      if (!world_from_camera[j] || (!is_loop && pair.gap() <= kNearInTime) || tried.count(pair)) continue;
      const Rigid j_from_i = world_from_camera[j]->inverse() * *world_from_camera[i];
      const double overlap = overlapOf(frames[i], j_from_i, view) * (is_loop ? 1 : kOverlapOfNeighbours);
      if (overlap > kLeastOverlap)
        (frames[i].recording == frames[j].recording ? within : across).push_back({overlap, j});
    }
    for (auto *partners : {&within, &across})
      for (uint32_t j : spreadPartners(std::move(*partners), kOverlapsOfFrame)) pairs.insert(pairOf(i, j));
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace sphc::host
