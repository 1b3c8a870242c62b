// The places of a walk while it is made: frames that others are held against, and how they hang together.
#pragma once
#include "host/guide/place_words.h"
#include "host/mapping/frame_links.h"

namespace sphc::host {

struct GuidePlace {
  uint32_t sequence = 0;
  int64_t time_ns = 0;
  uint32_t part = 0;  // places of one part are connected by links
  Rigid part_from_camera;
  uint32_t support = 0;     // most inliers of a link with another place
  bool seen_again = false;  // much later
};

class Places {
 public:
  explicit Places(uint32_t max_keypoints) : linker_(max_keypoints) {}

  uint32_t count() const { return static_cast<uint32_t>(places_.size()); }
  const GuidePlace &operator[](uint32_t place) const { return places_[place]; }
  const std::vector<GuidePlace> &all() const { return places_; }

  // Its number.
  uint32_t add(const WalkFrame &frame, const GuidePlace &place);
  void removeLast();
  uint32_t newPart() { return next_part_++; }
  void support(uint32_t place, uint32_t inliers);
  void markSeenAgain(uint32_t place) { places_[place].seen_again = true; }
  // Brings part `from` into part `to`.
  void join(uint32_t from, uint32_t to, const Rigid &to_from_from);

  // Of the part with most places; UINT32_MAX before there is one.
  uint32_t largestPart() const;
  uint32_t sizeOf(uint32_t part) const;
  uint32_t partCount() const;

  // How a frame lies to a place (`b_from_a` is frame_from_place), and how far the view is from it, as rays.
  struct Link {
    FrameLink link;
    double shift = 0;
  };
  std::optional<Link> link(uint32_t place, const WalkFrame &frame, const LinkDemands &demands);
  std::vector<uint32_t> likely(const WalkFrame &frame, const std::function<bool(uint32_t)> &may_be,
                               size_t most) const {
    return words_.likely(frame, may_be, most);
  }

 private:
  FrameLinker linker_;
  PlaceWords words_;
  std::vector<WalkFrame> frames_;
  std::vector<GuidePlace> places_;
  uint32_t next_part_ = 0;
};

}  // namespace sphc::host
