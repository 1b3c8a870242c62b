// Frames put together: matches of recent frames, moved along by odometry, join those of a frame that shows too
// little alone.
#pragma once
#include "runtime/localizer/history.h"
#include "runtime/localizer/search.h"

namespace sphc {

class Fusion {
 public:
  static void layout(uint32_t capacity, Arena &state, Fusion *fusion);

  void clear() { history_.clear(); }
  // The map in this slot is another now.
  void forget(uint32_t map) {
    if (map == map_) clear();
  }
  // To the next frame: by the tracker's odometry, without which all is forgotten.
  void advance(const Tracker &tracker);
  // Frames are put together for one map at a time, of those listed: as long as it is likely, the one that earlier
  // frames spoke for.
  uint32_t mapToRemember(const MapOrder &order) const;
  // Keeps the matches of this frame, of global search; true when there are some of earlier frames too.
  bool remember(uint32_t map, const MatchSet &matched);
  // Frames that the matches come from.
  uint32_t frames() const { return history_.frames(); }
  // Puts the matches that are kept behind those of this frame, each map point once: the same wrong match, seen
  // twice, is no evidence.
  void addTo(const MapView &map, MatchSet *matched) const;
  // A pose whose inliers are of earlier frames by this share is off by what their matches are, all together.
  void widenByDrift(double share_of_earlier, Estimate *estimate) const;

 private:
  History history_;
  uint32_t map_ = 0;  // whose matches they are
};

}  // namespace sphc
