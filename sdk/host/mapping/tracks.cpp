#include "host/mapping/tracks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/mapping/root_of.h"

namespace sphc::host {
namespace {

// Sets of keypoints, none with two of one frame.
class Joiner {
 public:
  explicit Joiner(const std::vector<WalkFrame> &frames) {
    for (uint32_t f = 0; f < frames.size(); ++f) {
      first_of_frame_.push_back(static_cast<uint32_t>(members_.size()));
      for (uint32_t k = 0; k < frames[f].points.size(); ++k) members_.push_back({{f, k}});
    }
    parent_.resize(members_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void join(const Sighting &x, const Sighting &y) {
    uint32_t into = rootOf(x), from = rootOf(y);
    if (into == from) return;
    if (members_[into].size() < members_[from].size()) std::swap(into, from);
    Track both;
    std::merge(members_[into].begin(), members_[into].end(), members_[from].begin(), members_[from].end(),
               std::back_inserter(both), [](const Sighting &a, const Sighting &b) { return a.frame < b.frame; });
    const auto twice = std::adjacent_find(both.begin(), both.end(),
                                          [](const Sighting &a, const Sighting &b) { return a.frame == b.frame; });
    if (twice != both.end()) return;
    parent_[from] = into;
    members_[into] = std::move(both);
    members_[from].clear();
  }

  std::vector<Track> takeJoined() {
    std::vector<Track> tracks;
    for (Track &track : members_)
      if (track.size() > 1) tracks.push_back(std::move(track));
    return tracks;
  }

 private:
  uint32_t rootOf(const Sighting &sighting) {
    return sphc::host::rootOf(&parent_, first_of_frame_[sighting.frame] + sighting.point);
  }

  std::vector<uint32_t> first_of_frame_, parent_;
  std::vector<Track> members_;  // of the roots; empty of the others
};

// Evenly spread sightings of a track, others for another `turn`.
Track thinned(Track track, size_t most, size_t turn) {
  if (track.size() <= most) return track;
  constexpr double kGolden = 0.6180339887498949;
  const double begin = std::fmod(kGolden * static_cast<double>(turn), 1.0),
               step = static_cast<double>(track.size()) / static_cast<double>(most);
  for (size_t i = 0; i < most; ++i) track[i] = track[static_cast<size_t>((begin + static_cast<double>(i)) * step)];
  track.resize(most);
  return track;
}

}  // namespace

std::vector<Track> tracksOf(const std::vector<WalkFrame> &frames, const std::vector<FrameLink> &links) {
  std::vector<const FrameLink *> surest;
  for (const FrameLink &link : links) surest.push_back(&link);
  std::stable_sort(surest.begin(), surest.end(),
                   [](const FrameLink *x, const FrameLink *y) { return x->inliers > y->inliers; });
  Joiner joiner(frames);
  for (const FrameLink *link : surest)
    for (const PointMatch &match : link->matches) joiner.join({link->frames.a, match.a}, {link->frames.b, match.b});
  return joiner.takeJoined();
}

std::vector<Track> enoughTracks(std::vector<Track> tracks, size_t frames, const TrackBudget &budget) {
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Track &x, const Track &y) { return x.size() > y.size(); });
  for (size_t i = 0; i < tracks.size(); ++i) tracks[i] = thinned(std::move(tracks[i]), budget.of_track, i);
  std::vector<size_t> sightings(frames);
  std::vector<Track> taken;
  for (Track &track : tracks) {
    const size_t wanted = track.size() > 2 ? budget.of_frame : budget.of_frame_with_pairs;
    const bool is_wanted =
        std::any_of(track.begin(), track.end(), [&](const Sighting &s) { return sightings[s.frame] < wanted; });
    if (!is_wanted) continue;
    for (const Sighting &s : track) ++sightings[s.frame];
    taken.push_back(std::move(track));
  }
  return taken;
}

}  // namespace sphc::host
