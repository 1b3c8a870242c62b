#include "host/guide/places.h"

#include <algorithm>
#include <map>

#include "host/mapping/walk.h"

namespace sphc::host {
namespace {

std::map<uint32_t, uint32_t> sizesOf(const std::vector<GuidePlace> &places) {
  std::map<uint32_t, uint32_t> sizes;
  for (const GuidePlace &place : places) ++sizes[place.part];
  return sizes;
}

}  // namespace

uint32_t Places::add(const WalkFrame &frame, const GuidePlace &place) {
  frames_.push_back(frame);
  places_.push_back(place);
  words_.add(frames_);
  return count() - 1;
}

void Places::removeLast() {
  frames_.pop_back();
  places_.pop_back();
  words_.removeLast();
}

void Places::support(uint32_t place, uint32_t inliers) {
  places_[place].support = std::max(places_[place].support, inliers);
}

void Places::join(uint32_t from, uint32_t to, const Rigid &to_from_from) {
  for (GuidePlace &place : places_)
    if (place.part == from) {
      place.part = to;
      place.part_from_camera = to_from_from * place.part_from_camera;
    }
}

uint32_t Places::largestPart() const {
  uint32_t largest = UINT32_MAX, most = 0;
  for (const auto &[part, size] : sizesOf(places_))
    if (size > most) {
      largest = part;
      most = size;
    }
  return largest;
}

uint32_t Places::sizeOf(uint32_t part) const {
  return static_cast<uint32_t>(
      std::count_if(places_.begin(), places_.end(), [&](const GuidePlace &place) { return place.part == part; }));
}

uint32_t Places::partCount() const { return static_cast<uint32_t>(sizesOf(places_).size()); }

// The linker takes both frames from one list.
std::optional<Places::Link> Places::link(uint32_t place, const WalkFrame &frame, const LinkDemands &demands) {
  frames_.push_back(frame);
  std::optional<Link> found;
  if (auto link = linker_.link(frames_, {place, count()}, demands)) {
    const double shift = shiftOf(*link, frames_);
    found = {std::move(*link), shift};
  }
  frames_.pop_back();
  return found;
}

}  // namespace sphc::host
